#!/usr/bin/env bash
# All evidence: builds what is measured, measures it, and brings Docs/Evidence.md up to date.
# usage: run.sh [OUTDIR [DATA]]
# DATA holds head/head_08.nii.gz, colin27/colin27_tissues.nii.gz and torso/torso_61.nii.gz,
# which Docs/Evidence.md says where to get; without it, the JHU atlas is in their place.
# What OUTDIR holds already is not made again. SURGICALMESHER_BIN names a folder built already.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
if [[ -z ${SURGICALMESHER_BIN:-} ]]; then
  "$root/CMake/build.sh" SurgicalPathScaleCLI SimplexMesherCLI SurfaceRemesherCLI FuchsTetrahedralizerCLI \
    Mesh3Driver TetGenDriver BooleanDriver
fi
bin=${SURGICALMESHER_BIN:-$root/build/bin}
out=${1:-$root/build/evidence}
data=${2:-}
groups=() cases=()
if [[ -n $data ]]; then
  groups=(--map "$data/head/head_08.nii.gz" --groups 1=2,41,25,57 2=3,42,17,53,18,54 3=4,5,43,44,14,15,72 4=7,46 5=8,47
    6=10,11,12,13,26,28,49,50,51,52,58,60 7=16 --box 97:161,101:165,74:138)
  cases=(--case torso "$data/torso/torso_61.nii.gz" -5,-163,262 3,15,30,60 -
    --case colin27 "$data/colin27/colin27_tissues.nii.gz" 0,0,-10 1,8,10,25 "$root/Testing/Evidence/colin27.txt"
    --minimumIslandVolume 30)
fi

evidence() { /usr/bin/python3 "$root/Testing/Evidence/$1.py" "${@:2}"; }
evidence image_registration "$bin" "$out/registration" --document
evidence compatible_interfaces "$bin" "$out/interfaces" "${groups[@]}" --document
evidence whole_maps "$bin" "$out/maps" --document "${cases[@]}"
evidence versions "$bin"
