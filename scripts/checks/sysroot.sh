# shellcheck shell=bash
# Sourced by the checks.
# make_sysroot ARCHITECTURE TRIPLET FOLDER PACKAGE...
#   Makes FOLDER the root of a Debian of that architecture, with the packages and what they depend
#   on. It lacks /etc and what the packages' scripts would do. It uses this machine's apt sources,
#   but lists of its own, so that this machine's dpkg does not change. A FOLDER that was made of the
#   same packages stays.

make_sysroot() {
  local architecture=$1 triplet=$2 folder=$3
  shift 3
  local wanted
  wanted=$(echo "$architecture" "$triplet" "$folder" "$@"; cat "${BASH_SOURCE[0]}")
  [ -f "$folder/made-of" ] && [ "$(cat "$folder/made-of")" = "$wanted" ] && return 0

  rm -rf "$folder"
  mkdir -p "$folder"/apt/{lists,archives}/partial "$folder"/usr/{bin,lib,sbin}
  : >"$folder/apt/status"
  local apt=(apt-get -qq -o APT::Architecture="$architecture" -o APT::Architectures::=
    -o Dir::State="$folder/apt" -o Dir::State::status="$folder/apt/status"
    -o Dir::Cache="$folder/apt" -o APT::Sandbox::User="$(id -un)")
  echo "getting $# packages for $architecture, and what they depend on" >&2
  "${apt[@]}" update >&2 || true  # Some sources have nothing for this architecture.
  "${apt[@]}" -y --no-install-recommends --download-only install "$@" >&2 || return

  local directory package
  for directory in bin lib sbin; do ln -s "usr/$directory" "$folder/$directory"; done
  for package in "$folder"/apt/archives/*.deb; do
    dpkg-deb --fsys-tarfile "$package" |
      tar -x -C "$folder" --keep-directory-symlink --no-same-owner \
        --exclude=./usr/share/doc --exclude=./usr/share/man || return
  done
  rm -r "$folder/apt"
  settle_sysroot "$folder" "$folder/usr/lib/$triplet" || return
  printf '%s' "$wanted" >"$folder/made-of"
}

# settle_sysroot FOLDER LIBRARIES: does what the packages' scripts would have done, and makes
# absolute paths point into FOLDER.
settle_sysroot() {
  local folder=$1 libraries=$2 name link
  for name in blas lapack; do
    ln -sf "$name/lib$name.so.3" "$libraries/lib$name.so.3"
    ln -sf "$name/lib$name.so" "$libraries/lib$name.so"
  done
  ln -sf hdf5-serial.pc "$libraries/pkgconfig/hdf5.pc"
  find "$folder" -type l -lname '/*' | while read -r link; do
    ln -sfnr "$folder$(readlink "$link")" "$link"
  done
  sed -i "s|\([;\"]\)${libraries#"$folder"}|\1$libraries|g" "$libraries"/cmake/*/*.cmake
}
