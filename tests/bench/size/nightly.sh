#!/bin/sh
# nightly.sh MAPPROOF FOLDER [COUNT ...]: a history of three studies with 10, 100, 1000 and 3650 nightly
# runs, as scripts/bench size nightly runs it; prints a line for table.sh of each: the mean of the ten
# up to it. The command makes the first 100, and the last ten before each further count; those between
# are copies in all tables and folders of the history.
set -eu
program=$1 folder=$2
shift 2
[ $# -gt 0 ] || set -- 10 100 1000 3650
bench=$(dirname "$0")
run=0
for count in "$@"; do
  if [ "$count" -gt 100 ]; then
    run=$((count - 10))
    python3 "$bench/inputs.py" copies "$folder/history" $run
  fi
  while [ $run -lt "$count" ]; do
    run=$((run + 1))
    python3 "$bench/inputs.py" metrics "$folder/metrics" $run
    /usr/bin/time -q -f '%U %S %M' -a -o "$folder/times" "$program" nightly \
      --metrics "$folder/metrics/solver.json" --metrics "$folder/metrics/loader.json" \
      --metrics "$folder/metrics/planner.json" --store "$folder/history" --jobs 1 --quiet \
      --repository-url https://github.com/me/project >/dev/null 2>&1 || [ $? -le 4 ]
  done
  find "$folder/history" -name '*.html' -printf '%s\n' | sort -n >"$folder/pages"
  tail -10 "$folder/times" |
    awk -v run="$count" -v pages="$(wc -l <"$folder/pages")" -v bytes="$(tail -1 "$folder/pages")" \
      '{ seconds += $1 + $2; if ($3 > kib) kib = $3; ++rows }
       END { print "nightly", run, seconds / rows, kib / 1024, pages, bytes }'
done
