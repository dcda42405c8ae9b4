"""The parts of a split: stretches of a trajectory, or whole variants."""
import math

PARTS = ("train", "val", "test")


def parse(text):
    """{"train": share, ...} of a text like train=0.8,val=0.2; ValueError for anything else."""
    try:
        pairs = [(name, float(share)) for name, share in (one.split("=") for one in text.split(","))]
    except ValueError:
        pairs = []
    shares = dict(pairs)
    if not len(pairs) == len(shares) > 0 or not set(shares) <= set(PARTS) or min(shares.values()) < 0:
        raise ValueError(f"--split: {text!r} must be shares of train, val and test, as in train=0.8,val=0.1,test=0.1")
    if not abs(sum(shares.values()) - 1) < 1e-6:
        raise ValueError(f"--split: the shares sum to {sum(shares.values()):g} and must sum to 1")
    return {name: shares[name] for name in PARTS if shares.get(name)}


def stretches(shares, count, gap, rounds):
    """The part of each of `count` poses or variants; None in the gaps. A part may get none."""
    parts, borders, begin = [None] * count, [], 0
    for one in range(rounds):
        first = count * one // rounds
        length = count * (one + 1) // rounds - first
        total = 0.0
        for part in shares:
            total += shares[part]
            end = math.floor(first + length * (1.0 if part == list(shares)[-1] else total) + 0.5)
            parts[begin:end] = [part] * (end - begin)
            if len(shares) > 1 and end < count:
                borders.append(end)
            begin = end
    for border in borders:
        for pose in range(max(border - gap // 2, 0), min(border + gap - gap // 2, count)):
            parts[pose] = None
    return parts


def poses_parts(shares, poses, gap, rounds):
    """The part of each pose. ValueError if a part gets none. `gap`: None for a tenth of the poses, at most 10."""
    parts = stretches(shares, poses, min(10, poses // 10) if gap is None else gap, rounds)
    for part in shares:
        if part not in parts:
            raise ValueError(f"--split: none of {poses} poses is left for {part!r}; take a smaller --gap, "
                             "fewer --rounds, or leave the part out")
    return parts


def variants_parts(shares, variants, rounds):
    """The part of each variant. Fewer variants than parts all belong to the first part."""
    if variants < len(shares):
        return [next(iter(shares))] * variants
    return stretches(shares, variants, 0, rounds)
