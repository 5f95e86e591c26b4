#!/bin/sh
# table.sh RESULTS: the table of `scripts/bench size`. Each line of RESULTS is "WHAT COUNT
# PROCESSOR_S MIB PAGES LARGEST_PAGE_BYTES"; the slopes are those of a double logarithmic line from a
# count to the next, and of the last row from the first to the last count.
set -eu
awk '
  function slope(a, b, na, nb) { return a > 0 && b > 0 ? log(b / a) / log(nb / na) : 0 }
  function end_of_part() {
    if (rows > 1)
      printf "%-10s %8s %8s %6.2f %9s %6.2f\n", part, "overall", "", slope(s1, s, n1, n), "",
        slope(m1, m, n1, n)
  }
  BEGIN {
    printf "%-10s %8s %8s %6s %9s %6s %6s %14s\n", "", "count", "CPU s", "slope", "MiB", "slope",
      "pages", "largest, MB"
  }
  $1 != part { end_of_part(); part = $1; rows = 0; n1 = $2; s1 = $3; m1 = $4 }
  {
    printf "%-10s %8d %8.2f %6s %9.0f %6s %6d %14.2f\n", $1, $2, $3,
      rows ? sprintf("%.2f", slope(s, $3, n, $2)) : "-", $4,
      rows ? sprintf("%.2f", slope(m, $4, n, $2)) : "-", $5, $6 / 1e6
    n = $2; s = $3; m = $4; ++rows
  }
  END { end_of_part() }' "$1"
