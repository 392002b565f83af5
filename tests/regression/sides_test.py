#!/usr/bin/env python3
"""Conditions on parts of sides, and formulas in them: results are bitwise equal to those of equivalent conditions on
whole sides, on any layout, ranks and levels and after a restart; inflows are those of the formulas."""
import pathlib
import re
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import SceneTest, archive_of, columns
from sus import ROOT, run
from uda import Folder

JET = (ROOT / "ups/ice/jet.ups").read_text()
SLOT = '<Face rectangle="x-" lower="0 -0.125 0" upper="0 0.125 1">'
SMALL = "Grid/Level/Box/resolution=[32,24,1]"
MIRROR = '<BCType id="all" label="Symmetric" var="symmetry"/>'


def steps(count):
    return f"Time/max_Timesteps={count}"


def gas(faces, amr="", cells="[12,12,12]", velocity="[0.1,0,0]"):
    """A gas in a box of 1 m, open wherever no side is given."""
    return f"""<Uintah_specification>
  <Meta><title>sides</title></Meta>
  <SimulationComponent type="euler"/>
  <Time><maxTime>0.5</maxTime><end_at_max_time_exactly>true</end_at_max_time_exactly></Time>
  <Grid>
    <BoundaryConditions>{faces}</BoundaryConditions>
    <Level><Box><lower>[0,0,0]</lower><upper>[1,1,1]</upper><resolution>{cells}</resolution></Box></Level>
  </Grid>
  {amr}
  <DataArchiver><filebase>sides.uda</filebase><outputInterval>0</outputInterval><outputLastTimestep/>
    <checkpoint timestepInterval="4"/><save label="c.density"/></DataArchiver>
  <Euler>
    <gas><gamma>1.4</gamma></gas>
    <geom_object><box><min>[0,0,0]</min><max>[1,1,1]</max></box>
      <density>1 + 0.2*sin(2*pi*x)</density><velocity>{velocity}</velocity><pressure>1</pressure></geom_object>
  </Euler>
</Uintah_specification>"""


def inflow(where, density="2", velocity="[1,0.1,0.2]"):
    return (f'<Face {where}><BCType label="Density" var="Dirichlet"><value>{density}</value></BCType>'
            f'<BCType label="Velocity" var="Dirichlet"><value>{velocity}</value></BCType></Face>')


ROUND = ('circle="x-" origin="0 0.5 0.5" radius="0.3"', 'annulus="y+" origin="0.5 1 0.5" inner_radius="0.1" '
         'outer_radius="0.35"', 'ellipse="z-" origin="0.5,0.5,0" minor_radius="0.2" major_radius="0.4" angle="30"')
JETS = "".join(map(inflow, ROUND)) + f'<Face side="x-">{MIRROR}</Face><Face side="y+">{MIRROR}</Face>'
LEVELS = ("<AMR><Regridder><adaptive>true</adaptive><max_levels>2</max_levels><min_timestep_interval>4"
          "</min_timestep_interval><min_patch_size>[[4,4,4]]</min_patch_size></Regridder><Euler>"
          '<Refinement_Criteria_Thresholds><Variable name="c.density" value=".3"/></Refinement_Criteria_Thresholds>'
          "</Euler></AMR>")


