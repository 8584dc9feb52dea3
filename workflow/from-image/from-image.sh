#!/usr/bin/env bash
# Makes a finite element mesh of an image of a head: classifies tissues by training points, then runs example.sh.
# usage: from-image.sh [OUTDIR]      Debian's T1 of Colin27, with the points beside this file (default build/from-image)
#        from-image.sh OUTDIR IMAGE TRAINING [--OPTION VALUE]...      as example.sh takes them, with a target or a path
# The training points beside this file are twenty random voxels of each of BrainWeb's classes of the same head.
# If SURGICALMESHER_BIN names a folder of built modules, it uses these and neither installs nor builds anything.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)

# usage: refuse STATUS MESSAGE
refuse()
{
  echo "from-image.sh: $2" >&2
  exit "$1"
}

if [[ ${1:-} == -* ]]; then
  sed -n 's/^# //; 2,6p' "$0" >&2
  [[ $1 == --help ]] && exit 0
  exit 2
fi
(($# != 2)) || refuse 2 "2 arguments, expected OUTDIR alone or OUTDIR IMAGE TRAINING"
folder=${1:-$root/build/from-image}
image=${2:-/usr/share/mricron/templates/ch2.nii.gz}
training=${3:-$here/training.mrk.json}
options=("${@:4}")
(($# > 3)) || options=(--targets "$here/sella.mrk.json" --minimumEdgeLength 1.5 --maximumEdgeLength 8 --childRadius 10
  --decayLength 40 --minimumIslandVolume 60 --featureScale 0.5)
[[ -f $image ]] || refuse 1 "$image: no such file, expected an image of a head"
[[ -f $training ]] || refuse 1 "$training: no such file, expected labelled training points"

if [[ -z ${SURGICALMESHER_BIN:-} ]]; then
  "$root/CMake/build.sh" --for build,example TissueMapperCLI SurgicalPathScaleCLI SimplexMesherCLI FuchsTetrahedralizerCLI
  export SURGICALMESHER_BIN=$root/build/bin
fi
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM
"$SURGICALMESHER_BIN/TissueMapperCLI" --training "$training" --names "$work/tissues.ctbl" \
  --report "$work/classification.json" "$image" "$work/tissues.nrrd"
status=0
"$root/example.sh" "$folder" "$work/tissues.nrrd" --names "$work/tissues.ctbl" "${options[@]}" || status=$?
((status == 0 || status == 3)) || exit "$status" # 3: all is there but the pictures
mv -f -- "$work"/* "$folder"
echo "Written to $folder as well: tissues.nrrd tissues.ctbl classification.json"
exit "$status"
