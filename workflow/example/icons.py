#!/usr/bin/python3
"""Draws the icons of the modules and of the extension. usage: icons.py

The icons are 128 pixels wide, like those in Slicer's templates. Most strokes are at least 6 pixels wide, so that the
icons stay legible at the 32 and 21 pixels of Slicer's tool bars.
"""
import math
import os

from PIL import Image, ImageDraw

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
SIZE = 128
SUPERSAMPLING = 8
INK = (34, 38, 46)
RED, ORANGE, SAND, PALE = (214, 72, 54), (240, 148, 84), (250, 206, 140), (255, 238, 210)
BLUES = (150, 186, 226), (92, 142, 198), (56, 98, 152)
REDS = (246, 170, 140), (228, 104, 78), (176, 60, 46)


class Canvas:
    """Draws shapes in a square of 128 x 128 pixels whose origin is at the top left."""

    def __init__(self):
        self.image = Image.new("RGBA", (SIZE * SUPERSAMPLING,) * 2)
        self.draw = ImageDraw.Draw(self.image)

    def polygon(self, points, fill=None, stroke=0.0, color=INK):
        scaled = [(x * SUPERSAMPLING, y * SUPERSAMPLING) for x, y in points]
        if fill:
            self.draw.polygon(scaled, fill=fill)
        if stroke:
            self.line(points + points[:1], stroke, color)

    def line(self, points, stroke, color=INK):
        scaled = [(x * SUPERSAMPLING, y * SUPERSAMPLING) for x, y in points]
        self.draw.line(scaled, fill=color, width=round(stroke * SUPERSAMPLING), joint="curve")
        for x, y in points:
            self.disc((x, y), stroke / 2, color)

    def disc(self, centre, radius, fill):
        x, y = centre
        box = [(c + s * radius) * SUPERSAMPLING for s in (-1, 1) for c in (x, y)]
        self.draw.ellipse(box, fill=fill)

    def save(self, path):
        small = self.image.resize((SIZE, SIZE), Image.LANCZOS)
        small.save(os.path.join(ROOT, path), optimize=True)


def surgical_path_scale():
    """Draws a target at the end of a path, and edge lengths that increase around the target."""
    canvas = Canvas()
    target = (52, 52)
    canvas.disc((64, 64), 62, INK)
    for radius, color in ((56, PALE), (44, SAND), (31, ORANGE)):
        shift = (64 - target[0]) * (radius - 31) / 25  # the outermost ring is concentric with the icon
        centre = (target[0] + shift, target[1] + shift)
        canvas.disc(centre, radius, color)
    canvas.line([target, (78, 84), (114, 118)], 15, (255, 255, 255))
    canvas.line([target, (78, 84), (114, 118)], 9)
    canvas.disc(target, 19, (255, 255, 255))
    canvas.disc(target, 15, RED)
    canvas.save("SurgicalPathScale/Resources/Icons/SurgicalPathScale.png")


def hexagon(radius, turn=0.0, centre=(64, 64)):
    return [(centre[0] + radius * math.sin(math.tau * (i + turn) / 6),
             centre[1] - radius * math.cos(math.tau * (i + turn) / 6)) for i in range(6)]


def simplex_mesher():
    """Draws triangles of two tissues that share their boundary."""
    canvas = Canvas()
    outer, centre = hexagon(60, 0.5), (64, 64)
    shades = (REDS[2], BLUES[2], BLUES[1], BLUES[0], REDS[0], REDS[1])
    for i, shade in enumerate(shades):
        canvas.polygon([outer[i], outer[(i + 1) % 6], centre], shade)
    for corner in outer:
        canvas.line([corner, centre], 6, (255, 255, 255))
    canvas.polygon(outer, None, 7)
    canvas.line([outer[1], centre, outer[4]], 8)
    canvas.disc(centre, 8, INK)
    canvas.save("SimplexMesher/Resources/Icons/SimplexMesher.png")


def tetrahedron(canvas, apex, left, right, front, shades, stroke):
    canvas.polygon([apex, left, front], shades[0])
    canvas.polygon([apex, front, right], shades[2])
    canvas.line([apex, front], stroke)
    canvas.polygon([apex, left, front, right], None, stroke)


