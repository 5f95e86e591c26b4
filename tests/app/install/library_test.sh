#!/usr/bin/env bash
# library_test.sh CMAKE BUILD ROOT WORK: installs the build, moves the tree to another prefix, and
# builds and runs the programs of examples/library with what is there.
set -euo pipefail
cmake=$1 build=$2 root=$3 work=$4
rm -rf "$work"
mkdir -p "$work"

failed=0
fail() {
  echo "library: $1"
  failed=1
}

"$cmake" --install "$build" --prefix "$work/first" >"$work/install.log"
mv "$work/first" "$work/moved"
prefix=$work/moved

# No file of CMake names the folder that was built in, or the first prefix.
if grep -rn -e "$build" -e "$work/first" "$prefix"/lib*/cmake "$prefix"/lib*/*/cmake 2>/dev/null; then
  fail "a path of this machine was installed"
fi

# Headers include installed headers alone.
headers=$prefix/include/mapproof
grep -rhoE '^#include "[^"]+"' "$headers" | sort -u | sed 's/#include "\(.*\)"/\1/' >"$work/included"
[ -s "$work/included" ] || fail "no headers were installed"
while read -r header; do
  [ -f "$headers/$header" ] || fail "$header is included and not installed"
done <"$work/included"

# configure NAME FIND_PACKAGE_ARGUMENTS...   a project that asks for the package
configure() {
  mkdir -p "$work/$1"
  printf 'cmake_minimum_required(VERSION 3.25)\nproject(asks CXX)\nfind_package(mapproof %s)\n' \
    "${*:2}" >"$work/$1/CMakeLists.txt"
  "$cmake" -S "$work/$1" -B "$work/$1/build" -G Ninja -D CMAKE_PREFIX_PATH="$prefix" \
    >"$work/$1/log" 2>&1
}
! configure newer 99.0 REQUIRED || fail "version 99.0 was found"
grep -q 'compatible with requested' "$work/newer/log" || fail "nothing was said of the version"
! configure unknown REQUIRED COMPONENTS core figures || fail "the component figures was found"

"$cmake" -S "$root/examples/library" -B "$work/programs" -G Ninja -D CMAKE_BUILD_TYPE=Release \
  -D CMAKE_PREFIX_PATH="$prefix" >"$work/programs.log" 2>&1 &&
  "$cmake" --build "$work/programs" >>"$work/programs.log" 2>&1 ||
  { tail -n 40 "$work/programs.log"; exit 1; }

# The program of the same tree gives the same map.
hall=$root/examples/hall
"$work/programs/map_bearings" "$hall/bearings.csv" "$hall/anchors.csv" >"$work/library.csv"
"$prefix/bin/mapproof" map "$hall/bearings.csv" --sensor bearing --method smacof-knn -K 7 \
  --anchors "$hall/anchors.csv" --quiet --out "$work/map" >/dev/null
awk -F, 'NR > 1 { printf "%s,%.3f,%.3f\n", $1, $2, $3 }' "$work/map/map.csv" >"$work/program.csv"
cmp "$work/library.csv" "$work/program.csv" || fail "library and program give different maps"

"$work/programs/draw_map" "$work/drawn" | grep -q '^mean position error 0\.' ||
  fail "draw_map printed no error"
for file in room.svg room.png room.pdf; do
  [ -s "$work/drawn/$file" ] || fail "draw_map wrote no $file"
done

plots=$root/examples/plots
"$work/programs/compare_folders" "$plots/old" "$plots/old" >/dev/null || fail "equal folders differ"
code=0
"$work/programs/compare_folders" "$plots/old" "$plots/new" >"$work/verdicts" || code=$?
[ $code -eq 1 ] || fail "compare_folders ended with exit code $code, not 1"
grep -q ': changed$\|: worse$\|: missing$' "$work/verdicts" || fail "no verdict was printed"

# The program finds those that draw 3-D figures and animations.
cp -r "$root/tests/data/study" "$work/study"
env -u MAPPROOF_SCENES -u MAPPROOF_ANIMATION "$prefix/bin/mapproof" report "$work/study" \
  >/dev/null 2>"$work/report.log" || fail "report: $(cat "$work/report.log")"
exit $failed
