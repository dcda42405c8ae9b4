"""Whether an object stands out of its surroundings in a picture, by eye."""
import numpy as np
from PIL import Image, ImageFilter

REACH = 2       # pixels on either side whose mean an eye takes
MARGIN = 6      # the least width of the surroundings
MIDDLE = 64     # grey of a usual bed
CELL = 50       # pixels that one grain takes, two squares of the mean: few of them stand out by chance


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

    def around(self, box, even):
        """Of the greys around a box (left, right, top, bottom), as wide as half of it to each side: the median, its slope
        by row and column, where it holds, and how far the darkest tenth lies below it: so far grain alone rises above it,
        too. The slope goes through the medians of both halves, so bright things nearby do not matter; 0 if not `even`."""
        margin = max(MARGIN, (box[1] - box[0]) // 2), max(MARGIN, (box[3] - box[2]) // 2)
        greys, bare = self.within(box, margin)
        if not bare.any():
            return 0.0, np.zeros(2), np.zeros(2), 0.0
        places = np.argwhere(bare) + (max(0, box[2] - margin[1]), max(0, box[0] - margin[0]))
        own, middle = greys[bare].astype(float), np.median(places, 0)
        median, slope = float(np.median(own)), np.zeros(2)
        for axis, at in enumerate((places - middle).T if even else ()):
            if (at < 0).any() and (at > 0).any():
                slope[axis] = (np.median(own[at > 0]) - np.median(own[at < 0])) / (at[at > 0].mean() - at[at < 0].mean())
        return median, slope, middle, median - float(np.quantile(own - (places - middle) @ slope, 0.1))

    def flat(self, box, rows, columns, around):
        """The greys at places of a box without the slope around it."""
        _, slope, middle, _ = around
        return self.within(box)[0][rows - box[2], columns - box[0]] - (np.column_stack((rows, columns)) - middle) @ slope

    def difference(self, mask, box, shadow):
        """By how many greys the brightest tenth of a mask is above its surroundings, their grain and what few grains add
        by chance, or the mean of it or of its shadow below these; as it looks on middle grey, since grain grows with the
        grey. An eye takes off an even slope of the surroundings, but not a step: the larger of both."""
        columns, rows = np.divmod(mask, len(self.grey))
        found = []
        for even in (False, True):
            around = median, _, _, grain = self.around(box, even)
            own, chance = self.flat(box, rows, columns, around), grain * np.sqrt(CELL / mask.size)
            found += [np.quantile(own, 0.9) - median - grain - chance, median - own.mean() - chance]
            if shadow:
                around = self.around(shadow, even)
                places = (one.ravel() for one in np.mgrid[shadow[2]:shadow[3], shadow[0]:shadow[1]])
                found.append(around[0] - self.flat(shadow, *places, around).mean())
        return float(max(found)) * 2 * MIDDLE / (MIDDLE + median)
