"""Widths of steps between bright and dark regions, as an object and its shadow.

A step d + (b - d) Phi((x - x0 - g y) / s) is fitted to the powers of a window by weighted least squares, in all windows at
once. The equations of the fit have the mean 0 at the true values for speckle of any law, so speckle hardly biases the width.
The numbers are chosen, except for the rise."""
import numpy as np
from scipy import special

from .figure import Figure

MOST_IMAGES = 32            # more images of the same places would add little
LEAST_CONTRAST = 4.0        # 6 dB
MOST_FULL = 0.03            # share of clipped bins
MOST_MISFIT = 0.25          # a quarter's mean off, by the bright level
WEIGHT_FLOOR = 0.1          # share of bright; dark skirts count less
RISE_10_TO_90 = 2.56310     # 2 x 1.28155 standard deviations
LEAST_SIGMA = 0.15          # bins; narrower steps look the same
MOST_REACH = 0.6            # a step's end from the middle, by half the window
FIT_STEPS = 15
FINE_ENOUGH = 0.01          # a hundredth of a bin, or of the width
MOST_CHANGE = np.array([np.inf, np.inf, 1.5, 0.3, 0.7])


def edge_figures(images, grid, zones):
    """The widths from 10 to 90 % of the rise, along range in metres and along bearing in degrees."""
    figures = []
    for name, along in (("edges: width, m", 0), ("edges: width, degrees", 1)):
        cells, windows = [], []
        for ping in range(0, len(images.powers), -(-len(images.powers) // MOST_IMAGES)):
            for ranges, beams, window in windows_of(images.powers[ping].astype(float), zones.nearest[0], grid.size, along):
                if (window >= images.full_power).mean() <= MOST_FULL:
                    cells.append((grid.place_of(ranges, beams), ping, beams))
                    windows.append(window)
        places, pings, beams = np.array(cells, int).reshape(-1, 3).T
        widths = widths_of_steps(np.array(windows)) if windows else np.zeros(0)
        if windows:
            widths *= np.degrees(np.abs(np.gradient(images.bearing_rad)))[beams] if along else images.range_step_m
        figures.append(Figure.of(name, "quantile", "tenth", places, pings, widths))
    return figures


def windows_of(image, begin, size, along):
    """Yields (range, beam, window [along, across]) about the steps of an image; axis 0 is along range. Windows lie at
    ranges from `begin` on, in strips across the step."""
    turned = image[begin:].T if along else image[begin:]
    length, width = size[::-1] if along else size
    half = length // 2
    for across in range(0, turned.shape[1] - width + 1 if width > 1 else 0, width):
        strip = turned[:, across:across + width]
        for middle in steps_in(strip.sum(axis=1), length):
            centre = across + width // 2
            place = (begin + centre, middle) if along else (begin + middle, centre)
            yield *place, strip[middle - half:middle + half]


def steps_in(line, length):
    """The middles of windows whose step is the greatest within half a window, and 6 dB between the outer quarters."""
    half, quarter, count = length // 2, length // 4, len(line)
    if count < 2 * half or quarter < 1:
        return []
    sums = np.concatenate([[0.0], np.cumsum(line)])
    middles = np.arange(half, count - half + 1)
    rise = np.zeros(count + 1)
    rise[middles] = np.abs(sums[middles + half] - 2.0 * sums[middles] + sums[middles - half])
    before = sums[middles - quarter] - sums[middles - half]
    after = sums[middles + half] - sums[middles + quarter]
    steep = np.maximum(before, after) >= LEAST_CONTRAST * np.minimum(before, after)
    padded = np.concatenate([rise, np.full(half, -1.0)])
    return [c for c in middles[steep] if padded[c - half:c + half + 1].argmax() == half]


def widths_of_steps(windows):
    """The widths of steps in windows [window, along, across], in bins; NaN where a window has none."""
    along, across = windows.shape[1:]
    cut = across // 2
    # The means of the two halves of each row make the fit faster, and still show a slant.
    power = np.stack([windows[:, :, :cut].mean(axis=2), windows[:, :, cut:].mean(axis=2)], axis=2)
    y = np.array([0.5 * (cut - across), 0.5 * cut])
    x = np.arange(along)[:, None] - 0.5 * (along - 1)
    variance = ((0.5 * across) ** 2 - 1.0) / 12.0       # of y within a half
    half, quarter = along // 2, along // 4
    levels = power[:, :quarter].mean(axis=(1, 2)), power[:, along - quarter:].mean(axis=(1, 2))
    bright = np.maximum(*levels)
    is_step = bright > 0.0
    scale = np.where(is_step, bright, 1.0)
    power = power / scale[:, None, None]
    p = np.zeros((len(power), 5))       # both levels, place, slant, logarithm of the width
    p[:, 0], p[:, 1] = levels / scale
    fitting = is_step.copy()
    for _ in range(FIT_STEPS):
        at = np.flatnonzero(fitting)
        if not at.size:
            break
        better = improved(power[at], p[at], x, y, variance)
        moved = np.abs(better - p[at])[:, 2:].max(axis=1)
        p[at] = better
        is_lost = ~np.isfinite(better).all(axis=1) | (np.abs(better[:, 2]) > half) | (better[:, 4] > np.log(half))
        is_step[at[is_lost]] = False
        fitting[at] = ~is_lost & (moved > FINE_ENOUGH)
    p[~is_step] = 0.0
    width = RISE_10_TO_90 * np.exp(p[:, 4])
    # Both levels have to show over the whole width of the window: a thin line is no step.
    reach = np.abs(p[:, 2]) + 0.5 * width + np.abs(p[:, 3]) * 0.5 * across
    off = power - model_of(p, x, y, variance)[0]
    quarters = np.arange(along) * 4 // along
    misfit = np.stack([off[:, quarters == k].sum(axis=(1, 2)) for k in range(4)], axis=1)
    fits = (np.abs(misfit) < MOST_MISFIT * 0.25 * 2 * along).all(axis=1)
    return np.where(is_step & (reach < MOST_REACH * half) & fits, width, np.nan)


def model_of(p, x, y, variance):
    """(mean power, its derivatives by the parameters) at each place of the windows, [window, along, half(, parameter)]."""
    low, high, place, slant, width = (column[:, None, None] for column in p.T)
    deviation = np.sqrt(np.exp(2.0 * width) + variance * slant ** 2)     # widened by the slant within a half
    z = np.clip((x - place - slant * y) / deviation, -8.0, 8.0)
    density = np.exp(-0.5 * z ** 2) / np.sqrt(2.0 * np.pi)
    share = special.ndtr(z)
    rise = high - low
    by_place = -rise * density / deviation
    slopes = np.stack([1.0 - share, share, by_place, by_place * y, -rise * density * z], axis=-1)
    return low + rise * share, slopes


def improved(power, p, x, y, variance):
    """The next step of the fit by Gauss and Newton's method."""
    mean, slopes = model_of(p, x, y, variance)
    error = np.maximum(mean, 0.0) + WEIGHT_FLOOR      # the standard deviation of speckle equals its mean
    scaled = (slopes / error[..., None]).reshape(len(p), -1, 5)
    right = np.einsum("wnk,wn->wk", scaled, ((power - mean) / error).reshape(len(p), -1))
    normal = scaled.swapaxes(1, 2) @ scaled
    normal[:, range(5), range(5)] *= 1.01
    normal[:, range(5), range(5)] += 1e-12
    better = p + np.clip(np.linalg.solve(normal, right[..., None])[..., 0], -MOST_CHANGE, MOST_CHANGE)
    better[:, 4] = np.maximum(better[:, 4], np.log(LEAST_SIGMA))
    return better
