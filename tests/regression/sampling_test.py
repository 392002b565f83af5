#!/usr/bin/env python3
"""The modules minMax, lineExtract, planeExtract, planeAverage and vorticity: what they write agrees with the full
outputs, is the same on any layout and after a restart, and Uintah's names are understood."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from module_runs import SMALL, VORTEX, ModuleTest, np, sus, tushar
from sus import ROOT

CHANNEL = ROOT / "ups/ice/channel.ups"


def module(name, tags="", variables=("c.density", "c.velocity"), frequency="1e10"):
    looked_at = "".join(f'<analyze label="{label}"/>' if "=" not in label else f"<analyze {label}/>"
                        for label in variables)
    times = f"<samplingFrequency>{frequency}</samplingFrequency><timeStart>0</timeStart><timeStop>100</timeStop>"
    return f'<Module name="{name}">{times}<Variables>{looked_at}</Variables>{tags}</Module>'


def point(x, y, z):
    return f"[{x},{y},{z}]"


def extent(tag, name, start, end, more=""):
    return (f'<{tag} name="{name}"><startingPt>{point(*start)}</startingPt><endingPt>{point(*end)}</endingPt>{more}'
            f"</{tag}>")


LINES = ("<lines>" + extent("line", "along_x", (-5, 1, .3), (5, 1, .3)) +
         extent("line", "along_z", (0, 0, -1.25), (0, 0, 1.25), "<stepSize>.5</stepSize>") + "</lines>")
PLANES = "<planes>" + extent("plane", "part", (-2, -5, .3), (3, 5, .3)) + "</planes>"
VORTICITY = '<Module name="vorticity"/>'
ALL = (VORTICITY + module("minMax", variables=("c.density", "c.velocity", "vorticity")) + module("lineExtract", LINES) +
       module("planeExtract", PLANES) +
       module("planeAverage", '<planeOrientation>XZ</planeOrientation><weight label="c.density"/>',
              ('label="c.density" weighting="nCells"', 'label="c.pressure" weighting="mass"', "c.velocity")))


def numbers(text):
    """Returns the numbers of all lines that are not comments."""
    return [[float(word) for word in line.replace("[", " ").replace("]", " ").split()]
            for line in text.splitlines() if not line.startswith("#")]


class Sampling(ModuleTest):
    maxDiff = None

    def scene(self, modules, of=VORTEX, save=""):
        return self.with_modules(of, modules, save)

    def files_of(self, archive):
        found = {}
        for part in ("MinMax", "along_x", "along_z", "part", "planeAverage"):
            found.update({str(file.relative_to(archive)): file.read_text()
                          for file in (archive / part).rglob("*") if file.is_file()})
        return found

    def test_what_is_written_agrees_with_the_full_outputs(self):
        archive = self.run_in("whole", self.scene(ALL, save='<save label="vorticity"/>'), *SMALL)
        whole, files = tushar.open(archive), self.files_of(archive)
        steps = [whole[whole.steps.index(step)] for step in range(1, 11)]
        for label in ("c.density", "c.velocity", "vorticity"):
            rows = numbers(files[f"MinMax/L-0/{label}_0"])
            self.assertEqual(len(rows), 10)
            for row, step in zip(rows, steps):
                values = step["c.vorticity" if label == "vorticity" else label][:]
                flat = values.reshape(-1, values.shape[-1]) if values.ndim == 4 else values.reshape(-1, 1)
                np.testing.assert_allclose(row[1:], [*flat.min(axis=0), *flat.max(axis=0)], rtol=1e-14)
        places = {"along_x": [(3, 7, i) for i in range(12)], "along_z": [(k, 6, 6) for k in (0, 2, 4)]}
        for line, cells in places.items():
            names = {f"{line}/L-0/i{x}_j{y}_k{z}" for z, y, x in cells}
            self.assertEqual({name for name in files if name.startswith(line)}, names)
            for z, y, x in cells:
                text = files[f"{line}/L-0/i{x}_j{y}_k{z}"]
                self.assertEqual(text.split()[:6], ["#", "X_CC", "Y_CC", "Z_CC", "Timestep", "Time"])
                self.assertIn("c.density_0", text)
                expected = [[-5 + (x + .5) * 10 / 12, -5 + (y + .5) * 10 / 12, -1.25 + (z + .5) * 2.5 / 6, number + 1,
                             whole.times[whole.steps.index(number + 1)], step["c.density"][:][z, y, x],
                             *step["c.velocity"][:][z, y, x]] for number, step in enumerate(steps)]
                np.testing.assert_allclose(numbers(text), expected, rtol=1e-6, atol=1e-12)

    def test_planes_and_means_agree_with_the_full_outputs(self):
        archive = self.run_in("whole", self.scene(ALL), *SMALL)
        whole, files = tushar.open(archive), self.files_of(archive)
        for step in (1, 10):
            state = whole[whole.steps.index(step)]
            density, velocity, pressure = (state[name][:] for name in ("c.density", "c.velocity", "c.pressure"))
            rows = np.array(numbers(files[f"part/t{step:05}/L-0/0:c.velocity_0.dat"]))
            part = velocity[3, :, 3:10]
            self.assertEqual(rows.shape, (12 * 7, 6))
            np.testing.assert_allclose(rows[:, 3:], part.reshape(-1, 3), rtol=1e-14)
            np.testing.assert_allclose(rows[0, :3], [-5 + 3.5 * 10 / 12, -5 + .5 * 10 / 12, -1.25 + 3.5 * 2.5 / 6])
            means = np.array(numbers(files[f"planeAverage/t{step:05}/L-0/c.density_0"]))
            np.testing.assert_allclose(means[:, 1], -5 + (np.arange(12) + .5) * 10 / 12)
            np.testing.assert_allclose(means[:, 3], density.mean(axis=(0, 2)), rtol=1e-13)
            np.testing.assert_array_equal(means[:, 4], 72)
            by_mass = np.array(numbers(files[f"planeAverage/t{step:05}/L-0/c.pressure_0"]))
            np.testing.assert_allclose(by_mass[:, 3], pressure.sum(axis=(0, 2)) / density.sum(axis=(0, 2)), rtol=1e-13)
            sums = np.array(numbers(files[f"planeAverage/t{step:05}/L-0/c.velocity_0"]))
            np.testing.assert_allclose(sums[:, 3:], velocity.sum(axis=(0, 2)), rtol=1e-13)

    def test_a_variable_of_each_material_has_a_weighting_of_its_own(self):
        tags = module("planeAverage", "<planeOrientation>YZ</planeOrientation>",
                      ('label="c.mass" matl="0" weighting="nCells"', 'label="c.mass" matl="1"'))
        archive = self.run_in("two", self.scene(tags, ROOT / "ups/stability/water_air.ups"), "--set",
                              "Time/max_Timesteps=1")
        folder = archive / "planeAverage/t00001/L-0"
        heads = {file.name: file.read_text().splitlines()[2] for file in folder.iterdir()}
        self.assertEqual(heads, {"c.mass_0": "# X  Y  Z  average  nCells", "c.mass_1": "# X  Y  Z  sum"})

    def test_planes_of_several_levels_are_those_of_the_coarsest_cells(self):
        tags = module("planeAverage", "<planeOrientation>YZ</planeOrientation>",
                      ('label="c.density" weighting="nCells"', "c.totalEnergy"))
        archive = self.run_in("levels", self.scene(tags, ROOT / "ups/euler/blast_levels.ups"), "--set",
                              "Time/max_Timesteps=20")
        means = np.array(numbers((archive / "planeAverage/t00020/L-0/c.density_0").read_text()))
        np.testing.assert_allclose(means[:, 0], (np.arange(64) + .5) * 1.2 / 64, rtol=1e-12)
        self.assertEqual(set(means[:, 4]), {64})
        mass = float((archive / "TotalMass.dat").read_text().split()[-1])
        self.assertAlmostEqual(means[:, 3].mean() * 1.2 * 1.2 / mass, 1, delta=1e-12)
        self.assertGreater(np.ptp(means[:, 3]), 1e-3)

    def test_vorticity_is_that_of_the_velocity(self):
        archive = self.run_in("whole", self.scene(VORTICITY, save='<save label="vorticity"/>'), *SMALL)
        state = tushar.open(archive)[-1]
        velocity = state["c.velocity"][:]
        width = (2.5 / 6, 10 / 12, 10 / 12)  # of z, y, x

        def slope(component, axis):
            values = velocity[..., component]
            return (np.roll(values, -1, axis) - np.roll(values, 1, axis)) / (2 * width[axis])

        expected = np.stack([slope(2, 1) - slope(1, 0), slope(0, 0) - slope(2, 2), slope(1, 2) - slope(0, 1)], axis=-1)
        np.testing.assert_allclose(state["c.vorticity"][:], expected, atol=1e-13)
        self.assertGreater(np.abs(expected[..., 2]).max(), .5)

    def test_the_energy_of_a_gas_and_what_leaves_with_it(self):
        """A gas of 1 kg/m³, 1 Pa, c_v 2.5 J/(kg K) that goes through the grid at .5 m/s: E + p = 3.625 J/m³."""
        text = (ROOT / "ups/ice/sod.ups").read_text()
        text = text[:text.index("  <DataAnalysis>")] + text[text.index("</DataAnalysis>") + len("</DataAnalysis>"):]
        for side in "x-", "x+":
            text = text.replace(f'<Face side="{side}"><BCType id="all" label="Symmetric" var="symmetry"/></Face>', "")
        start, end = text.index("        <geom_object>"), text.rindex("</geom_object>") + len("</geom_object>")
        text = (text[:start] + '<geom_object><box label="all"><min>[-9,-9,-9]</min><max>[9,9,9]</max></box>'
                "<density>1</density><temperature>1</temperature><velocity>[0.5,0,0]</velocity></geom_object>" +
                text[end:])
        sides = '<Face side="x+" extents="entireFace"/><Face side="x-" extents="entireFace"/>'
        for tags, flow in ((sides, 0), ('<Face side="x+"/>', .5 * 3.625), ('<Face side="x-"/>', -.5 * 3.625)):
            times = "<samplingFrequency>1e9</samplingFrequency><timeStart>0</timeStart><timeStop>9</timeStop>"
            module_of = f'<Module name="firstLawThermo">{times}<controlVolume>{tags}</controlVolume></Module>'
            path = self.folder / "uniform.ups"
            path.write_text(text)
            archive = self.run_in(f"law{flow}", self.scene(module_of, path), "--set", "Time/max_Timesteps=3")
            rows = numbers((archive / "1stLawThermo.dat").read_text())
            self.assertEqual(len(rows), 3)
            for row in rows:
                np.testing.assert_allclose(row[1:4], [2.5, 0, 2.5], rtol=1e-13)
                self.assertAlmostEqual(row[4], flow, delta=1e-13)

    def test_the_mass_in_boxes_is_that_of_their_cells(self):
        boxes = "".join(f'<box label="{name}"><min>{low}</min><max>{high}</max></box>' for name, low, high in (
            ("all", "[-5,-5,-1.25]", "[5,5,1.25]"), ("part", "[-5,0,-1.25]", "[0,5,1.25]")))
        tags = module("controlVolFluxes", f"<controlVolumes>{boxes}</controlVolumes>")
        tags = tags[:tags.index("<Variables>")] + tags[tags.index("</Variables>") + len("</Variables>"):]
        archive = self.run_in("boxes", self.scene(tags), *SMALL, "--set", "Grid/Level/Box/patches=[2,3,1]")
        whole, volume = tushar.open(archive), 10 / 12 * 10 / 12 * 2.5 / 6
        files = {name: np.array(numbers((archive / f"{name}.dat").read_text())) for name in ("all", "part")}
        for row in range(10):
            density = whole[whole.steps.index(row + 1)]["c.density"][:]
            np.testing.assert_allclose(files["all"][row, 1], density.sum() * volume, rtol=1e-13)
            np.testing.assert_allclose(files["part"][row, 1], density[:, 6:, :6].sum() * volume, rtol=1e-13)
        np.testing.assert_allclose(files["all"][:, 2:5], 0, atol=1e-13)  # periodic: what leaves comes in
        self.assertEqual(files["part"].shape, (10, 11))
        self.assertGreater(files["part"][-1, 6], 0, "the flow goes along +x")

    def test_any_layout_and_a_restart_leave_the_same_bytes(self):
        files = 3 + 12 + 3 + 10 * 2 + 10 * 3
        self.assert_same_bytes_on_any_layout(self.scene(ALL), lambda found: self.assertEqual(len(found), files))

    def test_a_run_that_is_killed_leaves_the_same_bytes(self):
        self.assert_same_bytes_after_a_kill(self.scene(ALL.replace("1e10", "5")), steps=200, step=10)

    def test_uintahs_names_are_understood(self):
        modules = ('<Module name="vorticity"><material>gas</material></Module>' +
                   module("minMax", "<material>gas</material>", ('label="press_CC" matl="0"', "vel_CC", "vorticity",
                                                                 "uvel_FCME")))
        scene = self.scene(modules, CHANNEL, '<save label="vorticity"/><save label="press_CC"/>')
        few = ["--set", "Time/max_Timesteps=3", "--set", "DataArchiver/outputTimestepInterval=1", "--set",
               "DataArchiver/outputInterval=0"]
        ended = sus(scene, "--output", self.folder / "ice", *few, options=())
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn("'uvel_FCME' is left out, since no task computes it in this scene", ended.stderr + ended.stdout)
        archive = next((self.folder / "ice").glob("*.uda.000"))
        self.assertEqual(sorted(file.name for file in (archive / "MinMax/L-0").iterdir()),
                         ["press_CC_0", "vel_CC_0", "vorticity_0"])
        last = tushar.open(archive)[-1]
        least, greatest = numbers((archive / "MinMax/L-0/press_CC_0").read_text())[-1][1:]
        pressure = last["c.pressure"][:]
        np.testing.assert_allclose((least, greatest), (pressure.min(), pressure.max()), rtol=1e-15)  # 16 digits
        self.assertEqual(last["c.vorticity"].shape[-1], 3, "in two axes, too")

    def test_the_only_material_goes_by_any_name(self):
        modules = ('<Module name="vorticity"><material>air</material></Module>' +
                   module("minMax", "<material>air</material>", ("press_CC", "vel_CC")))
        ended = sus(self.scene(modules, CHANNEL), "-check", options=())
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertEqual((ended.stderr + ended.stdout).count("'air' is taken to mean the only material, 'gas'"), 1)

    def test_what_a_module_cannot_show_is_refused(self):
        wrong = {
            module("minMax", variables=("c.densty",)): "computes 'c.densty' (did you mean 'c.density'?)",
            module("minMax", "<material>air</material>"):
                "there is no material 'air': the variables of this component belong to no material",
            module("minMax", variables=('label="c.density" matl="2"',)):
                "there is no material 2; materials are numbered from 0 to 0",
            module("minMax", variables=("TotalMass",)):
                "found 'TotalMass', expected a cell variable (c.) or a node variable (g.)",
            module("minMax", variables=()): "analyze",
            module("minMax").replace("<timeStop>100<", "<timeStop>-1<"): "expected timeStart, 0 s, or later",
            module("minMax").replace("1e10", "0"): "found '0', expected a value greater than 0",
            module("minMx"): "did you mean 'minMax'?",
            module("lineExtract"): "lines",
            module("lineExtract", "<lines>" + extent("line", "a", (0, 0, 0), (1, 1, 0)) + "</lines>"):
                "a line is parallel to one axis",
            module("lineExtract", "<lines>" + extent("line", "a", (0, 0, 0), (9, 0, 0)) + "</lines>"):
                "found x from 0 to 9 m, expected positions on the grid, from -5 to 5 m",
            module("lineExtract", "<lines>" + 2 * extent("line", "a", (0, 0, 0), (1, 0, 0)) + "</lines>"):
                "the name 'a' is given twice",
            module("lineExtract", "<lines>" + extent("line", "../a", (0, 0, 0), (1, 0, 0)) + "</lines>"):
                "expected the name of a folder, without '/'",
            module("planeExtract", "<planes>" + extent("plane", "a", (0, 0, 0), (1, 0, 0)) + "</planes>"):
                "a plane is parallel to two axes",
            module("planeAverage", "<planeOrientation>XX</planeOrientation>"): "found 'XX', expected",
            module("planeAverage", "<planeOrientation>XY</planeOrientation>",
                   ('label="c.density" weighting="mass"',)): 'missing tag <weight> in <Module>: weighting="mass"',
        }
        for tags, sentence in wrong.items():
            ended = sus(self.scene(tags), "-check")
            self.assertEqual(ended.returncode, 3, tags)
            self.assertIn(sentence, ended.stderr, tags)
        bodies = ROOT / "ups/fsi/cylinder.ups"
        gas = self.scene(module("minMax", "<material>nothing</material>", ("press_CC",)), bodies)
        self.assertIn("there is no material 'nothing'", sus(gas, "-check").stderr)
        curl = self.scene('<Module name="vorticity"><material>nothing</material></Module>', bodies)
        self.assertIn("material: found 'nothing', expected", sus(curl, "-check").stderr)
        heat = self.scene(VORTICITY, ROOT / "ups/heat/sine.ups")
        self.assertIn("no velocity of a gas in cells; remove the module", sus(heat, "-check").stderr)


class Twice(ModuleTest):
    """Two modules that write the same file, or compute the same variable, are refused with both places."""

    def refused(self, modules, *sentences, save=""):
        run = sus(self.with_modules(VORTEX, modules, save), "--output", self.folder / "out", *SMALL)
        self.assertEqual(run.returncode, 3, run.stderr)
        for sentence in sentences:
            self.assertIn(sentence, run.stderr)
        self.assertEqual(list(self.folder.glob("out/*.uda*")), [])

    def test_the_same_variable(self):
        for name, file in ({"minMax": "MinMax/c.density_0"} | {"lineExtract": "along_x/c.density_0"}).items():
            self.refused(module(name, LINES if name == "lineExtract" else "", ("c.density", "c.density")),
                         f"would overwrite '{file}' of the archive, which the tag at ")

    def test_two_modules_of_the_same_files(self):
        average = "<planeOrientation>{}</planeOrientation>"
        self.refused(module("planeAverage", average.format("XY")) + module("planeAverage", average.format("XZ")),
                     "would overwrite 'planeAverage/c.density_0' of the archive, which the tag at ",
                     "would overwrite 'planeAverage/c.velocity_0' of the archive")
        self.refused(module("lineExtract", LINES) + module("planeExtract", PLANES.replace('"part"', '"along_x"')),
                     "would overwrite 'along_x' of the archive, which the tag at ")
        slices = '<Module name="slice"><plane>z = 0</plane><label>c.density</label>' \
                 "<outputTimestepInterval>1</outputTimestepInterval></Module>"
        self.refused(slices + slices.replace("z = 0", "z=0.0"), "would overwrite 'slice/z=0' of the archive")

    def test_a_box_with_the_name_of_a_saved_global(self):
        box = '<Module name="controlVolFluxes"><samplingFrequency>1e10</samplingFrequency><timeStart>0</timeStart>' \
              '<timeStop>9</timeStop><controlVolumes><box label="TotalMass"><min>[-1,-1,-1]</min><max>[1,1,1]</max>' \
              "</box></controlVolumes></Module>"
        self.refused(box, "would overwrite 'TotalMass.dat' of the archive, which the saved 'TotalMass' needs; keep "
                     "one, or choose another name", save='<save label="TotalMass"/>')
        self.refused(box.replace("TotalMass", "A") * 2, "a module above already computes 'flow of A'; keep one")

    def test_a_variable_that_two_modules_compute(self):
        self.refused(VORTICITY * 2, "a module above already computes 'c.vorticity'; keep one")

    def test_what_differs_by_its_material_or_folder_is_taken(self):
        self.run_in("both", self.with_modules(VORTEX, module("minMax") + module("lineExtract", LINES)), *SMALL)


if __name__ == "__main__":
    unittest.main()
