"""The page index.html that shows a dataset in a browser; `python3 -m sonarsim.gallery OUT` writes it."""
