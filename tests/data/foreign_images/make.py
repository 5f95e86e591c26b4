#!/usr/bin/python3
"""make.py FOLDER: small plots by other programs, each drawn in several ways that no reader sees.

Writes PROGRAM-PLOT.VARIANT.png. Any two variants of one plot are a harmless pair: other hinting of
text, other anti-aliasing, a curve through other points of the same function, another renderer of the
same SVG. A missing program is named and left out. Needs Debian's python3-matplotlib, r-cran-ggplot2,
gnuplot-nox, graphviz, python3-cairo, librsvg2-bin, imagemagick and chromium.
"""
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile

FOLDER = pathlib.Path(sys.argv[1])
FOLDER.mkdir(parents=True, exist_ok=True)
RANDOM = random.Random(7)
POINTS = [(i / 30, math.sin(i / 6) + RANDOM.gauss(0, 0.25)) for i in range(60)]


def path(program, plot, variant):
    return str(FOLDER / f"{program}-{plot}.{variant}.png")


def shrink(name):
    """Stores the pixels with a palette if they have at most 256 colours."""
    from PIL import Image
    image = Image.open(name).convert("RGB")
    if image.getcolors(256):
        image = image.quantize(256, dither=Image.Dither.NONE)
    image.save(name, optimize=True)


def matplotlib_plots():
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    variants = {"plain": {}, "unhinted": {"text.hinting": "no_hinting"}}
    for variant, parameters in variants.items():
        with plt.rc_context({"font.size": 8, **parameters}):
            figure, axes = plt.subplots(figsize=(3.2, 2.4), dpi=100)
            figure.subplots_adjust(left=0.17, bottom=0.2)
            axes.scatter(*zip(*POINTS[::3]), s=12, color="tab:blue", label="measured")
            axes.set(xlabel="time [s]", ylabel="error [m]", title="Errors over time")
            axes.legend(loc="upper right")
            figure.savefig(path("matplotlib", "scatter", variant))
            plt.close(figure)
    for variant, count in {"100": 100, "101": 101}.items():
        with plt.rc_context({"font.size": 8}):
            figure, axes = plt.subplots(figsize=(3.2, 2.4), dpi=100)
            figure.subplots_adjust(left=0.17, bottom=0.2)
            x = [2 * i / count for i in range(count + 1)]
            axes.plot(x, [math.sin(5 * v) for v in x])
            axes.bar([0.3, 0.9, 1.5], [0.3, -0.5, 0.6], width=0.2, color="tab:green")
            figure.savefig(path("matplotlib", "curve", variant))
            plt.close(figure)


