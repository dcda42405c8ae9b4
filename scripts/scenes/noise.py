"""Value noise of our own: the same numbers in every version of Python."""
import functools
import math


@functools.lru_cache(1 << 18)    # a lattice point has many points around it
def lattice(i, j, k, seed):
    """The number in [-1, 1) of a lattice point."""
    h = (i * 0x9E3779B1 ^ j * 0x85EBCA77 ^ k * 0xC2B2AE3D ^ seed * 0x27D4EB2F) & 0xFFFFFFFF
    h = ((h ^ (h >> 15)) * 0x2C1B3C6D) & 0xFFFFFFFF
    h = ((h ^ (h >> 12)) * 0x297A2D39) & 0xFFFFFFFF
    return (h ^ (h >> 15)) / 2147483648.0 - 1.0


def noise2(x, y, spacing, seed):
    """Smooth noise over the plane, one octave, in [-1, 1]; lattice points `spacing` apart."""
    x /= spacing
    y /= spacing
    i, j = math.floor(x), math.floor(y)
    u, v = x - i, y - j
    u *= u * (3 - 2 * u)
    v *= v * (3 - 2 * v)
    low, high = (lattice(i, at, 0, seed) * (1 - u) + lattice(i + 1, at, 0, seed) * u for at in (j, j + 1))
    return low * (1 - v) + high * v


class Relief:
    """Octaves of noise, each half as wide and half as high as the one before."""

    def __init__(self, spacing, amplitude, octaves, seed):
        self.octaves = [(amplitude / 2**n, spacing / 2**n, seed + n) for n in range(octaves)]

    def __call__(self, x, y):
        return sum(amplitude * noise2(x, y, spacing, seed) for amplitude, spacing, seed in self.octaves)


def noise3(p, spacing, seed):
    """Smooth noise in space, in [-1, 1]."""
    i, j, k = (math.floor(c / spacing) for c in p)
    u, v, w = (c / spacing - i for c, i in zip(p, (i, j, k)))
    u, v, w = (c * c * (3 - 2 * c) for c in (u, v, w))
    total = 0.0
    for c, upper in ((k, 1 - w), (k + 1, w)):
        for b, inner in ((j, 1 - v), (j + 1, v)):
            total += (1 - u) * inner * upper * lattice(i, b, c, seed)
            total += u * inner * upper * lattice(i + 1, b, c, seed)
    return total


class Draws:
    """Uniform random numbers in [low, high), one after the other."""

    def __init__(self, seed):
        self.seed = seed
        self.count = 0

    def __call__(self, low, high):
        self.count += 1
        return low + (high - low) * (lattice(self.count, 1, 2, self.seed) + 1) / 2
