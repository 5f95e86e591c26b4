#!/usr/bin/env python3
"""Puts PNG figures that mapproof drew into one sheet: contact_sheet.py SHEET.png COLUMNS FIGURE.png...

Needs Debian's python3-pil. docs/images/README.md has the command that makes the README's sheet.
"""
import sys

from PIL import Image

CELL = (800, 600)


def main(sheet_path, columns, figure_paths):
    rows = -(-len(figure_paths) // columns)
    sheet = Image.new("RGB", (columns * CELL[0], rows * CELL[1]), "white")
    for i, path in enumerate(figure_paths):
        figure = Image.open(path).convert("RGB").resize(CELL, Image.LANCZOS)
        sheet.paste(figure, (i % columns * CELL[0], i // columns * CELL[1]))
    few_colours = sheet.quantize(256, kmeans=8, dither=Image.Dither.NONE)
    few_colours.save(sheet_path, optimize=True)


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(sys.argv[1], int(sys.argv[2]), sys.argv[3:])
