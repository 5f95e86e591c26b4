#!/usr/bin/env bash
# release_test.sh ROOT WORK: scripts/release in a repository whose packages are stand-ins. That real
# packages repeat is for `scripts/check package`.
set -euo pipefail
root=$1 work=$2
rm -rf "$work"
mkdir -p "$work/repository/scripts"
cd "$work/repository"

failed=0
fail() {
  echo "release: $1"
  failed=1
}

cp "$root"/{CMakeLists.txt,CITATION.cff} .
printf '# Changes\n\n## Unreleased (0.1.0)\n\n### Added\n\n- A thing.\n\n## 0.0.1\n\n- Old.\n' \
  >CHANGELOG.md
cp "$root"/scripts/{setup.sh,release} scripts
cat >scripts/package <<'END'
#!/usr/bin/env bash
mkdir -p "$2"
echo "a package of $SOURCE_DATE_EPOCH" >"$2/mapproof_1_amd64.deb"
echo '{}' >"$2/mapproof.spdx.json"
END
chmod +x scripts/package
echo /out/ >.gitignore
export GIT_AUTHOR_NAME=S GIT_AUTHOR_EMAIL=s@example.org GIT_COMMITTER_NAME=S \
  GIT_COMMITTER_EMAIL=s@example.org
git init -q -b main . && git add -A && git commit -q -m Start

refused() { ! scripts/release >/dev/null 2>"$work/error" && [ "$(wc -l <"$work/error")" -eq 1 ]; }
sed -i 's/^version: .*/version: 0.0.9/' CITATION.cff
refused || fail "changes that are not committed were released"
git commit -q -a -m Cite
refused && grep -q 'CITATION.cff has version 0.0.9' "$work/error" || fail "another version was cited"

scripts/release --prepare 9.8.7
git commit -q -a -m "Version 9.8.7"
grep -q '^project(mapproof VERSION 9.8.7 ' CMakeLists.txt || fail "CMakeLists.txt was not prepared"
grep -q '^version: 9.8.7$' CITATION.cff || fail "CITATION.cff was not prepared"
scripts/release 2>/dev/null || fail "there was no release"
cp -r out/release "$work/first"
scripts/release 2>/dev/null
diff -r "$work/first" out/release || fail "two runs differ"
[ "$(tail -n +3 out/release/NOTES.md)" = $'### Added\n\n- A thing.' ] || fail "the notes are wrong"
(cd out/release && sha256sum --check --quiet SHA256SUMS) || fail "SHA256SUMS is wrong"
[ "$(wc -l <out/release/SHA256SUMS)" -eq 5 ] || fail "SHA256SUMS does not name all files"
[[ $(tar -tf out/release/mapproof-9.8.7.tar.xz) == *mapproof-9.8.7/CITATION.cff* ]] ||
  fail "the source is not whole"
exit $failed
