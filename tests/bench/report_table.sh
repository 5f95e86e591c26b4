#!/bin/sh
# Prints "PROGRAM COUNT DRAW_S PAGE_S BYTES [INTERACTIVE_MS]" lines as a table: report_table.sh FILE
awk '
  BEGIN {
    printf "%-20s %8s %10s %10s %12s %12s %15s\n", "by", "figures", "drawn [s]", "page [s]", "s a figure",
           "MB", "interactive [s]"
  }
  {
    printf "%-20s %8d %10s %10.3f %12s %12.2f %15s\n", $1, $2, $3 == "-" ? "-" : sprintf("%.3f", $3), $4,
           sprintf("%.5f", ($3 == "-" ? 0 : $3) / $2 + $4 / $2), $5 / 1e6,
           $6 == "" ? "-" : sprintf("%.2f", $6 / 1000)
  }' "$1"
