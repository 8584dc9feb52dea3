#!/usr/bin/env bash
# Measures everything and brings Docs/Benchmarks.md up to date. usage: run.sh [OUTDIR] [OPTION OF benchmark.py]...
# Installs Debian packages that are missing and builds what is measured; SURGICALMESHER_BIN names a folder built already.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
if [[ -z ${SURGICALMESHER_BIN:-} ]]; then
  "$root/CMake/build.sh" SurgicalPathScaleCLI SimplexMesherCLI FuchsTetrahedralizerCLI Mesh3Driver TetGenDriver
fi
/usr/bin/python3 "$root/Testing/Benchmarks/benchmark.py" "${SURGICALMESHER_BIN:-$root/build/bin}" \
  "${1:-$root/build/benchmarks}" --page "${@:2}"
