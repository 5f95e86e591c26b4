#!/bin/sh
# diff_table.sh RESULTS: lines "PROGRAM WHAT WALL_S PROCESSOR_S PEAK_KIB" as a table.
awk '
  BEGIN {
    said["one"] = "1600 x 1200, 0.1 % changed"
    said["large"] = "7680 x 4320, 0.1 % changed"
    said["mostly"] = "100 of 1200 x 900, 5 changed"
    said["changed"] = "100 of 1200 x 900, all changed"
    printf "%-32s %-12s %8s %12s %6s\n", "images", "program", "wall s", "processor s", "MiB"
  }
  { printf "%-32s %-12s %8.2f %12.2f %6.0f\n", said[$2], $1, $3, $4, $5 / 1024 }
  END { print "MiB of the largest process; odiff and ImageMagick compare a pair a process, two at a time." }' "$1"
