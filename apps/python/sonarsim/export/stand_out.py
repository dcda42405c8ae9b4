"""Whether an object stands out of its surroundings in a picture, by eye."""
import numpy as np
from PIL import Image, ImageFilter

REACH = 2       # pixels on either side whose mean an eye takes
MARGIN = 6      # the least width of the surroundings
MIDDLE = 64     # grey of a usual bed
GRAIN = 1.9     # depth of the darkest tenth of normal noise in median deviations: 1.28 / 0.67
CELL = 50       # pixels that one grain takes, two squares of the mean: few of them stand out by chance


class Greys:
    """The greys of a picture as an eye takes them; its surroundings are without the objects, which are masks, the boxes of
    their shadows and, but in strips, what is black, as beyond the view."""

    def __init__(self, pixels, masks, shadows, is_strip=False):
        self.grey = np.asarray(Image.fromarray(np.ascontiguousarray(pixels)).convert("L"))
        marks = np.zeros(self.grey.size, np.uint8)
        marks[np.concatenate(masks)] = 255
        self.is_strip = is_strip
        self.marks, self.bed = marks.reshape(self.grey.shape[::-1]).T, (self.grey > 0) | is_strip
        for left, right, top, bottom in filter(None, shadows):
            self.bed[top:bottom, left:right] = False

    def within(self, box, margin=(0, 0)):
        """Greys in a box with a margin, and which of them belong to surroundings."""
        left, right, top, bottom = box
        left, top = max(0, left - margin[0]), max(0, top - margin[1])
        right, bottom = min(self.grey.shape[1], right + margin[0]), min(self.grey.shape[0], bottom + margin[1])
        window = slice(max(0, top - REACH), bottom + REACH), slice(max(0, left - REACH), right + REACH)
        greys, near = (np.asarray(Image.fromarray(np.ascontiguousarray(one[window])).filter(ImageFilter.BoxBlur(REACH)))
                       for one in (self.grey, self.marks))
        inner = (slice(top - window[0].start, bottom - window[0].start),
                 slice(left - window[1].start, right - window[1].start))
        return greys[inner], ((near == 0) & self.bed[window])[inner]

    def around(self, box):
        """What lies around a box (left, right, top, bottom), as wide as half of it to each side, by the median and by a
        slope through the medians of halves: the level, a function of places; the median; by how much the darkest and the
        brightest half differ from the level; how far grain lies above it. Water and bed of a strip meet at a step, so there
        the halves count, and of both levels that with less grain; in fans light and shade are smooth, and both count."""
        margin = max(MARGIN, (box[1] - box[0]) // 2), max(MARGIN, (box[3] - box[2]) // 2)
        greys, bare = self.within(box, margin)
        places = np.argwhere(bare) + (max(0, box[2] - margin[1]), max(0, box[0] - margin[0]))
        own = greys[bare].astype(float)
        if not own.size:
            places, own = np.zeros((1, 2)), np.zeros(1)
        middle, median = np.median(places, 0), np.median(own)
        pairs = [(at <= 0, at >= 0, at) for at in (places - middle).T]
        slope = [(np.median(own[high]) - np.median(own[low])) / (at[high].mean() - at[low].mean() or 1) for low, high, at in pairs]
        halves = [half for pair in pairs for half in pair[:2]]

        def beside(slope):
            def level(places):      # ends at the greys that are there
                return (median + (places - middle) @ slope).clip(own.min(), own.max())

            rest = own - level(places)
            medians = [np.median(rest[half]) for half in halves]
            # Black water in one half is no grain of the other.
            grains = [np.median(np.abs(some - np.median(some))) for some in (rest, rest[halves[np.argmax(medians)]])]
            steps = (min(medians), max(medians)) if self.is_strip else (0.0, 0.0)
            return level, median, *steps, GRAIN * min(grains)

        levels = [beside(np.zeros(2)), beside(slope)]
        return [min(levels, key=lambda one: one[-1])] if self.is_strip else levels

    def above(self, box, rows, columns, level):
        """The greys at places of a box above the level around it."""
        return self.within(box)[0][rows - box[2], columns - box[0]] - level(np.stack((rows, columns), -1))

    def difference(self, mask, box, shadow):
        """By how many greys the brightest tenth of a mask is above each half of what is around, its grain and what few
        grains add by chance, or the mean of it or of its shadow below each half; as on middle grey: grain grows with it."""
        columns, rows = np.divmod(mask, len(self.grey))
        found = []
        for level, median, darkest, brightest, grain in self.around(box):
            own, chance = self.above(box, rows, columns, level), grain * np.sqrt(CELL / mask.size)
            found += [np.quantile(own, 0.9) - brightest - grain - chance, darkest - own.mean() - chance]
        for level, _, darkest, *_ in self.around(shadow) if shadow else ():
            found.append(darkest - self.above(shadow, *np.mgrid[shadow[2]:shadow[3], shadow[0]:shadow[1]], level).mean())
        return float(max(found)) * 2 * MIDDLE / (MIDDLE + float(median))
