#!/usr/bin/env bash
# Meshes a 189-tissue brain atlas around a surgical target, from label map to finite elements.
# usage: ./example.sh [OUTDIR]      (default build/example)
# Installs Debian packages that are missing, builds the three modules, and leaves the meshes, a report and pictures.
# With SURGICALMESHER_BIN set to a folder of modules already built, it uses these.
set -euo pipefail

root=$(cd "$(dirname "$0")" && pwd)
folder=${1:-$root/build/example}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)

if [[ -z ${SURGICALMESHER_BIN:-} ]]; then
  "$root/CMake/build.sh" SurgicalPathScaleCLI SimplexMesherCLI FuchsTetrahedralizerCLI
fi
export PATH="${SURGICALMESHER_BIN:-$root/build/bin}:$PATH"
cd "$folder"
rm -f -- scale.nrrd prepared.nrrd ambient.vtu surface.vtp mesh.vtu {scale,surface,mesh,report}.json ./*.png log.txt

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
stage pictures xvfb-run -a /usr/bin/python3 "$root/Docs/Example/pictures.py" . 0 0 -10

echo
/usr/bin/python3 "$root/Docs/Example/report.py" . "${seconds[@]}"
echo
echo "Written to $folder: scale.nrrd prepared.nrrd ambient.vtu surface.vtp mesh.vtu report.json and four pictures"
