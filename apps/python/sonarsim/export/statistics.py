"""Counts of the exported pictures and objects, in all and for each part of the split."""
import collections

from ..tally import EDGES, Tally


class Statistics:
    def __init__(self, classes):
        self.parts = collections.defaultdict(lambda: Tally(classes))
        self.all = Tally(classes)
        self.left_out = {"pictures": 0, "pieces": 0}

    def add(self, piece):
        for tally in (self.all, self.parts[piece.part]):
            tally.add(piece.dataset, piece.objects)

    def as_json(self):
        return {"format": "sonarsim statistics", "format_version": 2, "edges": EDGES, "left_out": self.left_out,
                "all": self.all.as_json(), "parts": {name: one.as_json() for name, one in self.parts.items()}}

    def text(self):
        """A few lines for the terminal."""
        lines = [f"{name}: {one.pictures} pictures, {one.without_objects} of them without an object"
                 for name, one in self.parts.items()]
        rows = [[one["name"], len(one["objects"]), one["pictures"], one["annotations"], one["ignored"]]
                for one in self.all.classes]
        lines += ["  ".join(f"{cell!s:>11}" for cell in row)
                  for row in [["class", "objects", "pictures", "annotations", "ignored"], *rows]]
        return "\n".join(lines + [f"left out: {self.left_out['pictures']} pictures or tiles that are not in one part "
                                  f"of the split, {self.left_out['pieces']} pieces of objects that are too small"])
