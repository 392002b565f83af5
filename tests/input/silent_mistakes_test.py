#!/usr/bin/env python3
"""Mistakes that would silently run another problem, or fail late: each is refused at its place at once."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, run


def exact_solution(label):
    """Returns a module that compares with 0, followed by the end of the section of modules."""
    return f'<Module name="exactSolution"><label>{label}</label><value>0</value></Module></DataAnalysis>'


class SilentMistakes(unittest.TestCase):
    def assert_refused(self, result, *sentences):
        self.assertEqual(result.code, 3, result.err)
        for sentence in sentences:
            self.assertIn(sentence, result.err)
        self.assertEqual((result.files, result.out), ([], ""))

    def assert_edited_is_refused(self, scene, before, after, *sentences, sets=()):
        """Runs a scene with `before` replaced by `after`; SCENE in an expected message stands for its file."""
        text = (ROOT / scene).read_text()
        self.assertIn(before, text)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "scene.ups")
            path.write_text(text.replace(before, after))
            result = run(path, *sets, outputs=True)
            self.assert_refused(result, *(sentence.replace("SCENE", str(path)) for sentence in sentences))

    def test_an_overridden_label_is_blamed_on_the_option(self):
        self.assert_refused(run("ups/mpm/sod.ups", "DataArchiver/save[1]/@label=p.foo", outputs=True),
                            "--set DataArchiver/save[1]/@label=p.foo: DataArchiver/save: no task")

    def test_a_reseeded_cell_with_more_than_max_particles(self):
        how = "MPM/gas_dynamics/redistribute/"
        sets = (how + "mode=reseed", how + "target_particles=5", how + "max_particles=8")
        plane, space = "Grid/Level/Box/resolution=[20,2,1]", "Grid/Level/Box/resolution=[20,2,2]"
        self.assert_refused(run("ups/mpm/sod_redistribute.ups", *sets, plane, outputs=True),
                            "ups/mpm/sod_redistribute.ups:57:8: MPM/gas_dynamics/redistribute: target_particles: 5 "
                            "per cell are rounded up to 9, 3 along each of 2 axes, but max_particles is 8; decrease "
                            "target_particles or increase max_particles")
        self.assertEqual(run("ups/mpm/sod_redistribute.ups", *sets, "Time/max_Timesteps=1").code, 0)
        self.assertEqual(run("ups/mpm/sod_redistribute.ups", *sets, space, "Time/max_Timesteps=1").code, 0)

    def test_exact_solutions_of_what_cannot_be_measured(self):
        label = "DataAnalysis/Module/label"
        self.assert_refused(run("ups/heat/sine.ups", label + "=c.temp", outputs=True),
                            f"{label}: found 'c.temp', expected 'c.temperature'")
        self.assert_edited_is_refused("ups/heat/sine.ups", "c.temperature</label>", "p.x</label>",
                                      f"SCENE:49:8: {label}: found 'p.x', expected 'c.temperature'")
        self.assert_edited_is_refused("ups/euler/sod.ups", "</DataAnalysis>", exact_solution("c.momentum"),
                                      "'c.momentum' is a vector: give its <component>, x, y or z")
        self.assert_edited_is_refused("ups/euler/sod.ups", "</DataAnalysis>", exact_solution("c.speed"),
                                      "found 'c.speed', expected 'c.density', 'c.internalEnergy', 'c.pressure' or "
                                      "'c.totalEnergy'")
        self.assert_edited_is_refused("ups/mpm/sod.ups", "</DataAnalysis>", exact_solution("g.mass"),
                                      "this component has no scalar cell or node variable without a material")

    def test_errors_measured_twice(self):
        self.assert_edited_is_refused("ups/heat/sine.ups", "</DataAnalysis>", exact_solution("c.temperature"),
                                      "SCENE:52:4: DataAnalysis/Module: a module above already measures the errors of "
                                      "'temperature, cell'; keep one")
        self.assert_edited_is_refused("ups/euler/sod.ups", "</DataAnalysis>", exact_solution("c.density"),
                                      "a module above already measures the errors of 'density, cell'")
        again = (ROOT / "ups/euler/sod.ups").read_text()
        again = again[again.index("  <Module"):again.index("</Module>") + 9]
        self.assert_edited_is_refused("ups/euler/sod.ups", "</DataAnalysis>", again + "</DataAnalysis>",
                                      "a module above already measures the errors of 'density, cell'")

    def test_starts_that_are_not_finite(self):
        self.assert_refused(run("ups/heat/sine.ups", "Heat/temperature=1/(x-0.0078125)", outputs=True),
                            "--set Heat/temperature=1/(x-0.0078125): Heat/temperature: it is inf K at (0.0078125, "
                            "0.5, 0.5), but must be finite everywhere")
        body = "Euler/geom_object[1]/"
        for change in ("velocity=[sqrt(x-.2),0,0]", "density=1/(x-.005)", "pressure=1/(x-.005)"):
            self.assert_refused(run("ups/euler/sod.ups", body + change, outputs=True),
                                f"--set {body}{change}: Euler/geom_object: density ",
                                "at (0.005, 0.5, 0.5); expected a positive density",
                                "and finite values")

    def test_starts_that_depend_on_time(self):
        gas = "MaterialProperties/MPM/material/geom_object[1]/"
        for scene, change in (("heat/sine", "Heat/temperature=sin(pi*x)+t"), ("mpm/sod", gas + "density=1+t"),
                              ("mpm/sod", gas + "velocity=[t,0,0]"), ("mpm/sod", gas + "pressure=1+t"),
                              ("euler/sod", "Euler/geom_object[2]/velocity=[0,0,t]")):
            path, formula = change.split("=")
            self.assert_refused(run(f"ups/{scene}.ups", change, outputs=True),
                                f"found '{formula}', expected a formula without t: it is evaluated only at the start")

    def test_boundary_conditions_that_contradict_each_other(self):
        def refused(before, after, *sentences, scene="ups/heat/sine.ups"):
            self.assert_edited_is_refused(scene, before, after, *sentences)
        cold = '<BCType id="all" label="Temperature" var="Dirichlet"><value>0</value></BCType>'
        plane = '<Face side="y-"><BCType id="all" label="Symmetric" var="symmetry"/>'
        refused(cold, cold + cold.replace("Dirichlet", "Neumann"),
                "SCENE:17:102: Grid/BoundaryConditions/Face/BCType: Temperature already has a condition on this face, "
                "at SCENE:17:24; keep one")
        refused(plane, plane.replace('symmetry"/>', 'Dirichlet"><value>3</value></BCType>'),
                "found label 'Symmetric' with var 'Dirichlet'; 'Symmetric' and 'symmetry' are allowed only together")
        refused(plane, plane.replace("Symmetric", "Temperature"), "found label 'Temperature' with var 'symmetry'")
        refused(plane, plane + cold, "this face is a symmetry plane: the only other condition that it allows is a "
                                     "Neumann condition of 0")
        refused(cold, cold.replace("0<", "[1,2,3]<"), "value: found '[1,2,3]', expected a number")
        refused("[2.576693,0,0]", "2.576693", "value: found '2.576693', expected three formulas, such as [a,b,c]",
                scene="ups/euler/shock_bubble.ups")
        refused('side="x-"', 'side="x+"', "SCENE:18:8: Grid/BoundaryConditions/Face: side x+ is given twice, the first "
                "time at SCENE:17:8")

    def test_bodies_without_a_particle_or_a_cell(self):
        right = "<min>[0.5,0,0]</min><max>[1,1,1]"
        sentence = "SCENE:69:10: geom_object: it has no particle: none of the points where particles start"
        for box in ("<min>[5,0,0]</min><max>[6,1,1]", "<min>[.501,0,0]</min><max>[.504,1,1]",
                    "<min>[.5,0,0]</min><max>[1,.4,1]"):
            self.assert_edited_is_refused("ups/mpm/sod.ups", right, box, sentence)
            self.assert_edited_is_refused("ups/mpm/sod_conserving.ups", right, box, "geom_object: it has no particle")
        self.assert_edited_is_refused("ups/euler/sod.ups", right, "<min>[.506,0,0]</min><max>[.509,1,1]",
                                      "Euler/geom_object: its shape contains no cell centre of the grid")

    def test_bodies_beside_the_grid_get_a_note(self):
        scene = (ROOT / "ups/solid/two_discs.ups").read_text()
        places = {"outside the grid": "[20,20,0]", "between the points where particles start": None}
        for what, centre in places.items():
            shape = (f"<box><min>{centre}</min><max>[21,21,1]</max></box>" if centre else
                     "<box><min>[.5,.5,0]</min><max>[.5001,.5001,.001]</max></box>")
            body = f"<geom_object>{shape}<res>[2,2,1]</res></geom_object>"
            edited = scene.replace("<geom_object>", body + "\n<geom_object>", 1)
            line = 1 + scene[:scene.index("<geom_object>")].count("\n")
            with self.subTest(what), tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder, "beside.ups")
                path.write_text(edited)
                result = run(path, options=("--check",))
                self.assertEqual(result.code, 0, result.err)
                said = result.out + result.err
                self.assertIn(f"beside.ups:{line}:", said)
                self.assertIn("has no particles: it is outside the grid, or too small for <res>", said)
                self.assertEqual(said.count("has no particles"), 1)

    def test_bodies_of_a_material_that_overlap_get_a_note(self):
        scene = (ROOT / "ups/solid/two_discs.ups").read_text()
        first = 1 + scene[:scene.index("<geom_object>")].count("\n")
        end = scene.index("</geom_object>") + len("</geom_object>")
        for x, overlaps in ((.2, True), (.5, False)):
            body = f"<geom_object><box><min>[{x},.2,0]</min><max>[{x + .3},.5,1]</max></box><res>[2,2,1]</res>" \
                   "<velocity>[0,0,0]</velocity></geom_object>"
            line = 1 + scene[:end].count("\n") + 1
            with self.subTest(x), tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder, "bodies.ups")
                path.write_text(scene[:end] + "\n" + body + scene[end:])
                result = run(path, options=("--check",))
                self.assertEqual(result.code, 0, result.err)
                said = result.out + result.err
                sentence = f"overlaps the geom_object of the same material on line {first}: particles of both"
                self.assertEqual(said.count(sentence), int(overlaps), said)
                self.assertEqual(f"bodies.ups:{line}:" in said, overlaps, said)

    def test_conditions_of_materials_that_are_not_there(self):
        """Until 30 November 2026, such a condition applied to nothing, so that a wall was an open side."""
        side = '<Face side="x-">', '<Face side="x-"><BCType id="7" label="Symmetric" var="symmetry"/>'
        alone = "BCType: there is no material 7: the only material has index 0"
        scenes = {"euler/sod": alone, "heat/sine": alone, "poisson/sine": alone, "mpm/sod": alone,
                  "solid/two_discs": "BCType: there is no material 7"}
        for scene, sentence in scenes.items():
            text = (ROOT / f"ups/{scene}.ups").read_text()
            line = 1 + text[:text.index(side[0])].count("\n")
            with self.subTest(scene):
                self.assert_edited_is_refused(f"ups/{scene}.ups", *side, f"SCENE:{line}:", sentence)

    def test_flows_along_a_periodic_axis_of_one_cell(self):
        """Until 30 November 2026, such components of velocities were dropped."""
        flat = "has a component along z, along which the grid has one cell and is periodic: give it 2 cells along z"
        for scene, body in (("euler/vortex", "Euler/geom_object[1]/velocity"),
                            ("ice/gresho_slow", "MaterialProperties/ICE/material/geom_object/velocity"),
                            ("ice/gresho_slow", "PhysicalConstants/gravity")):
            periodic = "Grid/Level/periodic=[1,1,1]"
            with self.subTest(body):
                self.assert_refused(run(f"ups/{scene}.ups", periodic, body + "=[0,0,.1]", outputs=True), body, flat)
                done = run(f"ups/{scene}.ups", periodic, body + "=[.1,0,0]", "Time/max_Timesteps=1")
                self.assertEqual(done.code, 0, done.err)

    def test_references_of_another_problem(self):
        riemann = "DataAnalysis/Module/"
        for scene in ("euler/sod", "mpm/sod", "mpm/sod_conserving"):
            self.assert_refused(run(f"ups/{scene}.ups", riemann + "gamma=1.9", outputs=True),
                                "DataAnalysis/Module: gamma: found 1.9, but the gas of the scene has 1.4")
        self.assert_refused(run("ups/euler/sod.ups", riemann + "normal=[0,1,0]", outputs=True),
                            "this grid does not use y")
        self.assert_refused(run("ups/euler/sod.ups", riemann + "diaphragm=5", outputs=True),
                            "diaphragm: 5 m along the normal is outside the grid, which extends from 0 to 1 m")
        self.assert_refused(run("ups/euler/smooth_wave.ups", "Grid/Level/Box/resolution=[1,50,1]", outputs=True),
                            "the wave moves along x, but this grid does not use x")

    def test_a_reference_starts_with_the_run(self):
        usual = run("ups/euler/sod.ups")
        later = run("ups/euler/sod.ups", "Time/initTime=.1", "Time/maxTime=.3")
        self.assertAlmostEqual(later.report["errors"]["density"]["cell"]["L1"],
                               usual.report["errors"]["density"]["cell"]["L1"], 12)

    def test_flags(self):
        self.assert_edited_is_refused("ups/mpm/sod.ups", "<outputInitTimestep/>",
                                      "<outputInitTimestep/><outputInitTimestep/>",
                                      "tag <outputInitTimestep> is given twice")
        for text, outputs in (("", 1), ("true", 1), ("false", 0)):
            result = run("ups/heat/sine.ups", "DataArchiver/outputInterval=0", "DataArchiver/outputLastTimestep=false",
                         "DataArchiver/outputInitTimestep=" + text, "Time/max_Timesteps=1", outputs=True)
            self.assertEqual(len([file for file in result.files if file.endswith(".h5")]), outputs, text + result.err)


if __name__ == "__main__":
    unittest.main()
