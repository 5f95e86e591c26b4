#!/bin/sh
# report.sh MAPPROOF FOLDER [COUNT ...]: reports of studies with 10 to 10,000 figures, as
# scripts/bench size report runs it; prints lines for table.sh.
set -eu
program=$1 folder=$2
shift 2
[ $# -gt 0 ] || set -- 10 100 1000 10000
bench=$(dirname "$0")
for what in study sites; do
  for count in "$@"; do
    python3 "$bench/inputs.py" $what "$folder/study" "$count"
    /usr/bin/time -f '%U %S %M' -o "$folder/time" "$program" report "$folder/study" --quiet --jobs 1 \
      >/dev/null
    find "$folder/study" -name '*.html' -printf '%s\n' | sort -n |
      awk -v what=$what -v count="$count" '
        FILENAME != "-" { seconds = $1 + $2; mib = $3 / 1024; next }
        { ++pages; largest = $1 }
        END { print what, count, seconds, mib, pages, largest }' "$folder/time" -
    rm -r "$folder/study"
  done
done
