#!/usr/bin/python3
"""Reduces pictures to 256 colours in place, so that they stay small. usage: reduce_colors.py FOLDER

Takes the PNG files in FOLDER whose names begin with tutorial-.
"""
import glob
import os
import sys

from PIL import Image

for path in glob.glob(os.path.join(sys.argv[1], "tutorial-*.png")):
    picture = Image.open(path).convert("RGB")
    palette = picture.quantize(256, method=Image.Quantize.MEDIANCUT)
    picture.quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG).save(path, optimize=True)
