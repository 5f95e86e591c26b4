#!/bin/sh
# Prints "M WHAT PROGRAM SECONDS PEAK_MIB ..." lines as a table: embed_table.sh FILE
# "floor" is the share of mapproof's time that the products and distances alone take.
awk '
  { seconds[$1, $2, $3] = $4; peak[$1, $2, $3] = $5 }
  !(($1, $2) in seen) { seen[$1, $2] = 1; size[++n] = $1; what[n] = $2 }
  function cell(value, format) { return value == "" ? "-" : sprintf(format, value) }
  END {
    printf "%5s  %-16s %10s %6s %12s %7s %9s %9s\n", "M", "method", "mapproof s", "floor",
           "scikit-learn", "times", "MiB ours", "MiB theirs"
    for (i = 1; i <= n; ++i) {
      ours = seconds[size[i], what[i], "mapproof"]
      theirs = seconds[size[i], what[i], "scikit-learn"]
      printf "%5d  %-16s %10.5f %5.0f%% %12s %7s %9s %9s\n", size[i], what[i], ours,
             100 * seconds[size[i], "gram", "mapproof"] / ours, cell(theirs, "%.5f"),
             theirs == "" || theirs == "nan" ? "-" : sprintf("%.1f", theirs / ours),
             cell(peak[size[i], what[i], "mapproof"], "%d"),
             cell(peak[size[i], what[i], "scikit-learn"], "%d")
    }
  }' "$1"
