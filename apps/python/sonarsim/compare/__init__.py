"""Compares simulated pings with real ones, figure by figure.

    from sonarsim.compare import compare_recordings
    comparison = compare_recordings(open_recording("pings"), open_recording("out/survey"))
    comparison.is_same, comparison.figures
"""
from .comparison import Comparison, compare_recordings

__all__ = ["Comparison", "compare_recordings"]
