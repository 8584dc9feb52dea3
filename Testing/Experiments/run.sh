#!/usr/bin/env bash
# Runs the surface experiments and draws them: pictures and a table.
# usage: Testing/Experiments/run.sh [OUTDIR]      (default build/experiments)
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
folder=${1:-$root/build/experiments}
mkdir -p "$folder"
"$root/CMake/build.sh" SimplexExperiments
"$root/build/Testing/Experiments/SimplexExperiments" "$folder" /usr/share/mricron/templates
/usr/bin/python3 "$root/workflow/example/display.py" /usr/bin/python3 "$root/Testing/Experiments/pictures.py" "$folder"
