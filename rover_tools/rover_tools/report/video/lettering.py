"""Text in a video's frames, in matplotlib's own font.

OpenCV draws outline fonts since version 5 only; its older fonts have ASCII alone.
"""

from __future__ import annotations

from functools import cache, lru_cache

import numpy as np
from matplotlib.font_manager import FontProperties, findfont
from numpy.typing import NDArray
from PIL import Image as Picture
from PIL import ImageDraw, ImageFont

from rover_tools.report.video.colours import Colour
from rover_tools.report.video.snapshot import Image

MASKS = 512  # texts that are kept; most stand in many frames


def write(
    picture: Image, text: str, at: tuple[int, int], size: int, colour: Colour, bold: bool = False
) -> int:
    """Write text into a picture, its baseline's begin at a column and row [px]; where it ends [px].

    What lies outside of the picture is left out.
    """
    column, row = at
    mask, above = _mask(text, size, bold)
    top = max(row - above, 0)
    part = picture[top : max(row - above + len(mask), 0), max(column, 0) :][:, : mask.shape[1]]
    share = mask[top - (row - above) :][: len(part), : part.shape[1], None]
    part[:] = np.rint(part + share * (np.array(colour) - part)).astype(np.uint8)
    return column + mask.shape[1]


@lru_cache(MASKS)
def _mask(text: str, size: int, bold: bool) -> tuple[NDArray[np.float32], int]:
    """How much of each pixel (height, width) the text covers, and the rows above its baseline."""
    font = _font(size, bold)
    above, below = font.getmetrics()
    strip = Picture.new("L", (max(1, round(font.getlength(text))), above + below))
    ImageDraw.Draw(strip).text((0, above), text, fill=255, font=font, anchor="ls")
    return np.asarray(strip, np.float32) / 255.0, above


@cache
def _font(size: int, bold: bool) -> ImageFont.FreeTypeFont:
    name = FontProperties(family="DejaVu Sans", weight="bold" if bold else "normal")
    return ImageFont.truetype(findfont(name), size)
