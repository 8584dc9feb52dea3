#!/usr/bin/env bash
# Builds what is measured and measures it. usage: run.sh [OUTDIR [OPTION OF benchmark.py]...]
# Without options, measures everything and brings Docs/Benchmarks.md up to date.
# Installs Debian packages that are missing and builds what is measured; SURGICALMESHER_BIN names a folder built already.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
if [[ -z ${SURGICALMESHER_BIN:-} ]]; then
  "$root/CMake/build.sh" SurgicalPathScaleCLI SimplexMesherCLI FuchsTetrahedralizerCLI Mesh3Driver TetGenDriver
fi
(($# > 1)) || set -- "${1:-$root/build/benchmarks}" --page
/usr/bin/python3 "$root/Testing/Benchmarks/benchmark.py" "${SURGICALMESHER_BIN:-$root/build/bin}" "$@"
