#!/usr/bin/env bash
# Runs the surface experiments, by the command line and on the surface alone, and draws them: pictures and tables.
# usage: Testing/Experiments/run.sh [OUTDIR [HEAD]]      (default build/experiments; HEAD: see surfaces.py)
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
folder=${1:-$root/build/experiments}
python=/usr/bin/python3
mkdir -p "$folder"
"$root/CMake/build.sh" SimplexExperiments SurgicalPathScaleCLI SimplexMesherCLI
"$python" "$root/workflow/example/display.py" "$python" "$root/Testing/Experiments/surfaces.py" "$folder" ${2:+--head "$2"}
"$root/build/Testing/Experiments/SimplexExperiments" "$folder" /usr/share/mricron/templates
"$python" "$root/workflow/example/display.py" "$python" "$root/Testing/Experiments/pictures.py" "$folder"
