"""Fits a preset to one part of the pings of a recording, and judges it by the other (command.py)."""
