#!/bin/sh
# Prints "PROGRAM SAMPLES FIRST_S FURTHER_S" lines, the least of each, as a table:
# scenes_table.sh FILE. "times" is a program's seconds over mapproof's.
awk '
  { key = $1 SUBSEP $2 }
  !(key in first) || $3 < first[key] { first[key] = $3 }
  !(key in further) || $4 < further[key] { further[key] = $4 }
  !($1 in known) { known[$1] = 1; programs[++m] = $1 }
  !($2 in seen) { seen[$2] = 1; samples[++n] = $2 }
  END {
    printf "%-12s %8s %12s %7s %14s %7s\n", "1200 x 900", "samples", "first s", "times",
           "each further s", "times"
    for (i = 1; i <= n; ++i)
      for (j = 1; j <= m; ++j) {
        ours = "mapproof" SUBSEP samples[i]; key = programs[j] SUBSEP samples[i]
        printf "%-12s %8d %12.3f %7.1f %14.4f %7.1f\n", programs[j], samples[i], first[key],
               first[key] / first[ours], further[key], further[key] / further[ours]
      }
  }' "$1"
