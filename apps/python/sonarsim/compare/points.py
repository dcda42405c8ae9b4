"""Echoes of points that stand alone in the water: their widths and side lobes."""
import numpy as np
from scipy import ndimage

from .figure import Figure, decibels

REACH = (9, 25)         # a point is the largest within 4 ranges and 12 beams
STANDS_OUT = 150.0      # 22 dB over the median of the 7 ranges about it
LOBES = np.array([-8, -7, -6, -5, 5, 6, 7, 8])


def point_figures(images, grid, zones):
    cells = []
    for ping, image in enumerate(images.powers):
        for i, j in points_of(image, *zones.nearest):
            lobes = image[i, np.clip(j + LOBES, 0, image.shape[1] - 1)].mean() / image[i, j]
            cells.append((grid.place_of(i, j), ping, width_of(image[i], j), width_of(image[:, j], i),
                          max(-120.0, float(decibels(lobes)))))
    places, pings, beams, ranges, lobes = np.array(cells).T if cells else np.zeros((5, 0))
    return [Figure.of("points: width, beams", "quantile", "tenth", places, pings, beams),
            Figure.of("points: width, ranges", "quantile", "tenth", places, pings, ranges),
            Figure.of("points: side lobes, dB", "quantile", "decibel", places, pings, lobes)]


def points_of(image, begin, end):
    """The (range, beam) of points, at least 20 beams, or an eighth of the fan, away from its edges."""
    ranges, beams = image.shape
    margin = min(20, beams // 8)
    is_point = (image > 0.0) & (image >= ndimage.maximum_filter(image, REACH, mode="nearest"))
    is_point[:max(begin, 1)] = is_point[min(end, ranges - 1):] = False
    is_point[:, :margin] = is_point[:, beams - margin:] = False
    found = []
    for i in np.flatnonzero(is_point.any(axis=1)) if beams >= REACH[1] - 1 else ():
        rows = image[max(0, i - 3):i + 4].ravel()
        median = np.partition(rows, rows.size // 2)[rows.size // 2]
        found += [(i, j) for j in np.flatnonzero(is_point[i] & (image[i] >= STANDS_OUT * median))]
    return found


def width_of(line, peak):
    """The width at half of the power, between bins linearly."""
    half, width = 0.5 * line[peak], 0.0
    for side in (line[peak::-1].astype(float), line[peak:].astype(float)):
        k = int(np.argmax(side <= half)) or len(side)
        width += k - 1 + ((side[k - 1] - half) / (side[k - 1] - side[k]) if k < len(side) else 0.0)
    return width
