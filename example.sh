#!/usr/bin/env bash
# From label map to finite elements: the 189 tissues of a brain atlas around a target, or a map of your own.
# usage: ./example.sh [OUTDIR]                             (default build/example)
#        ./example.sh OUTDIR MAP [--OPTION VALUE]...       with --targets FILE or --path FILE, and any option of the
#                                                          modules; --nullDisplacement... marks far tissue first
# Installs Debian packages that are missing, builds the three modules, and leaves the meshes, a report and pictures.
# With SURGICALMESHER_BIN set to a folder of modules already built, it uses these.
set -euo pipefail

root=$(cd "$(dirname "$0")" && pwd)
outputs=(scale.nrrd labels.nrrd prepared.nrrd ambient.vtu surface.vtp mesh.vtu {scale,surface,mesh,report}.json
  {surface,tetrahedra,scale,evolution,histograms}.png log.txt)

# usage: refuse STATUS MESSAGE
refuse()
{
  echo "example.sh: $2" >&2
  exit "$1"
}

if [[ ${1:-} == -* ]]; then
  sed -n 's/^# //; 2,5p' "$0" >&2
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
  "$root/CMake/build.sh" SurgicalPathScaleCLI SimplexMesherCLI FuchsTetrahedralizerCLI
fi
export PATH="${SURGICALMESHER_BIN:-$root/build/bin}:$PATH"
options=$(/usr/bin/python3 "$root/workflow/example/options.py" "${@:3}") || exit
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
cd "$folder"
for file in "${outputs[@]}"; do
  [[ ! $map -ef $file ]] || refuse 2 "$map would be overwritten, expected another folder for the results"
done
rm -f -- "${outputs[@]}"

# The modules' progress is for a terminal; elsewhere it goes to the log.
seconds=()
stage()
{
  local name=$1 start=$EPOCHREALTIME
  shift
  echo "$name: $*"
  if [[ -t 1 ]]; then "$@"; else "$@" >>log.txt; fi
  seconds+=("$name=$(awk -v a="$start" -v b="$EPOCHREALTIME" 'BEGIN { print b - a }')")
}

# The options that $options deals out to a stage, in the array `words`.
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

illustrate_and_report()
{
  stage pictures xvfb-run -a /usr/bin/python3 "$root/workflow/example/pictures.py" .
  echo
  /usr/bin/python3 "$root/workflow/example/report.py" . "${seconds[@]}"
  echo
  echo "Written to $folder: scale.nrrd prepared.nrrd ambient.vtu surface.vtp mesh.vtu report.json and five pictures"
}

if [[ -n $map ]]; then
  mesh_own_map
  illustrate_and_report
  exit
fi

cp /usr/share/mricron/templates/jhu189.nii.gz .
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
