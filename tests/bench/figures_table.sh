#!/bin/sh
# Prints "WHAT PROGRAM PROCESSOR_SECONDS BYTES" lines as a table: figures_table.sh FILE
# "times" is the program's time over that of mapproof.
awk '
  { seconds[$1, $2] = $3; bytes[$1, $2] = $4 }
  !($1 in seen) { seen[$1] = 1; whats[++n] = $1 }
  !($2 in known) { known[$2] = 1; programs[++m] = $2 }
  END {
    printf "%-10s %-10s %10s %8s %12s\n", "100 of", "by", "CPU s", "times", "bytes each"
    for (i = 1; i <= n; ++i)
      for (j = 1; j <= m; ++j)
        if ((whats[i], programs[j]) in seconds)
          printf "%-10s %-10s %10.3f %8.1f %12.0f\n", whats[i], programs[j],
                 seconds[whats[i], programs[j]],
                 seconds[whats[i], programs[j]] / seconds[whats[i], "mapproof"],
                 bytes[whats[i], programs[j]]
  }' "$1"
