"""Counts by class of the objects in pictures, with histograms."""
import bisect

# The fact, its title and the edges of its intervals.
AXES = (("range_m", "range, m", (1, 2, 5, 10, 20, 50, 100)),
        ("area", "size, pixels or bins", (16, 64, 256, 1024, 4096)),
        ("contrast_db", "contrast, dB", (-10, -3, 0, 3, 6, 10, 20)),
        ("visible_share", "visible share", (0.1, 0.25, 0.5, 0.75, 0.9)))


class Tally:
    def __init__(self):
        self.pictures, self.empty, self.classes = 0, 0, {}

    def add(self, dataset, counted):
        """A picture: the class and the entry of each object in it."""
        self.pictures += 1
        self.empty += not counted
        for name, (label, facts, *_) in counted:
            one = self.classes.setdefault(name, {"objects": set(), "pictures": set(), "labels": 0, "bars": [
                [0] * (len(edges) + 1) for _, _, edges in AXES]})
            one["objects"].add((dataset, label))
            one["pictures"].add(self.pictures)
            one["labels"] += 1
            facts = {"area": facts.get("area_px", facts.get("area_bins"))} | facts
            for (fact, _, edges), bars in zip(AXES, one["bars"]):
                if isinstance(facts.get(fact), (int, float)):
                    bars[bisect.bisect_right(edges, facts[fact])] += 1

    def json(self):
        return {"pictures": self.pictures, "empty": self.empty, "classes": [
            [name, len(one["objects"]), len(one["pictures"]), one["labels"], one["bars"]]
            for name, one in self.classes.items()]}
