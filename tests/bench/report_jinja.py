"""A page of the maps that report_bench made, by matplotlib and Jinja2: report_jinja.py FOLDER COUNT.

Prints "COUNT DRAW_S PAGE_S BYTES"."""
import io
import os
import sys
import time

import jinja2
from figures_matplotlib import draw_map

PAGE = jinja2.Template("""<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>Maps</title>
<h1>Maps</h1>
{% for svg in figures %}<figure>{{ svg }}<figcaption>Map {{ loop.index }}</figcaption></figure>
{% endfor %}</html>
""")


def drawing(folder, number):
    text = io.StringIO()
    draw_map(folder, number, text)
    return text.getvalue()[text.getvalue().index("<svg"):]


def main():
    import matplotlib

    matplotlib.rcParams["savefig.format"] = "svg"
    folder, count = sys.argv[1], int(sys.argv[2])
    begin = time.perf_counter()
    figures = [drawing(folder, number) for number in range(count)]
    drawn = time.perf_counter()
    target = os.path.join(folder, "jinja.html")
    with open(target, "w", encoding="utf-8") as page:
        page.write(PAGE.render(figures=figures))
    print(count, f"{drawn - begin:.3f} {time.perf_counter() - drawn:.3f}", os.path.getsize(target))


main()
