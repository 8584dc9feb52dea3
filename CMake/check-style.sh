#!/usr/bin/env bash
# Formatting of all sources by clang-format 14 and their licence lines; with a configured build folder, whose
# compile_commands.json it reads, clang-tidy's list on the host-independent ones as well.
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

# The analyzer follows calls of short functions only: farther it takes as long as everything else together.
shallow=(--extra-arg=-Xclang --extra-arg=-analyzer-config --extra-arg=-Xclang --extra-arg=mode=shallow)
# Debian 12's ITK headers accept GCC only, and the host's are not here.
sources | grep -E '^(Libs|Program|[A-Za-z]+/(Core|CLI))/.*\.cxx$' | grep -vE '/Testing/|^Libs/SlicerSupport/' \
  | xargs grep -LE 'itk|ItkImage' \
  | xargs -P "$(nproc)" -n 4 nice clang-tidy --quiet -p "$build" "${shallow[@]}" 2>/dev/null
echo "check-style.sh: formatting, licence lines and clang-tidy are in order"
