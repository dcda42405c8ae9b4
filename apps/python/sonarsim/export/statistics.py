"""Counts of the exported pictures and objects, in all and for each part of the split."""
import collections


class Tally:
    """Pictures and objects. Crowds count as ignored and nowhere else."""

    def __init__(self, classes):
        self.pictures = self.without_objects = 0
        self.classes = [{"name": name, "objects": set(), "pictures": 0, "annotations": 0, "ignored": 0} for name in classes]

    def add(self, dataset, objects):
        """Adds the objects that a picture of a dataset shows: their id, class (from 1 on) and iscrowd."""
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

    def as_json(self):
        return {"pictures": self.pictures, "without_objects": self.without_objects,
                "classes": [{**one, "objects": len(one["objects"])} for one in self.classes]}


class Statistics:
    def __init__(self, classes):
        self.parts = collections.defaultdict(lambda: Tally(classes))
        self.all = Tally(classes)
        self.left_out = {"pictures": 0, "faint": 0, "pieces": 0, "beds": 0}

    def add(self, piece):
        for tally in (self.all, self.parts[piece.part]):
            tally.add(piece.dataset, piece.objects)

    def as_json(self):
        return {"format": "sonarsim statistics", "format_version": 3, "left_out": self.left_out,
                "all": self.all.as_json(), "parts": {name: one.as_json() for name, one in self.parts.items()}}

    def text(self):
        lines = [f"{name}: {one.pictures} pictures, {one.without_objects} of them without an object"
                 for name, one in self.parts.items()]
        rows = [[one["name"], len(one["objects"]), one["pictures"], one["annotations"], one["ignored"]]
                for one in self.all.classes]
        lines += ["  ".join(f"{cell!s:>11}" for cell in row)
                  for row in [["class", "objects", "pictures", "annotations", "ignored"], *rows]]
        return "\n".join(lines + [f"left out: {self.left_out['pictures']} pictures or tiles that are not in one part "
                                  f"of the split, {self.left_out['faint']} faint objects, "
                                  f"{self.left_out['pieces']} pieces of objects that are too small, "
                                  f"{self.left_out['beds']} crops of the bed for which there was no room"])
