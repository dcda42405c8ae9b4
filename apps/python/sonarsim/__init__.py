"""Sonar data in memory: the pings of a mission, with the same numbers as the files of `sonarsim render`.

    import sonarsim
    mission = sonarsim.open("mission.yaml", set={"seed": 3})
    ping = mission.ping(0, sensor="fls")
    ping.image                  # float32 [range, azimuth]
    ping.labels["class"]        # uint16 [range, azimuth], where output.labels asks for it
    ping.metadata["time_s"]
    for ping in mission:        # every ping of every sensor and variant
        ...

`sonarsim.data` reads written datasets; `sonarsim.torch` feeds a network on the fly. A mistake
in a mission is an InputError with the text of the command: file, line, what is wrong, what would be right.
"""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .mission import InputError, Mission, Ping, Sensor, Variants, __version__, load, open

__all__ = ["InputError", "Mission", "Ping", "Sensor", "Variants", "open"]


def __getattr__(name: str) -> Any:
    """Loads the compiled module when a name of it is asked for: the tools run without it."""
    if name not in (*__all__, "load", "__version__"):
        raise AttributeError(f"module 'sonarsim' has no {name!r}")
    from . import mission
    for one in (*__all__, "load", "__version__"):
        globals()[one] = getattr(mission, one)
    return globals()[name]


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__, "load", "__version__"})
