#!/usr/bin/python3
"""A GIF of the pictures in a folder, in their order: make_gif.py FOLDER RATE WIDTH OUT.gif"""

import pathlib
import sys

from PIL import Image

folder, out = pathlib.Path(sys.argv[1]), sys.argv[4]
rate, width = float(sys.argv[2]), int(sys.argv[3])
pictures = [Image.open(path).convert("RGB") for path in sorted(folder.glob("*.png"))]
pictures = [p.resize((width, round(p.height * width / p.width)), Image.LANCZOS) for p in pictures]
# One palette for all, of some pictures beside each other, so that nothing flickers.
some = pictures[:: max(1, len(pictures) // 6)]
strip = Image.new("RGB", (width, some[0].height * len(some)))
for i, picture in enumerate(some):
    strip.paste(picture, (0, i * picture.height))
palette = strip.quantize(96)
frames = [p.quantize(palette=palette, dither=Image.Dither.NONE) for p in pictures]
frames[0].save(out, save_all=True, append_images=frames[1:], duration=round(1000 / rate), loop=0,
               optimize=True)
print(f"{out}: {len(frames)} pictures, {pathlib.Path(out).stat().st_size / 1e6:.2f} MB")
