"""Makes the images of tests/data/image_formats: a plot, and the same plot with a moved point."""
import sys
from pathlib import Path

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
from PIL import Image

out = Path(sys.argv[1] if len(sys.argv) > 1 else ".")


def draw(file, moved, **options):
    figure, axes = plt.subplots(figsize=(2.4, 1.8), dpi=80)
    x = [0.1 * i for i in range(20)]
    axes.plot(x, [v * v for v in x])
    axes.plot([0.5], [2.0 if moved else 3.0], "o", color="black")
    figure.savefig(file, **options)
    plt.close(figure)


for name in ("before", "after", "again"):
    (out / name).mkdir(exist_ok=True)
for name, moved in (("before", False), ("after", True)):
    png = out / name / "plot.png"
    draw(png, moved)
    image = Image.open(png).convert("RGB")
    image.save(out / name / "plot.jpg", quality=85)
    image.save(out / name / "plot.webp", quality=85)
    image.save(out / name / "plot.tiff", compression="tiff_lzw")
    image.quantize(16).save(out / name / "plot.gif")
    image.resize((96, 72)).quantize(8).save(out / name / "plot.bmp")
    draw(out / name / "plot.pdf", moved, metadata={"CreationDate": None})
    png.unlink()
# Harmless: another quality of the same plot.
draw(out / "again/plot.png", False)
Image.open(out / "again/plot.png").convert("RGB").save(out / "again/plot.jpg", quality=95)
(out / "again/plot.png").unlink()
# Invisible over white: a white mark on a transparent ground, and none.
for name, mark in (("before", False), ("after", True)):
    image = Image.new("RGBA", (80, 60), (0, 0, 0, 0))
    if mark:
        for y in range(20, 40):
            for x in range(30, 50):
                image.putpixel((x, y), (255, 255, 255, 255))
    image.save(out / name / "transparent.png")
# Three frames, of which the second differs.
for name, shade in (("before", 200), ("after", 60)):
    frames = [Image.new("L", (60, 40), 255) for _ in range(3)]
    for number, frame in enumerate(frames):
        for y in range(10, 30):
            for x in range(10 + 10 * number, 30 + 10 * number):
                frame.putpixel((x, y), shade if number == 1 else 0)
    frames[0].save(out / name / "film.gif", save_all=True, append_images=frames[1:], duration=300)
    frames[0].save(out / name / "film.png", save_all=True, append_images=frames[1:], duration=300, format="PNG")
