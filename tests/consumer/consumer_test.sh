#!/usr/bin/env bash
# Installs what is built, moves the installed tree, and uses it as another project would.
#   consumer_test.sh BUILD_FOLDER SCRATCH_FOLDER
set -euo pipefail
build=$1 scratch=$2
here=$(cd "$(dirname "$0")" && pwd)

fail() { echo "consumer_test: $1"; exit 1; }
expect() {  # expect WHAT FILE: the file holds the text
  grep -qF -- "$1" "$2" || { cat "$2"; fail "\"$1\" is not in $2"; }
}

rm -rf "$scratch"
mkdir -p "$scratch"
cmake --install "$build" --prefix "$scratch/first" >"$scratch/install.log"
# Nothing may depend on where it was installed.
mv "$scratch/first" "$scratch/installed"
prefix=$scratch/installed

configure() {
  cmake -S "$here" -B "$1" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix" \
    "${@:2}" >"$1.log" 2>&1 || { cat "$1.log"; fail "cannot configure"; }
  cmake --build "$1" >>"$1.log" 2>&1 || { cat "$1.log"; fail "cannot build"; }
}

reference=$([ -x "$prefix/bin/contactcheck" ] && echo ON || echo OFF)
configure "$scratch/consumer" -DWITH_REFERENCE="$reference"
"$scratch/consumer/two_boxes" >"$scratch/two_boxes.txt" || fail "two_boxes found no contact"
expect "0 pairs at rest" "$scratch/two_boxes.txt"

# Every installed header compiles alone, and an umbrella leads to it: what is not meant for users is
# not installed.
include=$prefix/include/contactcheck
(cd "$include" && find . -name '*.h' | sed 's|^[.]/||' | LC_ALL=C sort) >"$scratch/headers.txt"
eigen=$(pkg-config --cflags-only-I eigen3)
while read -r header; do
  # shellcheck disable=SC2086  # one word per flag
  case $header in
    *_plugin.h) language="c -std=c11" ;;
    *) language="c++ -std=c++20" ;;
  esac
  echo "#include \"$header\"" |
    g++ -fsyntax-only -Wall -Werror -I"$include" $eigen -x $language - || fail "$header does not compile alone"
done <"$scratch/headers.txt"
# Named from within the folder, so that no blank of its path is in the lists.
(cd "$include" && {
  for umbrella in core/core.h reference/reference.h; do
    # shellcheck disable=SC2086
    [ ! -e "$umbrella" ] || g++ -std=c++20 -MM -MG -I. $eigen -x c++ "$umbrella"
  done | tr ' \\' '\n' | sed -n 's|^[.]/||; /^\(core\|reference\)\/.*[.]h$/p'
  find . -name '*_plugin.h' | sed 's|^[.]/||'
}) | LC_ALL=C sort -u | diff "$scratch/headers.txt" - || fail "headers that no umbrella leads to (<)"

# Core alone asks for none of the libraries that only judging needs.
without=()
for package in CGAL CLI11 assimp ccd embree fcl fmt meshoptimizer nlohmann_json; do
  without+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
configure "$scratch/core_alone" -DWITH_REFERENCE=OFF "${without[@]}"

# The same program by pkg-config, without CMake.
pc=$(dirname "$(find "$prefix" -name contactcheck.pc)")
# xargs takes apart what pkg-config writes for a shell: a prefix may have blanks in it.
PKG_CONFIG_PATH=$pc pkg-config --cflags --libs contactcheck |
  xargs g++ -std=c++20 "$here/two_boxes.cpp" -o "$scratch/by_pkg_config"
"$scratch/by_pkg_config" | cmp - "$scratch/two_boxes.txt" || fail "by pkg-config it says otherwise"

if [ "$reference" = ON ]; then
  # The installed program reads the data beside it, not the source tree's.
  suites=$prefix/share/contactcheck/fixtures/suites
  sed 's/"default"/"installed"/' "$suites/default.json" >"$suites/installed.json"
  "$prefix/bin/contactcheck" list --suites >"$scratch/suites.txt"
  expect "installed" "$scratch/suites.txt"
  "$scratch/consumer/judge" run bunny-touch --frames 4 --no-timing \
    --detector sphere-per-body --detector fcl-aabb --out "$scratch/out" --quiet
  expect '"detector": "sphere-per-body"' "$scratch/out/results.json"
fi
echo "consumer_test: passed"
