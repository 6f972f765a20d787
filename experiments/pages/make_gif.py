#!/usr/bin/python3
"""A GIF of the pictures in a folder, in their order: make_gif.py FOLDER RATE WIDTH OUT.gif"""

import pathlib
import sys

import numpy as np
from PIL import Image

folder, out = pathlib.Path(sys.argv[1]), sys.argv[4]
rate, width = float(sys.argv[2]), int(sys.argv[3])
pictures = [Image.open(path).convert("RGB") for path in sorted(folder.glob("*.png"))]
pictures = [p.resize((width, round(p.height * width / p.width)), Image.LANCZOS) for p in pictures]
# One palette for all, of some pictures below each other, so that nothing flickers; a part of it for what is
# small and bright: feet and footprints.
some = np.concatenate([np.asarray(p) for p in pictures[:: max(1, len(pictures) // 6)]])
bright = some[some.max(axis=2).astype(int) - some.min(axis=2) > 90]
colours = [Image.fromarray(pixels).quantize(count).getpalette()[: 3 * count]
           for pixels, count in ((some, 96), (bright[: len(bright) // 64 * 64].reshape(-1, 64, 3), 32))]
palette = Image.new("P", (1, 1))
palette.putpalette(sum(colours, []))
frames = [p.quantize(palette=palette, dither=Image.Dither.NONE) for p in pictures]
frames[0].save(out, save_all=True, append_images=frames[1:], duration=round(1000 / rate), loop=0,
               optimize=True)
print(f"{out}: {len(frames)} pictures, {pathlib.Path(out).stat().st_size / 1e6:.2f} MB")
