"""A mission with labels, and its page as `sonarsim gallery` writes it."""
import json
import re

from labelled import Labelled

VARY = """
variants: 3
vary:
  - {key: water.sound_speed_m_s, uniform: [1450, 1540]}
"""
# JavaScript that is true once the picture is there.
READY = "return image_of(url_of(view(), state.ping)).naturalWidth"


def json_in(page, element):
    text = re.search(rf'<script type="application/json" id="{element}">(.*?)</script>', page, re.DOTALL)
    return json.loads(text.group(1))


def dataset_of(page):
    return json_in(page, "dataset-0")


class GalleryCase(Labelled):
    def setUp(self):
        super().setUp()
        self.edit("mission.yaml", "  labels: true\n", "  labels: [coco]\n")

    def gallery(self, folder="out"):
        done = self.run_sonarsim("gallery", folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return (self.folder / folder / "index.html").read_text()

    def render_variants(self, *arguments):
        text = (self.folder / "mission.yaml").read_text()
        self.write("variants.yaml", text + VARY)
        done = self.run_sonarsim("render", "variants.yaml", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
