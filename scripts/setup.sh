# Sourced by the other scripts: installs what is missing and builds.
# install_packages PART...   the parts of scripts/packages.txt
# build_mapproof [CMAKE_OPTION...] -- [TARGET...]   into $BUILD (default: build)

ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
BUILD=${BUILD:-$ROOT/build}

packages_of() {
  awk -v part="[$1]" '/^\[/ { on = ($0 == part); next } on && NF && !/^#/ { print $1 }' \
    "$ROOT/scripts/packages.txt"
}

install_packages() {
  local part wanted=() missing=() package
  for part in "$@"; do
    while read -r package; do wanted+=("$package"); done < <(packages_of "$part")
  done
  # One query for all: dpkg knows which of them are not installed.
  local installed
  installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' 2>/dev/null |
    awk '$2 == "installed" { print $1 }')
  for package in "${wanted[@]}"; do
    grep -qxF "$package" <<<"$installed" || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0

  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "needs root or sudo to install: ${missing[*]}" >&2
      return 2
    fi
    as_root=(sudo)
  fi
  echo "installing ${#missing[@]} packages: ${missing[*]}" >&2
  "${as_root[@]}" apt-get update -qq >&2
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
}

# Whether the build folder was last configured with the tests: `report` leaves it so.
builds_tests() { grep -qs '^MAPPROOF_TESTS:BOOL=ON' "$BUILD/CMakeCache.txt"; }

build_mapproof() {
  local options=()
  while [ $# -gt 0 ] && [ "$1" != -- ]; do options+=("$1"); shift; done
  shift
  local log
  log=$(mktemp)
  if ! cmake -S "$ROOT" -B "$BUILD" -G Ninja "${options[@]}" >"$log" 2>&1; then
    cat "$log" >&2
    rm -f "$log"
    return 3
  fi
  rm -f "$log"
  cmake --build "$BUILD" --target "$@" >&2
}
