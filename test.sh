#!/usr/bin/env bash
# Builds everything, warnings as errors, and runs all tests; installs Debian packages that are missing.
set -euo pipefail
cd "$(dirname "$0")"

CMake/build.sh
cd build
ctest --output-on-failure --no-tests=error --parallel "$(nproc)"
