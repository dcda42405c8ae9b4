"""Writes the pictures and objects of datasets as a folder that a trainer opens: `sonarsim export`.

    python3 -m sonarsim.export OUT... DEST --format coco|yolo|masks|webdataset

Needs numpy and Pillow.
"""
