#!/usr/bin/env bash
# Installs the Debian packages of debian-packages.txt that are missing, then builds into build/.
# usage: CMake/build.sh [--for SECTION[,SECTION]...] [TARGET]...
# Without --for, the packages of all sections are installed. The script first lists the missing packages and their size,
# and at a terminal it asks before it installs them. A new build folder has no tests unless the section tests is wanted.
set -euo pipefail
cd "$(dirname "$0")/.."

list=CMake/debian-packages.txt
sections=$(sed -n 's/^# \[\([a-z]*\)\].*/\1/p' "$list" | tr '\n' ' ')
if [[ ${1:-} == --for ]]; then
  [[ -n ${2:-} ]] || { echo "build.sh: --for is missing its sections, expected some of $sections" >&2; exit 2; }
  wanted=${2//,/ }
  shift 2
fi
wanted=${wanted:-$sections}
for section in $wanted; do
  [[ " $sections" == *" $section "* ]] || { echo "build.sh: --for $section: expected $sections" >&2; exit 2; }
done

# The packages of the wanted sections, each listed once.
packages=$(awk -v wanted=" $wanted " '
  /^# \[/ { name = $2; gsub(/[][]/, "", name); listed = index(wanted, " " name " ") }
  { sub(/#.*/, "") }
  listed && NF && !seen[$1]++ { print $1 }' "$list")
missing=()
for package in $packages; do
  dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done

# Prints the sizes to download and on disk, as apt-get reports them, of the missing packages and their dependencies.
sizes()
{
  LC_ALL=C apt-get install --assume-no --no-install-recommends "${missing[@]}" 2>/dev/null |
    sed -n 's/^Need to get \(.*\) of archives\./\1 to download/p; s/^After this operation, \(.*\) of additional.*/\1 on disk/p' |
    paste -sd , - | sed 's/,/, /'
}

if ((${#missing[@]})); then
  as_root=()
  if ((EUID)); then
    command -v sudo >/dev/null || { echo "build.sh: not root and no sudo: install ${missing[*]}" >&2; exit 1; }
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get update -qq
  size=$(sizes || true)
  echo "For ${wanted% }, these Debian packages are missing (${size:-of unknown size}, with what they need):"
  echo "  ${missing[*]}"
  if [[ -t 0 && -t 1 ]]; then
    read -r -p "Install them? [Y/n] " answer
    [[ ${answer:-y} == [Yy]* ]] || { echo "build.sh: nothing installed" >&2; exit 1; }
  fi
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" </dev/null >/dev/null
fi

options=(-DCMAKE_BUILD_TYPE=Release -DSurgicalMesher_WARNINGS_AS_ERRORS=ON -DCMAKE_EXPORT_COMPILE_COMMANDS=ON)
if [[ " $wanted " == *" tests "* ]]; then
  options+=(-DBUILD_TESTING=ON)
elif [[ ! -f build/CMakeCache.txt ]]; then
  options+=(-DBUILD_TESTING=OFF)
fi
if command -v ccache >/dev/null; then
  options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi
cmake -S . -B build -G Ninja "${options[@]}"
cmake --build build --target "${@:-all}"
