# shellcheck shell=bash
# Sourced by the check of packages.
# make_chroot FOLDER [SUITE]   FOLDER/base: a bare system, by debootstrap: like this machine's, or SUITE
# fresh_chroot FOLDER    FOLDER/work: a copy of it
# remove_chroot WORK
# in_chroot WORK COMMAND...   with /proc, of which nothing stays mounted
# dockerfile_lines N     the RUN lines of the N-th stage of scripts/deb/Dockerfile
# dockerfile_suite       the Debian that it starts from, by name
# readme_commands        README's commands that need only files of `mapproof example`

make_chroot() {
  local base=$1/base own suite mirror
  [ -f "$base/made" ] && return 0
  rm -rf "$base"
  mkdir -p "$1"
  own=$(. /etc/os-release && echo "$VERSION_CODENAME")
  suite=${2:-$own}
  mirror=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE)' | awk -v suite="$own" \
    '$2 == suite { print $1; exit }')
  say "making a bare $suite"
  debootstrap --variant=minbase "$suite" "$base" "$mirror" >"$1.log" 2>&1 || return
  if [ "$suite" = "$own" ]; then
    rm -f "$base/etc/apt/sources.list"
    cp -r /etc/apt/sources.list /etc/apt/sources.list.d "$base/etc/apt/" 2>/dev/null || true
  fi
  cp /etc/resolv.conf "$base/etc/resolv.conf"
  touch "$base/made"
}

remove_chroot() { rm -rf --one-file-system "$1"; }

fresh_chroot() {
  remove_chroot "$1/work"
  cp -a "$1/base" "$1/work"
}

in_chroot() {
  local root=$1
  shift
  unshare --mount --pid --fork sh -c \
    'root=$1; shift; mount -t proc proc "$root/proc" && exec env -i HOME=/root LC_ALL=C.UTF-8 \
      DEBIAN_FRONTEND=noninteractive PATH=/usr/sbin:/usr/bin:/sbin:/bin chroot "$root" "$@"' \
    sh "$root" "$@"
}

dockerfile_lines() {
  awk -v stage="$1" '/^FROM / { ++n } n == stage && sub(/^RUN /, "")' "$ROOT/scripts/deb/Dockerfile"
}

dockerfile_suite() {
  case $(sed -n 's/^FROM debian:\([0-9]*\).*/\1/p;T;q' "$ROOT/scripts/deb/Dockerfile") in
    12) echo bookworm ;;
    13) echo trixie ;;
    *) return 1 ;;
  esac
}

readme_commands() {
  grep -E '^    mapproof .*(hall|drive|out/map|out/slam)' "$ROOT/README.md" | sed 's/^    //; s/  *#.*//'
}
