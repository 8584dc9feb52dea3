#!/usr/bin/env bash
# Makes all evidence: builds the programs, measures them, and updates Docs/Evidence.md.
# usage: run.sh [OUTDIR [DATA [CLEAVER]]]
# DATA holds head/head_NN.nii.gz for 01, 02, 03, 04 and 08, head/labels.ctbl with their names, torso/torso_61.nii.gz and
# colin27/colin27_tissues.nii.gz; Docs/Evidence.md tells where to get them. Missing files are left out; if all are
# missing, the JHU atlas takes their place. CLEAVER is Cleaver's cleaver-cli; without it, Cleaver is not compared.
# Results that are already in OUTDIR are not made again. If SURGICALMESHER_BIN names a folder of built programs, it uses
# these and neither installs nor builds anything.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
here=$root/Testing/Evidence
if [[ -z ${SURGICALMESHER_BIN:-} ]]; then
  "$root/CMake/build.sh" SurgicalPathScaleCLI SimplexMesherCLI SurfaceRemesherCLI FuchsTetrahedralizerCLI \
    MultirateSolverCLI MultirateBenchmark Mesh3Driver TetGenDriver BooleanDriver
fi
bin=$(cd "${SURGICALMESHER_BIN:-$root/build/bin}" && pwd)
out=${1:-$root/build/evidence}
data=${2:-}
cleaver=(${3:+--cleaver "$3"})
groups=() cases=()

# usage: there FILE        succeeds if DATA has the file
there()
{
  [[ -n $data ]] || return 1
  [[ -f $data/$1 ]] || { echo "run.sh: $data/$1 is not there: left out" >&2; return 1; }
}

# usage: case_of NAME FILE TARGET LENGTHS NAMES [OPTION]...        adds a case of whole_maps.py if DATA has the file
case_of()
{
  if there "$2"; then cases+=(--case "$1" "$data/$2" "${@:3}"); fi
}

names=-
if there head/labels.ctbl; then names=$data/head/labels.ctbl; fi
if there head/head_08.nii.gz; then
  groups=(--map "$data/head/head_08.nii.gz" --groups 1=2,41,25,57 2=3,42,17,53,18,54 3=4,5,43,44,14,15,72 4=7,46 5=8,47
    6=10,11,12,13,26,28,49,50,51,52,58,60 7=16 --box 97:161,101:165,74:138)
fi
case_of torso torso/torso_61.nii.gz -5,-163,262 3,15,30,60 "$here/torso.txt"
case_of torso-thin torso/torso_61.nii.gz -5,-163,262 3,15,30,60 "$here/torso.txt" --followThickness
case_of colin27 colin27/colin27_tissues.nii.gz 0,0,-10 1,8,10,25 "$here/colin27.txt" --minimumIslandVolume 30 --fine 10000
for number in 01 02 03 04 08; do # 85 is the optic chiasm
  case_of "head_$number" "head/head_$number.nii.gz" 85 1,3,10,25 "$names" --featureScale 0.5 --minimumIslandVolume 30 \
    --fine 1000
done

part=0
evidence()
{
  echo "run.sh: $((++part)) of 6, $1, into $out" >&2
  /usr/bin/python3 "$here/$1.py" "${@:2}"
}
evidence image_registration "$bin" "$out/registration" "${cleaver[@]}" --document
evidence compatible_interfaces "$bin" "$out/interfaces" "${groups[@]}" "${cleaver[@]}" --document
evidence whole_maps "$bin" "$out/maps" "${cases[@]}" --document
evidence child_rates "$bin" "$out/rates" --document
child=$out/rates/radius-10 # the child of the example
echo "run.sh: $((++part)) of 6, the replayed tool, into $out" >&2
if [[ ! -f $out/replayed/finished ]]; then
  PATH=$bin:$PATH "$root/workflow/example/display.py" "$root/workflow/multirate/replay.py" "$child/parent.vtu" \
    "$child/child.vtu" "$out/replayed"
  touch "$out/replayed/finished"
fi
cp "$out"/replayed/multirate.{png,gif} "$root/Docs/images/"
evidence versions "$bin" ${3:+"$3"}
