#!/bin/sh
# Prints "NAME M CPU_SECONDS PEAK_MIB" lines as a table, and the slopes of both over M in a log-log
# plot, from each size to the next and by least squares over all: large_table.sh FILE
sort -k1,1 -k2,2n "$1" | awk '
  function slope(y1, y0, x1, x0) { return (log(y1) - log(y0)) / (log(x1) - log(x0)) }
  function fit(values, n,   i, sx, sy, sxx, sxy) {
    for (i = 1; i <= n; ++i) {
      sx += log(size[i]); sy += log(values[i])
      sxx += log(size[i]) ^ 2; sxy += log(size[i]) * log(values[i])
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx)
  }
  function summary() {
    if (n > 1) printf "%-26s %8s %10s %6.2f %10s %6.2f\n", name, "all", "", fit(seconds, n), "", fit(memory, n)
  }
  BEGIN { printf "%-26s %8s %10s %6s %10s %6s\n", "program", "M", "CPU s", "slope", "MiB", "slope" }
  $1 != name { summary(); name = $1; n = 0 }
  {
    ++n; size[n] = $2; seconds[n] = $3; memory[n] = $4
    time_slope = n > 1 ? sprintf("%.2f", slope($3, seconds[n - 1], $2, size[n - 1])) : ""
    memory_slope = n > 1 ? sprintf("%.2f", slope($4, memory[n - 1], $2, size[n - 1])) : ""
    printf "%-26s %8d %10.2f %6s %10d %6s\n", $1, $2, $3, time_slope, $4, memory_slope
  }
  END { summary() }'
