#!/bin/sh
# results.sh MAPPROOF FOLDER [ROWS ...]: tables of 10,000 to 10,000,000 results, read by every
# command that reads them, as scripts/bench size results runs it; prints lines for table.sh.
#   short  29 bytes a row: two methods, each run is a group of its own
#   long   some 55 bytes a row: 100 setups, 20 methods, 5 quantities, groups of ten runs
set -eu
program=$1 folder=$2
shift 2
[ $# -gt 0 ] || set -- 10000 100000 1000000 10000000

# results_rows SHAPE ROWS: results.csv on standard output.
results_rows() {
  awk -v shape="$1" -v rows="$2" 'BEGIN {
    if (shape == "short") {
      print "setup,method,quantity,run,value"
      for (i = 0; i < rows; ++i)
        printf "s,%s,mpe_m,%07d,0.%06d\n", i % 2 ? "mcl" : "ekf", i / 2, (i * 7919) % 1000000
      exit
    }
    print "setup,method,quantity,run,group,value"
    split("mpe_m moe_percent path_mean_m path_rmse_m landmarks_m", quantities, " ")
    runs = rows / 10000
    for (s = 0; s < 100; ++s)
      for (m = 0; m < 20; ++m)
        for (q = 1; q <= 5; ++q)
          for (r = 0; r < runs; ++r)
            printf "setup-%d,method-%d,%s,run-%d,group-%d,%.5f\n", s, m, quantities[q], r, \
              r / 10, (m + 1) / 10 + (++i * 7919) % 100000 / 100000
  }'
}

# results_study FOLDER SHAPE ROWS
results_study() {
  mkdir "$1"
  printf '{"schema": {"name": "mapproof.results_study", "version": 1}, "name": "large", %s}\n' \
    '"title": "Large results"' >"$1/study.json"
  results_rows "$2" "$3" >"$1/results.csv"
}

# timed WHAT ROWS COMMAND...: a line of it, with the largest page that it left.
timed() {
  what=$1 rows=$2
  shift 2
  /usr/bin/time -q -f '%U %S %M' -o "$folder/time" "$@" >/dev/null 2>&1 || [ $? -eq 1 ]
  largest=$(find "$folder/study" -name '*.html' -printf '%s\n' | sort -n | tail -n 1)
  awk -v what="$what" -v rows="$rows" -v bytes="${largest:-0}" \
    -v pages="$(find "$folder/study" -name '*.html' | wc -l)" \
    '{ print what, rows, $1 + $2, $3 / 1024, pages, bytes }' "$folder/time"
}

for shape in short long; do
  for command in results json validate diff report nightly; do
    for rows in "$@"; do
      results_study "$folder/study" $shape "$rows"
      case $command in
        results) timed $shape-$command "$rows" "$program" results "$folder/study" ;;
        json) timed $shape-$command "$rows" "$program" results "$folder/study" --json ;;
        validate) timed $shape-$command "$rows" "$program" validate "$folder/study" ;;
        diff)
          cp -r "$folder/study" "$folder/other"
          # Every value that ends in 5 becomes another.
          sed -i '2,$s/5$/6/' "$folder/other/results.csv"
          timed $shape-$command "$rows" "$program" diff "$folder/study" "$folder/other"
          rm -r "$folder/other"
          ;;
        report)
          timed $shape-$command "$rows" "$program" report "$folder/study" --jobs 1 --quiet
          ;;
        nightly)
          timed $shape-$command "$rows" "$program" nightly "$folder/study" \
            --store "$folder/store" --quiet
          rm -r "$folder/store"
          ;;
      esac
      rm -r "$folder/study"
    done
  done
done
