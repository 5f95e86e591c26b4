#!/bin/sh
# diff.sh MAPPROOF FOLDER [COUNT ...]: comparisons of folders with 10 to 10,000 PNGs each, with
# their page, as scripts/bench size diff runs it; prints lines for table.sh.
set -eu
program=$1 folder=$2
shift 2
[ $# -gt 0 ] || set -- 10 100 1000 10000
bench=$(dirname "$0")
for what in images changed; do
  for count in "$@"; do
    python3 "$bench/inputs.py" $what "$folder/pair" "$count"
    /usr/bin/time -q -f '%U %S %M' -o "$folder/time" "$program" diff "$folder/pair/a" \
      "$folder/pair/b" --quiet --page "$folder/diff.html" >/dev/null 2>&1 || [ $? -eq 1 ]
    awk -v what=$what -v count="$count" -v bytes="$(stat -c %s "$folder/diff.html")" \
      '{ print what, count, $1 + $2, $3 / 1024, 1, bytes }' "$folder/time"
    rm -r "$folder/pair" "$folder/diff.html"
  done
done
