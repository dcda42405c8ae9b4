"""Compares simulated pings with real ones, figure by figure."""
from .comparison import Comparison, compare_recordings

__all__ = ["Comparison", "compare_recordings"]
