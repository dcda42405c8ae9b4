"""What a mission with multipath refuses."""
import unittest

from sandbox import Sandbox


class Multipath(Sandbox):
    def test_columns_are_those_of_a_fan(self):
        for kind in ("sidescan", "echosounder"):
            self.write("mission.yaml", f"""\
scene: {{file: box.gltf, materials: materials.csv}}
trajectory: {{file: path.csv}}
sensors:
  one:
    kind: {kind}
    multipath: {{method: exact, columns_per_beam: 2}}
""")
            self.assert_refused(self.render(), "mission.yaml:6:", "columns_per_beam is for the beams of a fan")


if __name__ == "__main__":
    unittest.main()