def fuchs_tetrahedralizer():
    """Draws a tetrahedron whose part at the apex has another colour: a child mesh in its parent."""
    canvas = Canvas()
    apex, left, right, front = (64, 7), (6, 88), (122, 88), (72, 121)
    tetrahedron(canvas, apex, left, right, front, BLUES, 7)
    part = 0.52
    small = [(apex[0] + part * (x - apex[0]), apex[1] + part * (y - apex[1])) for x, y in (left, right, front)]
    tetrahedron(canvas, apex, *small, REDS, 7)
    canvas.save("FuchsTetrahedralizer/Resources/Icons/FuchsTetrahedralizer.png")


def tissue_mapper():
    """Draws a head, one half as an image and the other half as tissues, with training points."""
    canvas = Canvas()
    canvas.disc((64, 64), 62, INK)
    greys, tissues = ((150,) * 3, (70,) * 3, (205,) * 3), (SAND, PALE, BLUES[1])
    for radius, grey, tissue in zip((55, 43, 33), greys, tissues):
        canvas.disc((64, 64), radius, grey)
        box = [(64 - radius) * SUPERSAMPLING, (64 + radius) * SUPERSAMPLING]
        canvas.draw.pieslice([box[0], box[0], box[1], box[1]], -90, 90, fill=tissue)
    canvas.line([(64, 9), (64, 119)], 6)
    for place, color in (((84, 54), BLUES[2]), ((82, 84), BLUES[2]), ((110, 78), RED), ((98, 30), RED)):
        canvas.disc(place, 9, (255, 255, 255))
        canvas.disc(place, 6, color)
    canvas.save("TissueMapper/Resources/Icons/TissueMapper.png")


def template_hex_mesher():
    """Draws a bent sheet of quadrilaterals in front of the same sheet before bending, and a pair of landmarks."""
    canvas = Canvas()
    grid = lambda x, y: (14 + 84 * x, 14 + 76 * y)  # noqa: E731
    bent = lambda x, y: (30 + 88 * x + 10 * math.sin(3 * y), 30 + 74 * y + 18 * math.sin(math.pi * x))  # noqa: E731
    for place, shades, stroke in ((grid, (BLUES[0], BLUES[0]), 4), (bent, (REDS[0], SAND), 6)):
        for i in range(3):
            for j in range(3):
                corners = [place((i + a) / 3, (j + b) / 3) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
                canvas.polygon(corners, shades[(i + j) % 2], stroke)
    for place, color in ((grid(0, 0), BLUES[2]), (bent(0, 0), RED)):
        canvas.disc(place, 11, (255, 255, 255))
        canvas.disc(place, 8, color)
    canvas.save("TemplateHexMesher/Resources/Icons/TemplateHexMesher.png")


def extension():
    """Draws a disc with triangles that become smaller towards a target."""
    canvas = Canvas()
    canvas.disc((64, 64), 63, INK)
    target = (64, 64)
    inner, middle, outer = hexagon(12), hexagon(28, 0.5), hexagon(56)
    for i in range(6):
        j = (i + 1) % 6
        canvas.polygon([outer[i], outer[j], middle[i]], BLUES[0] if i % 2 else BLUES[1])
        canvas.polygon([outer[j], middle[i], middle[j]], BLUES[1] if i % 2 else BLUES[2])
        canvas.polygon([middle[i], inner[i], inner[j]], REDS[1])
        canvas.polygon([middle[i], middle[j], inner[j]], REDS[0])
    for i in range(6):
        j = (i + 1) % 6
        for a, b in ((outer[i], outer[j]), (outer[i], middle[i]), (outer[j], middle[i]), (middle[i], middle[j])):
            canvas.line([a, b], 4)
        for a, b in ((middle[i], inner[i]), (middle[i], inner[j])):
            canvas.line([a, b], 3)
    canvas.disc(target, 16, (255, 255, 255))
    canvas.disc(target, 12, RED)
    canvas.save("SurgicalMesher.png")


if __name__ == "__main__":
    surgical_path_scale()
    simplex_mesher()
    fuchs_tetrahedralizer()
    tissue_mapper()
    template_hex_mesher()
    extension()
