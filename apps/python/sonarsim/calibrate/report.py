"""The result of a calibration as a table and as JSON."""
import dataclasses

from .statistics import Bounded


@dataclasses.dataclass
class Calibration:
    name: str
    fitted: int         # pings
    judged: int
    figures: list       # (start, fitted pings, judged pings), each a Figure
    notes: list
    estimates: dict = dataclasses.field(default_factory=dict)   # key -> Bounded or a word

    def __post_init__(self):
        pairs = [(fitted.measured, judged.measured) for _, fitted, judged in self.figures]
        changed = sum(a.low > b.high or a.high < b.low for a, b in pairs)
        if 5 * changed > len(pairs):
            self.notes = [*self.notes, f"{changed} of {len(pairs)} figures of the judged pings lie outside the intervals "
                          "of the fitted ones: the scene or the sonar changed between them"]

    def agreements(self):
        """The number of figures that agree: of the start, of the fit with the fitted and with the judged pings."""
        return [sum(row[k].agrees for row in self.figures) for k in range(3)]

    def text(self):
        lines = [f"{self.name}: {self.fitted} pings fitted, {self.judged} judged", "",
                 *(f"  {key:28} {value}" for key, value in self.estimates.items()), "",
                 f"{'figure':46} {'start':>15} {'fit':>9} {'fitted pings':>28} {'':5} {'judged pings':>28}"]
        for start, fitted, judged in self.figures:
            lines.append(f"{judged.name:46} {number(start)} {verdict(start)} {number(judged)} "
                         f"{str(fitted.measured):>28} {verdict(fitted)} {str(judged.measured):>28} {verdict(judged)}")
        start, inside, outside = self.agreements()
        lines.append(f"{len(self.figures)} figures agree: {start} of the start, {inside} of the fit with the fitted "
                     f"pings, {outside} with the judged ones")
        return "\n".join([*lines, *(f"- {note}" for note in self.notes)])

    def json(self):
        def plain(value):
            return value._asdict() if isinstance(value, Bounded) else value

        def column(figure):
            return None if figure.predicted is None else {
                "predicted": figure.predicted, "measured": plain(figure.measured), "agrees": bool(figure.agrees)}
        return {"recording": self.name, "pings_fitted": self.fitted, "pings_judged": self.judged,
                "estimates": {key: plain(value) for key, value in self.estimates.items()},
                "figures": [{"figure": judged.name, "start": column(start), "in_sample": column(fitted),
                             "held_out": column(judged)} for start, fitted, judged in self.figures],
                "agree": dict(zip(("start", "in_sample", "held_out"), self.agreements())), "notes": self.notes}


def number(figure):
    return f"{'-' if figure.predicted is None else format(figure.predicted, '.4g'):>9}"


def verdict(figure):
    return f"{'-' if figure.predicted is None else 'yes' if figure.agrees else 'NO':>5}"
