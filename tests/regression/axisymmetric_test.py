"""Loads, forces on sides and damage where the axes are the radius and the axis of symmetry."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "support"))
from solids import RefusedSceneTest, globals_of, last_state  # noqa: E402
from sus import run  # noqa: E402

SYMMETRIC = '<Face side="{}"><BCType id="all" label="Symmetric" var="symmetry"/></Face>'
MODEL = """<constitutive_model type="comp_neo_hook">
  <bulk_modulus>1e6</bulk_modulus><shear_modulus>5e5</shear_modulus>{}</constitutive_model>"""
PRESSED = "<useInitialStress>true</useInitialStress><initial_pressure>1000</initial_pressure>"
DAMAGE = """<damage_model type="Brittle">
  <brittle_damage_initial_threshold>20</brittle_damage_initial_threshold>
  <brittle_damage_fracture_energy>20</brittle_damage_fracture_energy>
  <brittle_damage_constant_D>.1</brittle_damage_constant_D>
  <brittle_damage_max_damage_increment>1</brittle_damage_max_damage_increment></damage_model>"""
LOAD = """<PhysicalBC><MPM><pressure><geom_object>{}</geom_object><load_curve><id>1</id>
  <time_point><time>0</time><load>1000</load></time_point></load_curve></pressure></MPM></PhysicalBC>"""


def box(lower, upper):
    return "<box><min>[{},{},{}]</min><max>[{},{},{}]</max></box>".format(*lower, *upper)


def scene(body, depth=.05, model="", damage="", load="", velocity="[0,0,0]", sides=("x-", "z-", "z+"), top="",
          cells=(20, 20), time=1e-4, save=("TotalMomentum",)):
    faces = "".join(SYMMETRIC.format(side) for side in sides) + top
    saved = "".join(f'<save label="{label}"/>' for label in save)
    return f"""<Uintah_specification>
<SimulationComponent type="mpm"/>
<Time><maxTime>{time}</maxTime><delt_max>1e-5</delt_max><timestep_multiplier>.3</timestep_multiplier></Time>
<MPM><interpolator>gimp</interpolator><axisymmetric>true</axisymmetric><use_load_curves>true</use_load_curves></MPM>
<MaterialProperties><MPM><material name="solid"><density>1000</density>{damage}{MODEL.format(model)}
<geom_object>{body}<res>[2,2,1]</res><velocity>{velocity}</velocity></geom_object></material></MPM></MaterialProperties>
{load}
<Grid><BoundaryConditions>{faces}</BoundaryConditions><Level><Box label="all"><lower>[0,0,0]</lower>
<upper>[1,1,{depth}]</upper><resolution>[{cells[0]},{cells[1]},1]</resolution></Box></Level></Grid>
<DataArchiver><filebase>axis.uda</filebase><outputLastTimestep/>{saved}</DataArchiver>
</Uintah_specification>"""


class AxisymmetricTest(RefusedSceneTest):
    def force(self, surface, **rest):
        """Returns the force [N/rad] of 1000 Pa on a surface of a disc with a radius of .5 m, in 1e-4 s."""
        text = scene(box((0, .2, 0), (.5, .6, rest.get("depth", .05))), load=LOAD.format(surface), **rest)
        time, *momentum = globals_of(self.scene(text), "TotalMomentum")["TotalMomentum"][-1]
        return [component / time for component in momentum]

    def test_pressures_act_on_a_radian(self):
        """The force on a disc is p R²/2, that on its side p R H, whatever the width of the grid along z."""
        for depth in (.05, .0005):
            below = self.force(box((0, .2, 0), (.5, .2, depth)), depth=depth)
            around = self.force(box((.5, .2, 0), (.5, .6, depth)), depth=depth)
            self.assertAlmostEqual(below[1], 1000 * .5 ** 2 / 2, delta=1e-9)
            self.assertAlmostEqual(around[0], 1000 * .5 * .4, delta=.3)  # the axis holds some of it
        end = self.force("<cylinder><bottom>[0,.19,0]</bottom><top>[0,.21,0]</top><radius>.5</radius>"
                           "<axisymmetric_end>true</axisymmetric_end></cylinder>")
        self.assertAlmostEqual(end[1], below[1], delta=1e-9)

    def test_steps_do_not_depend_on_the_width_of_the_axis_that_is_not_in_use(self):
        steps = [run(self.scene(scene(box((0, .2, 0), (.5, .6, depth)), depth=depth))).report["steps"]
                 for depth in (.05, .0005)]
        self.assertEqual(*steps)

    def test_whole_circumferences_on_a_radian_are_noted(self):
        side = "<cylinder><bottom>[0,.2,0]</bottom><top>[0,.6,0]</top><radius>.5</radius></cylinder>"
        noted = run(self.scene(scene(box((0, .2, 0), (.5, .6, .05)), load=LOAD.format(side))), options=("--check",))
        self.assertEqual(noted.code, 0)
        self.assertIn("2 pi times as much as its part; <axisymmetric_side> takes a radian of it", noted.err)

    def test_spheres_off_the_axis_are_refused(self):
        ball = "<sphere><origin>[.1,.4,0]</origin><radius>.3</radius></sphere>"
        self.assert_refused(scene(box((0, .2, 0), (.5, .6, .05)), load=LOAD.format(ball)),
                            "sphere: its centre is at x = 0.1 m; with <axisymmetric> it must lie on the axis")

    def test_planes_through_the_axis_feel_the_hoop_stress(self):
        """The force is p times the area of the body in the plane, whatever the width of the grid along z."""
        for depth in (.05, .003):
            text = scene(box((.25, 0, 0), (.75, .25, depth)), depth=depth, model=PRESSED,
                         save=("BndyForce_zminus", "BndyForce_zplus", "BndyContactArea_zplus"), time=1e-6)
            found = globals_of(self.scene(text), "BndyForce_zminus", "BndyForce_zplus", "BndyContactArea_zplus")
            self.assertAlmostEqual(found["BndyContactArea_zplus"][0][1], .125, delta=1e-12)
            self.assertAlmostEqual(abs(found["BndyForce_zplus"][0][3]), 125, delta=1e-6)
            self.assertAlmostEqual(found["BndyForce_zplus"][0][3], -found["BndyForce_zminus"][0][3], delta=1e-9)

    def test_damage_does_not_depend_on_the_radius(self):
        """A cylinder that is stretched along its axis is damaged alike at all radii, whatever the width along z."""
        top = ('<Face side="y+"><BCType id="all" label="Velocity" var="Dirichlet"><value>[0,10,0]</value></BCType>'
               '</Face>')
        seen = []
        for depth in (.05, .005):
            text = scene(box((0, 0, 0), (1, 1, depth)), depth=depth, damage=DAMAGE, velocity="[0,10*y,0]", top=top,
                         sides=("x-", "x+", "y-", "z-", "z+"), cells=(20, 4), time=.002, save=("p.damage",))
            state = last_state(self.scene(text), "p.damage")
            rows = {}
            for damage, y in zip(state["p.damage [1]"], state["y [m]"]):
                rows.setdefault(round(y, 9), []).append(damage)
            self.assertGreater(max(map(max, rows.values())), .05)
            for row in rows.values():
                self.assertEqual(len(row), 40)
                self.assertLess(max(row) - min(row), 1e-9)
            seen.append(sorted(map(max, rows.values())))
        for one, other in zip(*seen):
            self.assertAlmostEqual(one, other, delta=1e-12)


if __name__ == "__main__":
    unittest.main()
