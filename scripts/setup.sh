# Sourced by the other scripts: installs what is missing and builds.
# say WORDS...               a line about what is being done
# install_packages PART...   the parts of scripts/packages.txt
# build_mapproof [CMAKE_OPTION...] -- [TARGET...]   into $BUILD (default: build)

ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")

say() { printf '%s\n' "$*" >&2; }

packages_of() {
  awk -v part="[$1]" '/^\[/ { on = ($0 == part); next } on && NF && !/^#/ { print $1 }' \
    "$ROOT/scripts/packages.txt"
}

as_root() {
  if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

# Runs apt-get; waits up to ten minutes while another apt or dpkg holds the lock.
run_apt() {
  local errors deadline said=
  errors=$(mktemp)
  deadline=$((SECONDS + 600))
  while true; do
    if as_root env DEBIAN_FRONTEND=noninteractive LC_ALL=C \
      apt-get -o DPkg::Lock::Timeout=60 "$@" >&2 2>"$errors"; then
      cat "$errors" >&2
      rm -f "$errors"
      return 0
    fi
    if ! grep -q 'Could not get lock' "$errors" || [ "$SECONDS" -ge "$deadline" ]; then
      cat "$errors" >&2
      rm -f "$errors"
      return 2
    fi
    [ -n "$said" ] || say "waiting for another apt or dpkg to end"
    said=yes
    sleep 5
  done
}

# Prints those names of standard input that no package source of this machine has.
unknown_packages() {
  local name
  while read -r name; do
    [ -n "$(apt-cache madison "$name" 2>/dev/null)" ] || printf '%s\n' "$name"
  done
}

install_packages() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    say "mapproof is built on Debian 12 and 13: this system has no dpkg and apt-get"
    return 2
  fi
  local part package wanted=() missing=() names=() unknown=() installed
  for part in "$@"; do
    while read -r package; do wanted+=("$package"); done < <(packages_of "$part")
  done
  # One query for all: dpkg knows which of them are not installed.
  installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' 2>/dev/null |
    awk '$2 == "installed" { print $1 }')
  for package in "${wanted[@]}"; do
    grep -qxF "${package%\?}" <<<"$installed" || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  # If only NAME?s are missing that this Debian does not have, root is not needed.
  if [[ "${missing[*]} " != *[^?]\ * ]] &&
    [ "$(printf '%s\n' "${missing[@]%\?}" | unknown_packages | wc -l)" -eq ${#missing[@]} ]; then
    return 0
  fi

  if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
    say "needs root or sudo to install: ${missing[*]%\?}"
    return 2
  fi
  run_apt update -qq || return 2
  local nowhere
  nowhere=$(printf '%s\n' "${missing[@]%\?}" | unknown_packages)
  for package in "${missing[@]}"; do
    if ! grep -qxF "${package%\?}" <<<"$nowhere"; then
      names+=("${package%\?}")
    elif [ "$package" = "${package%\?}" ]; then
      unknown+=("$package")
    fi
  done
  if [ ${#unknown[@]} -ne 0 ]; then
    say "this system's package sources do not have: ${unknown[*]} (mapproof is built on Debian 12 and 13)"
    return 2
  fi
  [ ${#names[@]} -eq 0 ] && return 0
  say "installing ${#names[@]} packages: ${names[*]}"
  run_apt install -y -qq --no-install-recommends "${names[@]}"
}

# Whether the build folder was last configured with the tests; scripts/report keeps them then.
builds_tests() { grep -qs '^MAPPROOF_TESTS:BOOL=ON' "$BUILD/CMakeCache.txt"; }

build_mapproof() {
  local options=() log units minutes
  while [ $# -gt 0 ] && [ "$1" != -- ]; do options+=("$1"); shift; done
  shift
  log=$(mktemp)
  if ! cmake -S "$ROOT" -B "$BUILD" -G Ninja "${options[@]}" >"$log" 2>&1; then
    cat "$log" >&2
    rm -f "$log"
    return 3
  fi
  rm -f "$log"
  if [ ! -f "$BUILD/.ninja_log" ]; then
    # A unit takes some 10 processor seconds (docs/testing.md).
    units=$(ninja -C "$BUILD" -t commands "$@" | awk '/ -c .*\.c[px][px]/ { ++n } END { print n + 0 }')
    minutes=$(((units * 10 + 60 * $(nproc) - 1) / (60 * $(nproc))))
    say "building $units units of C++, about $minutes min on $(nproc) processors"
  fi
  NINJA_STATUS='[%f of %t, %e s] ' cmake --build "$BUILD" --target "$@" >&2
}
