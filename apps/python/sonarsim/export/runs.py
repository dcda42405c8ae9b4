"""Masks as COCO's compressed runs, which count pixels down the columns of a picture.

A mask is held as the sorted numbers of its pixels, column * height + row.
"""
import numpy as np

from ..data import Damage

MAX_GROUPS = 7     # a run of 2^31 pixels takes fewer groups of five bits


def pixels_of(counts, width, height):
    """The pixels of a mask in a picture. Damage unless the runs fill the picture and hold a pixel."""
    codes = np.frombuffer(counts.encode("ascii", "replace"), np.uint8).astype(np.int64) - 48
    last = (codes & 0x20) == 0
    if not codes.size or codes.min() < 0 or codes.max() > 0x3F or not last[-1]:
        raise Damage("has a mask that is not in COCO's compressed runs")
    ends = np.flatnonzero(last) + 1
    begins = np.concatenate(([0], ends[:-1]))
    if (ends - begins).max() > MAX_GROUPS:
        raise Damage("has a mask with a run that is too long")
    group = np.arange(codes.size) - np.repeat(begins, ends - begins)
    runs = np.add.reduceat((codes & 0x1F) << 5 * group, begins)
    runs -= np.where(codes[ends - 1] & 0x10, 1 << 5 * (ends - begins), 0)
    # From the fourth run on the text holds the difference to the last but one.
    runs[1::2] = np.cumsum(runs[1::2])
    runs[2::2] = np.cumsum(runs[2::2])
    if runs[0] < 0 or (runs[1:] < 1).any() or runs.size < 2 or runs.sum() != width * height:
        raise Damage(f"has a mask that does not fit a picture of {width} x {height} pixels")
    borders = np.cumsum(runs)
    begins, lengths = borders[::2][:runs.size // 2], runs[1::2]
    within = np.arange(lengths.sum()) - np.repeat(np.cumsum(lengths) - lengths, lengths)
    return np.repeat(begins, lengths) + within


def counts_of(pixels, width, height):
    """The compressed runs of a mask."""
    begins = np.flatnonzero(np.diff(pixels, prepend=-2) != 1)
    ends = np.append(begins[1:], pixels.size)
    borders = np.stack((pixels[begins], pixels[ends - 1] + 1), 1).ravel()
    runs = np.diff(borders, prepend=0).tolist()
    if borders[-1] < width * height:
        runs.append(int(width * height - borders[-1]))
    text = []
    for k, run in enumerate(runs):
        left, more = run - (runs[k - 2] if k > 2 else 0), True
        while more:
            group = left & 0x1F
            left >>= 5
            more = left != (-1 if group & 0x10 else 0)
            text.append(chr(group + (0x20 if more else 0) + 48))
    return "".join(text)


def box_of(pixels, height):
    """The box (left, right, top, bottom) of a mask; right and bottom are past its last pixel."""
    rows = pixels % height
    return (int(pixels[0] // height), int(pixels[-1] // height) + 1, int(rows.min()), int(rows.max()) + 1)


def parts(pixels, height):
    """The parts of a mask, joined by sides, as masks; the largest comes first."""
    begins = np.flatnonzero((np.diff(pixels, prepend=-2) != 1) | (pixels % height == 0))     # runs within a column
    lengths = np.diff(begins, append=pixels.size)
    first = pixels[begins].tolist()
    end = (pixels[begins] + lengths).tolist()
    before = list(range(len(first)))        # a run of the same part; the first run of a part refers to itself

    def root(run):
        while before[run] != run:
            run = before[run]
        return run

    near = 0
    for run in range(len(first)):
        while end[near] + height <= first[run]:
            near += 1
        for other in range(near, run):
            if first[other] + height >= end[run]:
                break
            a, b = sorted((root(other), root(run)))
            before[b] = a
    owner = np.repeat([root(run) for run in range(len(first))], lengths)
    return sorted((pixels[owner == one] for one in np.unique(owner)), key=len, reverse=True)


def cut(pixels, height, frame):
    """The part of a mask in a frame (left, right, top, bottom), as a mask of a picture of the frame."""
    left, right, top, bottom = frame
    columns, rows = np.divmod(pixels, height)
    inside = (columns >= left) & (columns < right) & (rows >= top) & (rows < bottom)
    return (columns[inside] - left) * (bottom - top) + rows[inside] - top


def cut_box(box, frame):
    """The part of a box in a frame, in pixels of the frame; None if there is none."""
    left, right = max(box[0], frame[0]) - frame[0], min(box[1], frame[1]) - frame[0]
    top, bottom = max(box[2], frame[2]) - frame[2], min(box[3], frame[3]) - frame[2]
    return (left, right, top, bottom) if left < right and top < bottom else None


def outlines(pixels, height):
    """The outlines of a mask: for each part, joined by sides, its corners (x, y) clockwise. Holes are left out."""
    left, right, top, bottom = box_of(pixels, height)
    inside = np.zeros((bottom - top + 2, right - left + 2), bool)      # with a margin of one pixel
    inside[pixels % height - top + 1, pixels // height - left + 1] = True
    begins = inside.copy()
    begins[:, 1:] &= ~inside[:, :-1]            # pixels that an outline passes on their left, upwards
    grid = inside.tolist()
    walked, found = set(), []
    for y, x in np.argwhere(begins).tolist():
        if (x, y) in walked:
            continue
        corners = outline_from(grid, x, y, walked)
        area = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(corners, corners[1:] + corners[:1]))
        if area > 0:
            found.append([(x + left - 1, y + top - 1) for x, y in corners])
    return found


STEPS = ((1, 0), (0, 1), (-1, 0), (0, -1))      # right, down, left, up: a right turn adds 1
RIGHT_AHEAD = ((0, 0), (-1, 0), (-1, -1), (0, -1))
LEFT_AHEAD = ((0, -1), (0, 0), (-1, 0), (-1, -1))


def outline_from(grid, x, y, walked):
    """Follows the outline that runs up the left side of a pixel, with the mask on its right."""
    corners, start, heading = [], (x, y + 1), 3
    x, y = start
    while True:
        if heading == 3:
            walked.add((x, y - 1))
        x, y = x + STEPS[heading][0], y + STEPS[heading][1]
        before = heading
        if not grid[y + RIGHT_AHEAD[before][1]][x + RIGHT_AHEAD[before][0]]:
            heading = (before + 1) % 4
        elif grid[y + LEFT_AHEAD[before][1]][x + LEFT_AHEAD[before][0]]:
            heading = (before + 3) % 4
        if heading != before:
            corners.append((x, y))
        if (x, y) == start and heading == 3:
            return corners


def min_rectangle(corners):
    """The four corners of the rectangle of least area around points (x, y). One of its sides lies on their hull."""
    hull = []
    for ring in (sorted(set(corners)), sorted(set(corners), reverse=True)):     # the lower side, then the upper one
        start = len(hull)
        for x, y in ring:
            while len(hull) > start + 1 and ((hull[-1][0] - hull[-2][0]) * (y - hull[-2][1])
                                             <= (hull[-1][1] - hull[-2][1]) * (x - hull[-2][0])):
                hull.pop()
            hull.append((x, y))
    hull = np.array(hull, float)        # closed, each point where the sides meet twice or more
    along = np.diff(hull, axis=0)
    along = along[along.any(axis=1)]
    along /= np.linalg.norm(along, axis=1)[:, None]
    turns = np.stack([along, along[:, ::-1] * (-1, 1)], axis=1)     # [side, axis, x or y]
    seen = turns @ hull.T
    low, high = seen.min(axis=2), seen.max(axis=2)
    best = np.prod(high - low, axis=1).argmin()
    (a, b), (c, d) = zip(low[best], high[best])
    return [tuple(corner) for corner in np.array([(a, c), (b, c), (b, d), (a, d)]) @ turns[best]]


def joined(parts):
    """One outline that runs around several parts; lines without width join them."""
    corners = []
    for part in parts:
        corners += part + (part[:1] if len(parts) > 1 else [])
    return corners + [part[0] for part in parts[-2:0:-1]]
