#!/usr/bin/env bash
# Installs the Debian packages that are missing, builds everything with warnings as errors, and runs all tests.
set -euo pipefail
cd "$(dirname "$0")"

CMake/build.sh
cd build
ctest --output-on-failure --no-tests=error --parallel "$(nproc)"
