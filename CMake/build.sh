#!/usr/bin/env bash
# Installs what is missing of debian-packages.txt, then builds into build/. usage: CMake/build.sh [TARGET]...
set -euo pipefail
cd "$(dirname "$0")/.."

packages=$(sed 's/#.*//' CMake/debian-packages.txt)
missing=()
for package in $packages; do
  dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done

if ((${#missing[@]})); then
  echo "Installing ${missing[*]}"
  as_root=()
  if ((EUID)); then
    command -v sudo >/dev/null || { echo "build.sh: not root and no sudo: install ${missing[*]}" >&2; exit 1; }
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" </dev/null >/dev/null
fi

options=(-DCMAKE_BUILD_TYPE=Release -DSurgicalMesher_WARNINGS_AS_ERRORS=ON)
if command -v ccache >/dev/null; then
  options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi
cmake -S . -B build -G Ninja "${options[@]}"
cmake --build build --target "${@:-all}"
