#!/usr/bin/env bash
# What scripts/setup.sh installs on a machine that has `here`, and whose Debian has `known` too.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../scripts/setup.sh"

# An apt that another one keeps from its lock twice, and one that fails for another reason.
scratch=$(mktemp -d)
as_root() {
  echo try >>"$scratch/lock"
  [ "${*: -1}" = broken ] && { echo "E: broken" >&2; return 100; }
  [ "$(wc -l <"$scratch/lock")" -gt 2 ] && return 0
  echo "E: Could not get lock /var/lib/apt/lists/lock" >&2
  return 100
}
sleep() { :; }
failed=0
for round in 1 2 3 4 5; do
  rm -f "$scratch/lock"
  run_apt update 2>/dev/null || { echo "round $round: gave up waiting for the lock"; failed=1; }
done
rm -f "$scratch/lock"
if run_apt broken 2>/dev/null || [ "$(wc -l <"$scratch/lock")" -ne 1 ]; then
  echo "an apt that fails was tried again"
  failed=1
fi

# A build in a folder whose name a shell has to quote.
folder="$scratch/a (b) c'd"
mkdir -p "$folder"
cat >"$folder/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(stand_in CXX)
add_executable(mapproof main.cpp)
END
echo 'int main() {}' >"$folder/main.cpp"
bash -euo pipefail -c '. "$1"; ROOT=$2 BUILD=$2/build; build_mapproof -- mapproof' _ \
  "$(dirname "${BASH_SOURCE[0]}")/../scripts/setup.sh" "$folder" >/dev/null 2>&1 ||
  { echo "no build in a folder with spaces in its name"; failed=1; }
rm -rf "$scratch"

dpkg-query() { echo "here installed"; }
apt-cache() { if [ "$2" = known ] || [ "$2" = here ]; then echo "$2 | 1.0 | Debian"; fi; }
run_apt() { echo "apt $*"; }
say() { :; }
packages_of() { printf '%s\n' "${wanted_packages[@]}"; }

# expect ANSWER PACKAGE...   what apt is asked for, one call after another
expect() {
  local answer=$1 given
  shift
  wanted_packages=("$@")
  given=$(install_packages part | tr '\n' ';') || given="failed"
  if [ "$given" != "$answer" ]; then
    echo "of $*: '$given', not '$answer'"
    failed=1
  fi
}

install="apt install -y -qq --no-install-recommends"
expect "" here
expect "" "here?"
expect "" here "nowhere?"
expect "apt update -qq;$install known;" here known "nowhere?"
expect "apt update -qq;$install known;" "known?" "nowhere?"
expect "failed" here nowhere
exit $failed
