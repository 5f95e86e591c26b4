#!/bin/sh
# Draws what figures_bench draws, with gnuplot: figures_gnuplot.sh FOLDER
set -eu
folder=$1
out=$folder/gnuplot
mkdir -p "$out"

map_script() {  # terminal ending
  echo "set terminal $1 size 1200,900 font 'DejaVu Sans,$3'"
  echo "set size ratio -1; set grid lc rgb '#e4e4e4'; set key outside right top"
  echo "set title 'ISOMAP, K = 6 · visibility · 2000 steps'; set xlabel 'x [m]'; set ylabel 'y [m]'"
  i=0
  while [ $i -lt 100 ]; do
    echo "set output '$out/map-$2-$i.$2'"
    echo "plot '$folder/map-$i.txt' using 2:3:(\$4-\$2):(\$5-\$3) with vectors nohead lc rgb '#757575' title 'error', '' using 2:3 with points pt 6 lc rgb '#1a1a1a' title 'true position', '' using 4:5 with points pt 7 lc rgb '#0072b2' title 'estimate', '' using 2:3:1 every ::0::4 with labels offset 1,1 notitle"
    i=$((i + 1))
  done
}

curve_script() {
  echo "set terminal pngcairo size 1200,900 font 'DejaVu Sans,18'"
  echo "set grid lc rgb '#e4e4e4'; set key top right; set style fill transparent solid 0.2 noborder"
  echo "set title 'Mean position error over observations, visibility'"
  echo "set xlabel 'observations (steps)'; set ylabel 'MPE [m]'"
  i=0
  while [ $i -lt 100 ]; do
    echo "set output '$out/curve-png-$i.png'"
    printf "plot "
    k=0
    for colour in 0072b2 d55e00 009e73 c66fa1; do
      [ $k -eq 0 ] || printf ", "
      printf "'%s' index %d using 1:3:4 with filledcurves lc rgb '#%s' notitle, '' index %d using 1:2 with linespoints lc rgb '#%s' dt %d pt %d title 'method %d'" \
        "$folder/curve-$i.txt" $k $colour $k $colour $((k + 1)) $((k + 5)) $k
      k=$((k + 1))
    done
    echo
    i=$((i + 1))
  done
}

measure() {  # what script-file ending
  # The second line of `times` has the processor seconds of gnuplot: "0m1.20s 0m0.05s".
  seconds=$(sh -c 'gnuplot "$1" && times' sh "$2" |
    awk 'NR == 2 { gsub(/[ms]/, " "); print 60 * $1 + $2 + 60 * $3 + $4 }')
  bytes=$(cat "$out"/$1-*."$3" | wc -c)
  awk -v what="$1" -v seconds="$seconds" -v bytes="$bytes" \
    'BEGIN { printf "%s gnuplot %.3f %.0f\n", what, seconds, bytes / 100 }'
}

map_script pngcairo png 18 > "$out/map-png.gp"
map_script svg svg 24 > "$out/map-svg.gp"
curve_script > "$out/curve-png.gp"
measure map-png "$out/map-png.gp" png
measure curve-png "$out/curve-png.gp" png
measure map-svg "$out/map-svg.gp" svg
