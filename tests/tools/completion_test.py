#!/usr/bin/env python3
"""`sus --completion bash`: bash's suggestions after sus, from the function that the script defines."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, SUS

COMPLETE = """source "$1" || exit 9
COMP_LINE=$2 COMP_POINT=${#2}
read -ra COMP_WORDS <<<"$2"
[[ $2 == *" " ]] && COMP_WORDS+=("")
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
_sus
for word in "${COMPREPLY[@]}"; do printf '%s\\n' "$word"; done"""
SCENE = f"{SUS} ups/mpm/sod.ups "


class Completion(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.script = pathlib.Path(cls.folder.name, "sus.bash")
        done = subprocess.run([SUS, "--completion", "bash"], capture_output=True, text=True, check=True)
        cls.script.write_text(done.stdout)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def offered(self, line, folder=ROOT):
        done = subprocess.run(["bash", "-c", COMPLETE, "bash", self.script, line], cwd=folder, capture_output=True,
                              text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""), line)
        return done.stdout.splitlines()

    def test_bash_takes_the_script(self):
        said = subprocess.run(["bash", "-c", 'source "$1" && complete -p sus', "bash", self.script],
                              capture_output=True, text=True)
        self.assertEqual(said.stdout, "complete -F _sus sus\n")

    def test_options_with_one_dash_or_two(self):
        options = self.offered("sus --")
        for option in ("--set", "--restart", "--checkpoint", "--schema", "--describe", "--validate"):
            self.assertIn(option, options)
        self.assertNotIn("--paths", options)
        self.assertEqual(sorted(self.offered("sus ups/mpm/sod.ups -sc")), ["-schedule", "-schema"])

    def test_every_option_is_one_of_sus(self):
        manual = subprocess.run([SUS, "-h"], capture_output=True, text=True).stdout
        for option in self.offered("sus --"):
            self.assertIn(option, manual)

    def test_scenes_and_folders(self):
        self.assertEqual(sorted(self.offered("sus ups/mpm/sod_d")), ["ups/mpm/sod_diagonal.ups"])
        self.assertIn("ups/heat", self.offered("sus ups/h"))
        self.assertEqual(self.offered("sus ups/mpm/sod.p"), [])

    def test_manuals_and_schemas(self):
        self.assertEqual(sorted(self.offered("sus --describe m")),
                         ["manufacturedError", "massProjection", "minMax", "mpm", "mpmice"])
        self.assertIn("scene", self.offered("sus -describe "))
        self.assertEqual(self.offered("sus --schema "), ["rng", "xsd"])
        self.assertEqual(self.offered("sus --completion "), ["bash"])

    def test_paths_of_the_scene(self):
        self.assertEqual(self.offered(SCENE + "--set Time/"), ["Time/maxTime=", "Time/end_at_max_time_exactly="])
        self.assertIn("Grid/Level/Box/resolution=", self.offered(SCENE + "-set "))
        self.assertEqual(self.offered(SCENE + "--set Time/maxTime="), [])
        self.assertEqual(self.offered(f"{SUS} --set Time/"), [])

    def test_only_what_follows_the_last_break_is_offered(self):
        """bash replaces the part after the last = : or @."""
        self.assertEqual(self.offered(SCENE + "--set Grid/BoundaryConditions/Face[2]/@"), ["side="])

    def test_every_path_can_be_set(self):
        scene = "ups/solid/two_discs.ups"
        done = subprocess.run([SUS, "--paths", scene], cwd=ROOT, capture_output=True, text=True, check=True)
        paths = done.stdout.split()
        self.assertGreater(len(paths), 40)
        sets = [word for path in paths for word in ("--set", path + "=nonsense")]
        said = subprocess.run([SUS, "-check", scene, *sets], cwd=ROOT, capture_output=True, text=True).stderr
        for wrong in ("match; choose one", "expected PATH=VALUE", "expected Tag, Tag[2]"):
            self.assertNotIn(wrong, said)

    def test_paths_of_a_run(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([SUS, ROOT / "ups/heat/sine.ups", "--quiet", "--output", folder], check=True)
            archive = next(pathlib.Path(folder).glob("*.uda.*")).name
            self.assertIn("Heat/temperature=", self.offered(f"{SUS} -restart {archive} --set Heat/", folder))

    def test_a_scene_that_cannot_be_read_has_no_paths(self):
        done = subprocess.run([SUS, "--paths", "ups/none.ups"], cwd=ROOT, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (3, ""))


if __name__ == "__main__":
    unittest.main()
