"""Writes the pictures and objects of datasets as a folder that a trainer opens: `sonarsim export`."""
