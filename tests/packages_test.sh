#!/usr/bin/env bash
# What scripts/setup.sh installs on a machine that has `here`, and whose Debian has `known` too.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../scripts/setup.sh"

dpkg-query() { echo "here installed"; }
apt-cache() { if [ "$2" = known ] || [ "$2" = here ]; then echo "$2 | 1.0 | Debian"; fi; }
run_apt() { echo "apt $*"; }
say() { :; }
packages_of() { printf '%s\n' "${wanted_packages[@]}"; }

failed=0
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
