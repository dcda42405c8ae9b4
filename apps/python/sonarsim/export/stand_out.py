"""Whether an object stands out of its surroundings in a picture, by eye."""
import numpy as np
from PIL import Image, ImageFilter

REACH = 2       # pixels on either side whose mean an eye takes
MARGIN = 6      # the least width of the surroundings
MIDDLE = 64     # grey of a usual bed


class Greys:
    """The greys of a picture as an eye takes them; its surroundings are without the objects, which are masks, and the
    boxes of their shadows."""

    def __init__(self, pixels, masks, shadows):
        grey = Image.fromarray(np.ascontiguousarray(pixels)).convert("L")
        self.values = np.asarray(grey.filter(ImageFilter.BoxBlur(REACH)))
        self.height = grey.height
        marks = np.zeros(grey.width * grey.height, np.uint8)
        for mask in masks:
            marks[mask] = 255
        marks = Image.fromarray(np.ascontiguousarray(marks.reshape(grey.width, grey.height).T))
        near = np.asarray(marks.filter(ImageFilter.MaxFilter(2 * REACH + 1)))
        self.bare = (near == 0) & (np.asarray(grey) > 0)
        for left, right, top, bottom in filter(None, shadows):
            self.bare[top:bottom, left:right] = False

    def around(self, box):
        """The median grey around a box (left, right, top, bottom), as wide as half of it to each side, and how far the
        darkest tenth lies below it: so far grain alone rises above it, too. Bright things nearby do not matter."""
        left, right, top, bottom = box
        wide, high = max(MARGIN, (right - left) // 2), max(MARGIN, (bottom - top) // 2)
        window = slice(max(0, top - high), bottom + high), slice(max(0, left - wide), right + wide)
        bare = self.values[window][self.bare[window]]
        low, median = np.quantile(bare, (0.1, 0.5)).tolist() if bare.size else (0.0, 0.0)
        return median, median - low

    def difference(self, mask, box, shadow):
        """By how many greys the brightest tenth of a mask is above its surroundings and their grain, or the mean of it or
        of its shadow below these; as it looks on middle grey, since grain grows with the grey."""
        own, (median, grain) = self.values[mask % self.height, mask // self.height], self.around(box)
        found = [np.quantile(own, 0.9) - median - grain, median - own.mean()]
        if shadow:
            left, right, top, bottom = shadow
            found.append(self.around(shadow)[0] - self.values[top:bottom, left:right].mean())
        return float(max(found)) * 2 * MIDDLE / (MIDDLE + median)
