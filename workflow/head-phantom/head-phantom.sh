#!/usr/bin/env bash
# Makes the head phantom that Audette et al. (Computer Aided Surgery 12(1), 2007) announce: the classified head of
# Colin27 with its optic nerves, which are traced in the T1, as tissues, shells and beams. The mesh is fine along a
# transsphenoidal path and held still far from it.
# usage: head-phantom.sh OUTDIR MAP [T1]
# MAP is BrainWeb's discrete phantom on the grid of T1, with labels 1 to 9 as in names.txt beside this file (its fat,
# muscle and connective tissue are joined). T1 is by default that of Debian's mricron-data. Writes to OUTDIR the axes
# of the nerves, the label map, scale, surface, mesh, its parent and child, shells and beams, models for CalculiX, FEBio
# and Gmsh, report.json and critical_tissues.png. They replace earlier results once all are complete.
# If SURGICALMESHER_BIN names a folder of built modules, it uses these and neither installs nor builds anything.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
python=/usr/bin/python3

# usage: refuse STATUS MESSAGE
refuse()
{
  echo "head-phantom.sh: $2" >&2
  exit "$1"
}

(($# == 2 || $# == 3)) || refuse 2 "$# arguments, expected OUTDIR MAP [T1]"
folder=$1
t1=${3:-/usr/share/mricron/templates/ch2.nii.gz}
[[ -f $2 ]] || refuse 1 "$2: no such file, expected the label map of the phantom"
[[ -f $t1 ]] || refuse 1 "$t1: no such file, expected the T1 of the phantom (Debian's package mricron-data has it)"
map=$(realpath "$2")
t1=$(realpath "$t1")

if [[ -z ${SURGICALMESHER_BIN:-} ]]; then
  "$root/CMake/build.sh" --for build,example TubePathCLI SurgicalPathScaleCLI SimplexMesherCLI FuchsTetrahedralizerCLI
fi
export PATH="$(realpath -m -- "${SURGICALMESHER_BIN:-$root/build/bin}"):$PATH"
mkdir -p "$folder" 2>/dev/null || refuse 1 "$folder: the folder cannot be made"
folder=$(cd "$folder" && pwd)
work=$(mktemp -d "$folder/.phantom.XXXXXX" 2>/dev/null) || refuse 1 "$folder: nothing can be written there"
trap 'rm -rf -- "$work"' EXIT
trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM
cd "$work"

# usage: run COMMAND...       prints and runs a command; its output goes to a terminal or to the log
run()
{
  echo "$*"
  if [[ -t 1 ]]; then "$@"; else "$@" >>log.txt; fi
}

# Each nerve is traced as two tubes, because it is dark in the fat of the orbit and bright from its canal to the chiasm.
# usage: follow LABEL POLARITY PART NAME       traces PART.mrk.json and adds it to the label map as LABEL
labels=$map
follow()
{
  run TubePathCLI --points "$here/$3.mrk.json" --polarity "$2" --name "$4" --label "$1" --addTo "$labels" \
    --labelMap "with-$1.nrrd" "$t1" "$3.mrk.json"
  labels=with-$1.nrrd
}

follow 20 bright left-optic-nerve "left optic nerve"
follow 21 bright right-optic-nerve "right optic nerve"
follow 22 dark left-orbital-nerve "left optic nerve in the orbit"
follow 23 dark right-orbital-nerve "right optic nerve in the orbit"
run SurgicalPathScaleCLI --targets "$here/sella.mrk.json" --path "$here/transsphenoidal-path.mrk.json" \
  --minimumEdgeLength 1.5 --maximumEdgeLength 8 --childRadius 10 --pathChildRadius 3 --decayLength 40 \
  --nullDisplacementRadius 60 --nullDisplacementPathDistance 30 --outputLabelMap labels.nrrd --report scale.json \
  "$labels" scale.nrrd
run SimplexMesherCLI --scale scale.nrrd --names "$here/names.txt" --tissues "$here/tissues.csv" \
  --minimumIslandVolume 60 --featureScale 0.5 --preparedLabelMap prepared.nrrd --followedScale followed.nrrd \
  --ambient ambient.vtu --report surface.json labels.nrrd surface.vtp
curves=()
for part in {left,right}-{optic,orbital}-nerve; do curves+=(--curves "$part.mrk.json"); done
run FuchsTetrahedralizerCLI --scale followed.nrrd --ambient ambient.vtu "${curves[@]}" --curveYoungsModulus 500 \
  --curveMesh nerves.vtp --shellThickness 0.5 --shells sheaths.vtp --parentMesh parent.vtu --childMesh child.vtu \
  --export head.inp --export head.feb --export head.msh --report report.json surface.vtp mesh.vtu
run "$python" "$root/workflow/example/display.py" "$python" "$here/critical_tissues.py" .
rm -f with-*.nrrd
mv -f -- * "$folder"
echo "Written to $folder: mesh.vtu parent.vtu child.vtu nerves.vtp sheaths.vtp head.* report.json critical_tissues.png"
