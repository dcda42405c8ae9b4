"""Compares simulated pings with real ones, figure by figure (comparison.py)."""
