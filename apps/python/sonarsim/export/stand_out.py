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
        self.grey = np.asarray(Image.fromarray(np.ascontiguousarray(pixels)).convert("L"))
        marks = np.zeros(self.grey.shape[::-1], np.uint8)
        for mask in masks:
            marks.ravel()[mask] = 255
        self.marks = marks.T
        self.shadows = [box for box in shadows if box]

    def within(self, box, margin=(0, 0)):
        """Greys in a box with a margin, and which of them belong to surroundings."""
        left, right, top, bottom = box
        left, top = max(0, left - margin[0]), max(0, top - margin[1])
        right, bottom = min(self.grey.shape[1], right + margin[0]), min(self.grey.shape[0], bottom + margin[1])
        window = slice(max(0, top - REACH), bottom + REACH), slice(max(0, left - REACH), right + REACH)
        greys, near = (np.asarray(Image.fromarray(np.ascontiguousarray(one[window])).filter(ImageFilter.BoxBlur(REACH)))
                       for one in (self.grey, self.marks))
        bare = (near == 0) & (self.grey[window] > 0)
        for one in self.shadows:
            bare[max(0, one[2] - window[0].start):max(0, one[3] - window[0].start),
                 max(0, one[0] - window[1].start):max(0, one[1] - window[1].start)] = False
        inner = (slice(top - window[0].start, bottom - window[0].start),
                 slice(left - window[1].start, right - window[1].start))
        return greys[inner], bare[inner]

    def around(self, box):
        """The median grey around a box (left, right, top, bottom), as wide as half of it to each side, and how far the
        darkest tenth lies below it: so far grain alone rises above it, too. Bright things nearby do not matter, nor does
        a slope of the grey, such as that towards the edge of a beam: half of it is taken from each side."""
        greys, bare = self.within(box, (max(MARGIN, (box[1] - box[0]) // 2), max(MARGIN, (box[3] - box[2]) // 2)))
        if not bare.any():
            return 0.0, 0.0
        own, places = greys[bare].astype(float), np.argwhere(bare)
        median = float(np.median(own))
        for at in places.T - np.median(places, 0)[:, None]:
            sides = [np.median(own[side]) if side.any() else median for side in (at < 0, at > 0)]
            own -= (sides[1] - sides[0]) * at / max(1.0, 2 * np.abs(at).mean())
        return median, median - float(np.quantile(own, 0.1))

    def difference(self, mask, box, shadow):
        """By how many greys the brightest tenth of a mask is above its surroundings and their grain, or the mean of it or
        of its shadow below these; as it looks on middle grey, since grain grows with the grey."""
        columns, rows = np.divmod(mask, len(self.grey))
        own, (median, grain) = self.within(box)[0][rows - box[2], columns - box[0]], self.around(box)
        found = [np.quantile(own, 0.9) - median - grain, median - own.mean()]
        if shadow:
            found.append(self.around(shadow)[0] - self.within(shadow)[0].mean())
        return float(max(found)) * 2 * MIDDLE / (MIDDLE + median)
