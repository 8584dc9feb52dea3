#!/usr/bin/env bash
# Makes a finite element mesh of a label map: the 189 tissues of a brain atlas around a target, or a map of your own.
# usage: ./example.sh [OUTDIR]                             (default build/example)
#        ./example.sh OUTDIR MAP [--OPTION VALUE]...       with --targets FILE or --path FILE, and any option of the
#                                                          modules; --nullDisplacement... marks far tissue first
# Lists the Debian packages that are missing and their size, installs them, builds the three modules, and writes meshes,
# a report and pictures to OUTDIR. Earlier results there are deleted once the new ones are complete.
# If SURGICALMESHER_BIN names a folder of built modules, it uses these and neither installs nor builds anything.
set -euo pipefail

root=$(cd "$(dirname "$0")" && pwd)
scripts=$root/workflow/example
python=/usr/bin/python3
outputs=(scale.nrrd labels.nrrd prepared.nrrd ambient.vtu surface.vtp mesh.vtu {scale,surface,mesh,report}.json
  {surface,tetrahedra,scale,evolution,histograms}.png log.txt)

# usage: refuse STATUS MESSAGE
refuse()
{
  echo "example.sh: $2" >&2
  exit "$1"
}

if [[ ${1:-} == -* ]]; then
  sed -n 's/^# //; 2,8p' "$0" >&2
  [[ $1 == --help ]] && exit 0
  exit 2
fi
folder=${1:-$root/build/example}
map=${2:-}
if (($# > 1)); then
  [[ $map != -* ]] || refuse 2 "$map: expected a label map before the options"
  [[ -f $map ]] || refuse 1 "$map: no such file, expected a label map"
  map=$(realpath "$map")
fi

if [[ -z ${SURGICALMESHER_BIN:-} ]]; then
  "$root/CMake/build.sh" --for build,example SurgicalPathScaleCLI SimplexMesherCLI FuchsTetrahedralizerCLI
fi
export PATH="$(realpath -m -- "${SURGICALMESHER_BIN:-$root/build/bin}"):$PATH"
[[ -x $python ]] || refuse 1 "$python: not found, expected the packages of CMake/debian-packages.txt"
options=$("$python" "$scripts/options.py" "${@:3}") || exit
inputs=(${map:+"$map"})
while IFS=$'\t' read -r _ _ value; do
  if [[ $value == /* && -f $value ]]; then inputs+=("$value"); fi
done <<<"$options"

# usage: refuse_inputs FOLDER FILE...       ends the script if one of these files in FOLDER is an input
refuse_inputs()
{
  local into=$1 file input
  shift
  for file in "$@"; do
    for input in "${inputs[@]}"; do
      [[ ! $input -ef $into/$file ]] || refuse 2 "$input would be overwritten, expected another folder for the results"
    done
  done
}

# Results are made in a temporary folder inside $folder and replace the earlier ones when all are complete.
[[ ! -e $folder || -d $folder ]] || refuse 1 "$folder: not a folder, expected one for the results"
[[ -d $folder ]] || created=1
mkdir -p "$folder" 2>/dev/null || refuse 1 "$folder: the folder cannot be made"
folder=$(cd "$folder" && pwd)
refuse_inputs "$folder" "${outputs[@]}"
work=$(mktemp -d "$folder/.example.XXXXXX" 2>/dev/null) || refuse 1 "$folder: nothing can be written there"
trap 'rm -rf -- "$work"; if [[ -n ${created:-} ]]; then rmdir --ignore-fail-on-non-empty -- "$folder"; fi' EXIT
trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM
cd "$work"

# usage: stage NAME COMMAND...       runs a stage and records its time; its output goes to a terminal or to the log
seconds=()
stage()
{
  local name=$1 start=$EPOCHREALTIME
  shift
  echo "$name: $*"
  local status=0
  if [[ -t 1 ]]; then "$@" || status=$?; else "$@" >>log.txt || status=$?; fi
  seconds+=("$name=$(awk -v a="$start" -v b="$EPOCHREALTIME" 'BEGIN { print b - a }')")
  return "$status"
}

# usage: words_for STAGE       puts the options that $options assigns to a stage into the array `words`
words_for()
{
  local stage flag value
  words=()
  while IFS=$'\t' read -r stage flag value; do
    if [[ $stage == "$1" ]]; then words+=("$flag" ${value:+"$value"}); fi
  done <<<"$options"
}

mesh_own_map()
{
  local words labels=$map
  words_for scale
  if [[ ${words[*]} == *--nullDisplacement* ]]; then
    labels=labels.nrrd
    words+=(--outputLabelMap "$labels")
  fi
  stage scale SurgicalPathScaleCLI "${words[@]}" --report scale.json "$map" scale.nrrd
  words_for surface
  stage surface SimplexMesherCLI "${words[@]}" --scale scale.nrrd --preparedLabelMap prepared.nrrd \
    --ambient ambient.vtu --report surface.json "$labels" surface.vtp
  words_for mesh
  stage mesh FuchsTetrahedralizerCLI "${words[@]}" --scale scale.nrrd --ambient ambient.vtu --report mesh.json \
    surface.vtp mesh.vtu
}

# Moves all results into the folder and deletes those of an earlier run that the new run did not make.
deliver()
{
  local file
  shopt -s nullglob dotglob
  local results=(*)
  refuse_inputs "$folder" "${results[@]}"
  for file in "${outputs[@]}"; do
    [[ -e $file ]] || rm -f -- "$folder/$file"
  done
  mv -f -- "${results[@]}" "$folder"
}

illustrate_and_report()
{
  local status=0
  stage pictures "$python" "$scripts/display.py" "$python" "$scripts/pictures.py" . || status=3
  echo
  "$python" "$scripts/report.py" . "${seconds[@]}"
  echo
  deliver
  echo "Written to $folder: scale.nrrd prepared.nrrd ambient.vtu surface.vtp mesh.vtu report.json and pictures (.png)"
  exit "$status"
}

if [[ -n $map ]]; then
  mesh_own_map
  illustrate_and_report
fi

cp /usr/share/mricron/templates/jhu189.nii.gz . 2>/dev/null ||
  refuse 1 "/usr/share/mricron/templates/jhu189.nii.gz: not found, expected Debian's package mricron-data"
cat >target.mrk.json <<'END'
{
  "@schema": "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/markups-schema-v1.0.0.json#",
  "markups": [
    {
      "type": "Fiducial",
      "coordinateSystem": "RAS",
      "controlPoints": [{ "id": "1", "label": "target", "position": [0, 0, -10] }]
    }
  ]
}
END

stage scale SurgicalPathScaleCLI --targets target.mrk.json --minimumEdgeLength 1 --maximumEdgeLength 8 \
  --childRadius 10 --decayLength 25 --report scale.json jhu189.nii.gz scale.nrrd
stage surface SimplexMesherCLI --scale scale.nrrd --minimumIslandVolume 30 --preparedLabelMap prepared.nrrd \
  --ambient ambient.vtu --report surface.json jhu189.nii.gz surface.vtp
stage mesh FuchsTetrahedralizerCLI --scale scale.nrrd --ambient ambient.vtu --report mesh.json surface.vtp mesh.vtu
illustrate_and_report
