# shellcheck shell=bash
# Sourced by the check of packages.
# make_chroot FOLDER     FOLDER/base: a bare system like this machine's, by debootstrap
# fresh_chroot FOLDER    FOLDER/work: a copy of it
# remove_chroot WORK
# in_chroot WORK COMMAND...   with /proc, of which nothing stays mounted
# dockerfile_lines N     the RUN lines of the N-th stage of scripts/deb/Dockerfile
# readme_commands        README's commands that need only files of `mapproof example`

make_chroot() {
  local base=$1/base suite mirror
  [ -f "$base/made" ] && return 0
  rm -rf "$base"
  mkdir -p "$1"
  suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
  mirror=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE)' | awk -v suite="$suite" \
    '$2 == suite { print $1; exit }')
  say "making a bare $suite"
  debootstrap --variant=minbase "$suite" "$base" "$mirror" >"$1.log" 2>&1 || return
  rm -f "$base/etc/apt/sources.list"
  cp -r /etc/apt/sources.list /etc/apt/sources.list.d "$base/etc/apt/" 2>/dev/null || true
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

readme_commands() {
  grep -E '^    mapproof .*(hall|drive|out/map|out/slam)' "$ROOT/README.md" | sed 's/^    //; s/  *#.*//'
}
