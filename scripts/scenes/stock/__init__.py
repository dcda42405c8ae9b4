"""Kinds of things that lie under water, each drawn anew for each example: KIND_1 to KIND_6."""
import zlib

from . import household, marine
from .solids import Draw

EXAMPLES = 6
# The kinds that scene.clutter scatters by default.
CLUTTER = ("boulder_pile", "brick", "cable", "chain", "drag_mark", "frame", "net", "panel", "pipe", "plank", "plant", "rope",
           "stone", "tarpaulin", "weed", "wreckage")
KINDS = {kind.__name__: kind for kind in sorted(household.KINDS + marine.KINDS, key=lambda kind: kind.__name__)}


def example(kind, number):
    """The Parts of an example of a kind."""
    return KINDS[kind](Draw(zlib.crc32(f"{kind}_{number}".encode()) & 0x7FFFFFFF))


def files():
    """The name of each file with the function that builds it."""
    return {f"{kind}_{k}": lambda kind=kind, k=k: example(kind, k) for kind in KINDS for k in range(1, EXAMPLES + 1)}
