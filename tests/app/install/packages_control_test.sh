#!/usr/bin/env bash
# packages_control_test.sh ROOT WORK: dpkg reads what the Debian packages are described to depend on.
# That the packages themselves install is for `scripts/check package`.
set -euo pipefail
root=$1 work=$2
rm -rf "$work"
mkdir -p "$work"
cmake -S "$root" -B "$work/build" -G Ninja -D CMAKE_INSTALL_PREFIX=/usr -D MAPPROOF_PACKAGES=ON \
  -D MAPPROOF_PYTHON=ON -D MAPPROOF_TESTS=OFF -D MAPPROOF_BENCHMARKS=OFF >"$work/log" 2>&1 ||
  { cat "$work/log"; exit 1; }

failed=0
fail() {
  echo "packages: $1"
  failed=1
}

# depends_of GROUP   one line, as CPack will write it
depends_of() {
  sed -n "s/^set(CPACK_DEBIAN_$1_PACKAGE_DEPENDS \"\(.*\)\")/\1/p" "$work/build/CPackConfig.cmake"
}

for group in PROGRAM CORE LIBRARIES PYTHON; do
  mkdir -p "$work/$group/DEBIAN"
  printf 'Package: stand-in\nVersion: 1\nArchitecture: all\nMaintainer: S <s@example.org>\n%s\n%s\n' \
    "Depends: $(depends_of $group)" 'Description: stand-in' >"$work/$group/DEBIAN/control"
  dpkg-deb --build "$work/$group" "$work/$group.deb" >"$work/log" 2>&1 ||
    fail "$group: $(tail -1 "$work/log")"
done

# The module loads in the Python that it was compiled for: in 3.11 and not in 3.12.
minor=$(/usr/bin/python3 -c 'import sys; print(sys.version_info.minor)')
[[ "$(depends_of PYTHON)" == "python3 (>= 3.$minor~), python3 (<< 3.$((minor + 1))), "* ]] ||
  fail "python3-mapproof depends on $(depends_of PYTHON)"
exit $failed