def ggplot_plots():
    script = """
      library(ggplot2)
      d <- read.csv("points.csv")
      for (n in c(80, 83)) {
        png(sprintf("%s/ggplot2-fit.%d.png", FOLDER, n), 320, 240, type = "cairo")
        print(ggplot(d, aes(x, y)) + geom_point() +
              geom_smooth(method = "loess", formula = y ~ x, se = FALSE, n = n) +
              theme_gray(base_size = 9))
        dev.off()
      }"""
    with tempfile.TemporaryDirectory() as folder:
        with open(f"{folder}/points.csv", "w", encoding="utf-8") as csv:
            csv.write("x,y\n" + "".join(f"{x},{y}\n" for x, y in POINTS[::4]))
        script = script.replace("FOLDER", f'"{FOLDER.resolve()}"')
        subprocess.run(["Rscript", "-e", script], check=True, cwd=folder,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def gnuplot_plots():
    for variant, samples in {"200": 200, "203": 203}.items():
        script = f"""
          set terminal pngcairo size 320,240 font 'DejaVu Sans,8'
          set output '{path("gnuplot", "wave", variant)}'
          set samples {samples}
          set title 'A damped wave'
          set grid
          set xlabel 'x [m]'
          plot [0:12] exp(-x/5)*sin(2*x) title 'model', '-' title 'data' with points pt 7 ps .6
          """ + "".join(f"{6 * x} {y / 2}\n" for x, y in POINTS[::5]) + "e\n"
        subprocess.run(["gnuplot"], input=script, text=True, check=True)


def graphviz_plots():
    graph = """digraph { rankdir=LR; node [fontname="DejaVu Sans", fontsize=11, shape=box];
      world -> history -> distances -> map; anchors -> map [label="align"]; map -> report }"""
    with tempfile.TemporaryDirectory() as folder:
        svg = f"{folder}/graph.svg"
        subprocess.run(["dot", "-Tsvg", "-Gsize=4.2,3!", "-o", svg], input=graph, text=True, check=True)
        subprocess.run(["rsvg-convert", "-b", "white", "-w", "400", svg, "-o",
                        path("graphviz", "graph", "rsvg")], check=True)
        draw_svg_in_chromium(svg, path("graphviz", "graph", "chromium"))


def draw_in_chromium(url, size, name):
    with tempfile.TemporaryDirectory() as profile:
        subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic",
                        "--no-first-run", "--disable-background-networking",
                        "--disable-component-update", "--disable-sync", "--hide-scrollbars",
                        f"--user-data-dir={profile}", f"--window-size={size[0]},{size[1]}",
                        f"--screenshot={name}", url],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def draw_svg_in_chromium(svg, name):
    from PIL import Image
    size = Image.open(name.replace("chromium", "rsvg")).size
    page = pathlib.Path(svg).with_suffix(".html")
    page.write_text(f'<body style="margin:0"><img width="{size[0]}" src="{os.path.basename(svg)}">')
    draw_in_chromium(page.as_uri(), size, name)


def chromium_plots():
    rows = "".join(f"<tr><td>method {i}<td>{0.1 * i:.3f} m<td>{3 * i} %" for i in range(1, 7))
    for rendering in ("auto", "geometricPrecision"):
        page = f"""<!doctype html><body style="font:13px DejaVu Sans;text-rendering:{rendering}">
          <h3>Mean errors</h3><table border=1 cellspacing=0 cellpadding=3>{rows}</table>
          <svg width=90 height=60><circle cx=30 cy=30 r=9 fill=#c33 /></svg>"""
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "page.html"
            file.write_text(page, encoding="utf-8")
            draw_in_chromium(file.as_uri(), (340, 330), path("chromium", "table", rendering))


def cairo_plots():
    import cairo
    for variant in ("gray", "fast"):
        surface = cairo.ImageSurface(cairo.FORMAT_RGB24, 320, 240)
        context = cairo.Context(surface)
        context.set_antialias(getattr(cairo, "ANTIALIAS_" + variant.upper()))
        context.set_source_rgb(0.98, 0.98, 0.95)
        context.paint()
        context.set_source_rgb(0.1, 0.3, 0.6)
        context.set_line_width(2.0)
        for i, (x, y) in enumerate(POINTS):
            (context.line_to if i else context.move_to)(20 + 140 * x, 120 - 50 * y)
        context.stroke()
        context.select_font_face("DejaVu Sans")
        context.set_font_size(12)
        context.move_to(150, 20)
        context.show_text("A path of the robot")
        for x, y in POINTS[::6]:
            context.new_path()
            context.arc(20 + 140 * x, 120 - 50 * y, 4, 0, 7)
            context.set_source_rgb(0.8, 0.2, 0.1)
            context.fill()
        surface.write_to_png(path("cairo", "path", variant))


for draw in (matplotlib_plots, ggplot_plots, gnuplot_plots, chromium_plots, graphviz_plots, cairo_plots):
    try:
        draw()
    except (ImportError, OSError, subprocess.CalledProcessError) as error:
        print(f"{draw.__name__}: left out: {error}", file=sys.stderr)
for image in FOLDER.glob("*.png"):
    shrink(image)
