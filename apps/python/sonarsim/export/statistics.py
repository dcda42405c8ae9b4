"""Counts of the exported pictures and objects, in all and for each part of the split."""
import bisect
import collections

EDGES = {
    "range_m": (1, 1.5, 2, 3, 5, 7, 10, 15, 20, 30, 50, 70, 100, 150, 200, 300, 500, 700, 1000),
    "area": (4, 16, 64, 256, 1024, 4096, 16384, 65536),
    "visible_share": (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9),
    "contrast_db": (-12, -9, -6, -3, 0, 3, 6, 9, 12, 15, 18)}


class Tally:
    """Pictures and objects. Crowds count as ignored and nowhere else."""

    def __init__(self, classes):
        self.pictures = self.without_objects = 0
        self.classes = [{"name": name, "objects": set(), "pictures": 0, "annotations": 0, "ignored": 0,
                         **{key: [0] * (len(edges) + 1) for key, edges in EDGES.items()}} for name in classes]

    def add(self, dataset, objects):
        """Adds the objects that a picture of a dataset shows: their id, class (from 1 on), iscrowd and facts."""
        self.pictures += 1
        shown = [one for one in objects if not one["iscrowd"]]
        self.without_objects += not shown
        for one in objects:
            self.classes[one["class"] - 1]["ignored"] += one["iscrowd"]
        for number in {one["class"] for one in shown}:
            self.classes[number - 1]["pictures"] += 1
        for one in shown:
            counts = self.classes[one["class"] - 1]
            counts["annotations"] += 1
            counts["objects"].add((dataset, one["id"]))
            for key, edges in EDGES.items():
                if one.get(key) is not None:
                    counts[key][bisect.bisect_right(edges, one[key])] += 1

    def as_json(self):
        return {"pictures": self.pictures, "without_objects": self.without_objects,
                "classes": [{**one, "objects": len(one["objects"])} for one in self.classes]}


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
