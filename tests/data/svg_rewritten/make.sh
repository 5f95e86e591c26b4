#!/bin/sh
# Draws a plot by matplotlib and one by gnuplot as SVG, and writes both again by svgo, which is not
# needed to run the tests: npm install svgo; sh make.sh, in this folder.
set -eu
/usr/bin/python3 - <<'PLOT'
import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

x = np.linspace(0, 6, 60)
figure, axes = plt.subplots(figsize=(4, 3))
axes.plot(x, np.sin(x), label="sin")
axes.scatter(x[::10], np.cos(x[::10]))
axes.set_title("Plot")
axes.legend()
figure.savefig("matplotlib.svg")
PLOT
gnuplot -e "set term svg; set output 'gnuplot.svg'; plot sin(x), cos(x) with points"
for name in matplotlib gnuplot; do npx svgo "$name.svg" -o "$name.svgo.svg"; done
