#!/usr/bin/env bash
# Builds the programs and runs benchmark.py on them. usage: run.sh [OUTDIR [OPTION OF benchmark.py]...]
# Without options, measures everything and updates Docs/Benchmarks.md.
# Installs Debian packages that are missing before it builds. If SURGICALMESHER_BIN names a folder of built programs, it
# uses these and neither installs nor builds anything.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
if [[ -z ${SURGICALMESHER_BIN:-} ]]; then
  "$root/CMake/build.sh" SurgicalPathScaleCLI SimplexMesherCLI FuchsTetrahedralizerCLI Mesh3Driver TetGenDriver
fi
(($# > 1)) || set -- "${1:-$root/build/benchmarks}" --page
/usr/bin/python3 "$root/Testing/Benchmarks/benchmark.py" "${SURGICALMESHER_BIN:-$root/build/bin}" "$@"
