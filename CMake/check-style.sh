#!/usr/bin/env bash
# Checks the formatting of all C++ sources by clang-format 14, and their licence lines. With BUILD, a configured build
# folder whose compile_commands.json is read, it also runs clang-tidy on the sources that do not depend on Slicer.
# usage: CMake/check-style.sh [BUILD]
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-}

sources() { git ls-files '*.h' '*.cxx'; }

sources | xargs clang-format --dry-run --Werror
unlicensed=$(sources | xargs grep -L '^// SPDX-License-Identifier: Apache-2.0$' || true)
if [[ -n $unlicensed ]]; then
  printf 'check-style.sh: no SPDX line in\n%s\n' "$unlicensed" >&2
  exit 1
fi

if [[ -z $build ]]; then
  echo "check-style.sh: formatting and licence lines are in order"
  exit
fi

# The analyzer may follow only calls of short functions; otherwise it takes as long as all other checks together.
shallow=(--extra-arg=-Xclang --extra-arg=-analyzer-config --extra-arg=-Xclang --extra-arg=mode=shallow)
# Leaves out sources that include ITK, whose headers in Debian 12 accept only GCC, or Slicer, whose headers are missing.
sources | grep -E '^(Libs|Program|[A-Za-z]+/(Core|CLI))/.*\.cxx$' | grep -vE '/Testing/|^Libs/SlicerSupport/' \
  | xargs grep -LE 'itk|ItkImage' \
  | xargs -P "$(nproc)" -n 4 nice clang-tidy --quiet -p "$build" "${shallow[@]}" 2>/dev/null
echo "check-style.sh: formatting, licence lines and clang-tidy are in order"