class Sides(SceneTest):
    def print_of(self, text, *sets, options=("--quiet",), ranks=1):
        result = run(self.scene(text), *sets, options=options, ranks=ranks)
        self.assertEqual((result.code, result.err), (0, ""))
        return result.report["fingerprint"]

    def assert_same(self, texts, *sets):
        prints = {self.print_of(text, *sets) for text in texts}
        self.assertEqual(len(prints), 1)

    def test_parts_that_make_up_a_side_are_the_side(self):
        sides = [inflow('side="x-"'), inflow('circle="x-" origin="0 0.5 0.5" radius="1"'),
                 inflow('rectangle="x-" lower="0 0 0" upper="0 1 1"') + f'<Face side="x-">{MIRROR}</Face>',
                 inflow('rectangle="x-" lower="0 0 0" upper="0 0.5 1"') + inflow('side="x-"'),
                 inflow('rectangulus="x-" inner_lower="0 0.3 0.3" inner_upper="0 0.6 0.6" outer_lower="0 0 0" '
                        'outer_upper="0 1 1"') + inflow('rectangle="x-" lower="0 0.3 0.3" upper="0 0.6 0.6"')]
        self.assert_same([gas(faces) for faces in sides], steps(5))
        self.assertNotEqual(self.print_of(gas(sides[0]), steps(5)), self.print_of(gas(JETS), steps(5)))

    def test_a_part_with_a_formula_that_is_constant(self):
        formulas = inflow(ROUND[0], "2 + 0*t", "[1 + 0*x,0.1,0.2]") + "".join(map(inflow, ROUND[1:]))
        plain = "".join(map(inflow, ROUND))
        self.assert_same([gas(formulas), gas(plain)], steps(5))

    def test_any_layout_ranks_levels_and_a_restart(self):
        for amr in ("", LEVELS):
            text = gas(JETS.replace("<value>2<", "<value>2 + y*sin(9*t)<"), amr)
            plain = self.print_of(text, steps(12))
            for layout in ("3x2x1", "1x4x3"):
                self.assertEqual(self.print_of(text, steps(12), options=("--quiet", "-layout", layout)), plain)
            self.assertEqual(self.print_of(text, steps(12), ranks=2), plain)
            folder = Folder()
            self.addCleanup(folder.cleanup)
            self.assertEqual(folder.run(self.scene(text), steps(9))[:2], (0, ""))
            code, errors, report = folder.restart(steps(12), step=8)
            self.assertEqual((code, errors), (0, ""))
            self.assertEqual(report["fingerprint"], plain)

    def test_the_jet_is_its_own_mirror_image(self):
        with tempfile.TemporaryDirectory() as folder:
            fields = columns(archive_of(self.scene(JET), folder, SMALL, "Time/maxTime=1"), "c.temperature")
        values = fields["c.temperature [K]"]
        at = {(x, y): value for x, y, value in zip(fields["x [m]"], fields["y [m]"], values)}
        self.assertTrue(all(at[x, -y] == value for (x, y), value in at.items()))
        self.assertGreater(max(values), 2.5)
        self.assertEqual(at[min(x for x, _ in at), max(y for _, y in at)] > 1.5, False, "hot away from the jet")

    def test_a_wave_that_a_formula_lets_in(self):
        """An entropy wave carried by the gas: smooth, hence of second order."""
        wave = "1 + 0.2*sin(2*pi*(x - t))"
        faces = "".join(f'<Face side="{side}">{MIRROR}</Face>' for side in ("y-", "y+", "z-", "z+"))
        inlet = inflow('side="x-"', wave, "[1,0,0]").replace(
            "</Face>", '<BCType label="Pressure" var="Dirichlet"><value>1</value></BCType></Face>')
        exact = (f'<DataAnalysis><Module name="exactSolution"><label>c.density</label><value>{wave}</value></Module>'
                 "</DataAnalysis></Uintah_specification>")
        errors = []
        for cells in (64, 128):
            text = gas(faces + inlet, cells=f"[{cells},1,1]", velocity="[1,0,0]")
            result = run(self.scene(text.replace("</Uintah_specification>", exact)))
            self.assertEqual(result.code, 0, result.err)
            errors.append(result.report["errors"]["density"]["cell"]["L1"])
        self.assertGreater(errors[0] / errors[1], 3.2, errors)

    def test_gas_around_bodies(self):
        text = (ROOT / "ups/fsi/cylinder.ups").read_text()
        parts = ['<Face rectangle="x-" lower="0 0 0" upper="0 0.1 0.005">', '<Face side="x-">']
        start = text.index(parts[1])
        inlet = text[start:text.index("</Face>", start) + len("</Face>")]
        both = text.replace(inlet, inlet.replace(parts[1], parts[0]) + inlet)
        whole = text.replace(parts[1], '<Face circle="x-" origin="0 0 0" radius="1">')
        jet = text.replace(inlet, inlet.replace(parts[1], parts[0]).replace(">5.4<", ">6<") + inlet)
        self.assert_same([text, both, whole], "Grid/Level/Box/resolution=[50,10,1]", steps(20))
        small = ("Grid/Level/Box/resolution=[50,10,1]", steps(20))
        self.assertNotEqual(self.print_of(jet, *small), self.print_of(text, *small))
        self.assertEqual(self.print_of(jet, *small, options=("--quiet", "-layout", "4x3x1")),
                         self.print_of(jet, *small))

    def assert_takes_parts(self, scene, label, *changes):
        """In two dimensions, where the scene has no condition of its own on x+."""
        text = re.sub("<DataAnalysis>.*</DataAnalysis>", "", (ROOT / scene).read_text(), flags=re.DOTALL)
        for before, after in changes:
            self.assertIn(before, text)
            text = text.replace(before, after)
        faces = f'<Face {{}}><BCType label="{label}" var="Dirichlet"><value>2</value></BCType></Face>'.format
        with_faces = [text.replace("<BoundaryConditions>", "<BoundaryConditions>" + more) for more in (
            faces('side="x+"'), faces('circle="x+" origin="1 0.5 0.5" radius="2"'),
            faces('rectangle="x+" lower="1 0 0" upper="1 0.5 1"') + faces('side="x+"'),
            faces('rectangle="x+" lower="1 0 0" upper="1 0.5 1"'), "")]
        plane = ("Grid/Level/Box/resolution=[16,8,1]", steps(4))
        prints = [self.print_of(one, *plane) for one in with_faces]
        self.assertEqual(len(set(prints[:3])), 1)
        self.assertEqual(len(set(prints[2:])), 3)
        self.assertEqual(self.print_of(with_faces[3], *plane, options=("--quiet", "-layout", "2x3x1")), prints[3])

    def test_burgers(self):
        self.assert_takes_parts("ups/burgers/sine.ups", "Velocity", ("[1,0,0]</periodic>", "[0,0,0]</periodic>"))

    def test_heat(self):
        side = '<Face side="x+"><BCType id="all" label="Temperature" var="Dirichlet"><value>0</value></BCType></Face>'
        self.assert_takes_parts("ups/heat/sine.ups", "Temperature", (side, ""))

    def test_double_mach_reflection_has_the_undisturbed_shock_along_its_upper_side(self):
        text = re.sub("<AMR>.*</AMR>", "", (ROOT / "ups/euler/double_mach.ups").read_text(), flags=re.DOTALL)
        with tempfile.TemporaryDirectory() as folder:
            fields = columns(archive_of(self.scene(text), folder, "Time/maxTime=0.1"), "c.density")
        width = 1 / 32
        top = {x: rho for x, y, rho in zip(fields["x [m]"], fields["y [m]"], fields["c.density [kg/m^3]"])
               if y > 1 - width}
        shock = 1 / 6 + (1 - width / 2 + 20 * .1) / 3 ** .5
        self.assertEqual(len(top), 128)
        behind = [x for x, rho in top.items() if rho > .5 * (8 + 1.4)]
        self.assertEqual((min(behind), len(behind)), (width / 2, round(max(behind) / width + .5)), "one shock")
        self.assertAlmostEqual(max(behind) + width / 2, shock, delta=width)
        for x, rho in top.items():
            if x > shock + 3 * width:
                self.assertAlmostEqual(rho, 1.4, delta=1e-5)
        self.assertGreater(max(fields["c.density [kg/m^3]"]), 15, "no reflection")


if __name__ == "__main__":
    unittest.main()
