"""Statistics of the amplitudes of homogeneous patches, [patch, range, column], one value for each patch.

Amplitudes of developed speckle are Rayleigh distributed: coefficient of variation 0.5227, Weibull shape 2, inverse K shape
0, skewness of logarithms -1.1395."""
import numpy as np

MIN_TREND = 0.15      # a trend that falls below this share of the mean is that of an edge
TINY = np.finfo(np.float32).tiny


def trend_basis(size):
    """Orthonormal surfaces of second order on a patch, [bin, surface]."""
    y, x = (axis.ravel() for axis in np.meshgrid(
        *(np.linspace(-1.0, 1.0, n) if n > 1 else np.zeros(1) for n in size), indexing="ij"))
    left, sizes, _ = np.linalg.svd(np.stack([np.ones_like(x), x, y, x * y, x * x, y * y], axis=1), full_matrices=False)
    return left[:, sizes > 1e-9]        # a patch of one column or row leaves no remainder


def detrended(patches, basis):
    """(amplitudes, trend, is_even): the amplitudes of powers over the surface of second order that fits them, with the
    mean square 1; the standard deviation of the surface over the mean; False where the surface falls to an edge."""
    power = patches.reshape(len(patches), -1).astype(np.float64)
    mean, surface = power.mean(axis=1), (power @ basis) @ basis.T
    is_even = (mean > 0.0) & (surface.min(axis=1) > MIN_TREND * mean)
    with np.errstate(invalid="ignore", divide="ignore"):
        flat = power / surface
        amplitude = np.sqrt(flat / flat.mean(axis=1, keepdims=True))
        return amplitude.reshape(patches.shape), surface.std(axis=1) / mean, is_even


def variation(amplitude):
    """The standard deviation over the mean."""
    return amplitude.std(axis=(1, 2)) / amplitude.mean(axis=(1, 2))


def skewness(amplitude):
    """Of the logarithms of the amplitudes above 0: -1.1395 for Rayleigh, near 0 for the largest of several samples."""
    is_above, logs, mean = logarithms(amplitude)
    off, count = is_above * (logs - mean[:, None]), is_above.sum(axis=1)
    return (off ** 3).sum(axis=1) / count / ((off ** 2).sum(axis=1) / count) ** 1.5


def logarithms(amplitude):
    """(is_above, logs, their mean): the logarithms of the amplitudes above 0, 0 for the others, [patch, bin]."""
    flat = amplitude.reshape(len(amplitude), -1)
    is_above = flat >= TINY
    logs = np.log(np.where(is_above, flat, 1.0))
    return is_above, logs, logs.sum(axis=1) / is_above.sum(axis=1)


def weibull_shape(amplitude):
    """The k of greatest likelihood, from 0.2 to 12, by Newton's method: sum(A^k ln A) / sum(A^k) - 1/k = mean(ln A)."""
    is_above, logs, mean = logarithms(amplitude)
    largest = np.where(is_above, logs, -np.inf).max(axis=1)
    below = np.where(is_above, largest[:, None] - logs, 0.0)
    shape = np.full(len(logs), 2.0)
    for _ in range(12):
        weight = is_above * np.exp(-shape[:, None] * below)
        first, second = ((weight * below ** power).sum(axis=1) / weight.sum(axis=1) for power in (1, 2))
        step = (largest - first - 1.0 / shape - mean) / (second - first ** 2 + shape ** -2.0)
        shape = np.clip(shape - step, np.maximum(0.5 * shape, 0.2), np.minimum(2.0 * shape, 12.0))
    return np.where(below.max(axis=1) > 0.0, shape, np.nan)


def inverse_k_shape(amplitude, looks=1.0):
    """1/nu of K-distributed amplitudes by Blacknell and Tough's moment E[I ln I] / E[I] - E[ln I] = 1/looks + 1/nu."""
    is_above, logs, mean = logarithms(amplitude)
    power = is_above * np.exp(2.0 * logs)
    return 2.0 * (power * logs).sum(axis=1) / power.sum(axis=1) - 2.0 * mean - 1.0 / looks


def correlation_of(one, other):
    """The correlation of patches of the same places in two pings."""
    one, other = (a - a.mean(axis=(1, 2), keepdims=True) for a in (one, other))
    return (one * other).mean(axis=(1, 2)) / np.sqrt((one ** 2).mean(axis=(1, 2)) * (other ** 2).mean(axis=(1, 2)))


def correlation(amplitude, lag, axis):
    """The correlation of amplitudes that lie `lag` bins apart along an axis: 1 ranges, 2 columns."""
    if amplitude.shape[axis] <= lag:
        return np.full(len(amplitude), np.nan)
    off = np.moveaxis(amplitude - amplitude.mean(axis=(1, 2), keepdims=True), axis, 1)
    return (off[:, :-lag] * off[:, lag:]).mean(axis=(1, 2)) / (off ** 2).mean(axis=(1, 2))
