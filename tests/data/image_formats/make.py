"""Makes the images of tests/data/image_formats: a plot, and the same plot with a moved point."""
import struct
import sys
import zlib
from pathlib import Path

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
from PIL import Image, ImageCms, ImageDraw, PngImagePlugin

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
    # As matplotlib writes it: with alpha and a resolution.
    Image.open(png).save(out / name / "plot.tif", compression="tiff_lzw", dpi=(100, 100), software="a program")
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
    frames[0].save(out / name / "film.webp", save_all=True, append_images=frames[1:], duration=300, lossless=True)
    # As pages.
    frames[0].save(out / name / "film.tif", save_all=True, append_images=frames[1:])
    # The same frames; the second is shown longer.
    frames[0].save(out / name / "slower.webp", save_all=True, append_images=[frames[2]],
                   duration=[300, 300 if name == "before" else 500], lossless=True)
    # More pixels than are held whole, of one bit each: a dot of two by two pixels.
    large = Image.new("1", (9000, 8000), 1)
    ImageDraw.Draw(large).line((0, 100, 9000, 7000), fill=0, width=7)
    if name == "after":
        ImageDraw.Draw(large).rectangle((8001, 931, 8002, 932), fill=0)
    large.save(out / name / "large.png")


def colours(**chunks):
    found = PngImagePlugin.PngInfo()
    for kind, data in chunks.items():
        found.add(kind.encode(), data)
    return found


def insert_chunk(file, kind, data):
    """After the header; Pillow writes only chunks that it knows."""
    whole, header = file.read_bytes(), 8 + 12 + 13
    chunk = struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    file.write_bytes(whole[:header] + chunk + whole[header:])


# One colour in several colour spaces.
flat = Image.new("RGB", (40, 30), (200, 100, 50))
profile = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
dated = profile[:24] + bytes(range(12)) + profile[36:]
other = ImageCms.ImageCmsProfile(ImageCms.createProfile("XYZ")).tobytes()
primaries = struct.pack(">8I", 31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000)
flat.save(out / "before/gamma.png")
flat.save(out / "after/gamma.png", pnginfo=colours(gAMA=struct.pack(">I", 100000)))
flat.save(out / "before/srgb.png")
flat.save(out / "after/srgb.png", pnginfo=colours(gAMA=struct.pack(">I", 45455), cHRM=primaries, sRGB=b"\0"))
flat.save(out / "before/wide.png", pnginfo=colours(sRGB=b"\0"))
flat.save(out / "after/wide.png")
insert_chunk(out / "after/wide.png", b"cICP", bytes([12, 13, 0, 1]))
flat.save(out / "before/profile.png", icc_profile=profile)
flat.save(out / "after/profile.png", icc_profile=other)
flat.save(out / "before/dated.png", icc_profile=profile)
flat.save(out / "after/dated.png", icc_profile=dated)
for kind, options in (("jpg", {}), ("webp", {"lossless": True}), ("tiff", {})):
    flat.save(out / f"before/profile.{kind}", icc_profile=profile, **options)
    flat.save(out / f"after/profile.{kind}", icc_profile=other, **options)
