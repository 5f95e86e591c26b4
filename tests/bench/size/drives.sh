#!/bin/sh
# drives.sh MAPPROOF FOLDER [COUNT ...]: reports with 10 to 100 3-D figures, as scripts/bench size
# drives runs it; prints lines for table.sh.
set -eu
program=$1 folder=$2
shift 2
[ $# -gt 0 ] || set -- 10 30 100
bench=$(dirname "$0")
for count in "$@"; do
  python3 "$bench/inputs.py" drives "$folder" "$count"
  "$program" run "$folder/drives.json" --plaza "$folder/data" --out "$folder/study" --quiet >/dev/null
  /usr/bin/time -f '%U %S %M' -o "$folder/time" "$program" report "$folder/study" --quiet --jobs 1 \
    >/dev/null
  find "$folder/study" -name '*.html' -printf '%s\n' | sort -n |
    awk -v count="$count" '
      FILENAME != "-" { seconds = $1 + $2; mib = $3 / 1024; next }
      { ++pages; largest = $1 }
      END { print "drives", count, seconds, mib, pages, largest }' "$folder/time" -
  rm -r "$folder/study" "$folder/data" "$folder/drives.json"
done
