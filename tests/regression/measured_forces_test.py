#!/usr/bin/env python3
"""Forces and energies that solids report: of masters beside symmetry planes, of sides, and of bodies that start under
pressure."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import SceneTest, globals_of

SCENE = """<?xml version="1.0"?>
<Uintah_specification>
  <Meta><title>A bar</title></Meta>
  <SimulationComponent type="{component}"/>
  <Time><maxTime>{end}</maxTime><delt_min>0</delt_min><delt_max>{step}</delt_max>{times}
    <timestep_multiplier>{multiplier}</timestep_multiplier></Time>
  <MPM><interpolator>{interpolator}</interpolator>{mpm}</MPM>
  <PhysicalConstants><gravity>[0,0,0]</gravity></PhysicalConstants>
  <MaterialProperties><MPM>{materials}{contact}</MPM></MaterialProperties>
  {loads}
  <Grid><BoundaryConditions>{faces}</BoundaryConditions>
    <Level><Box label="1"><lower>[0,0,0]</lower><upper>{upper}</upper><resolution>{cells}</resolution></Box></Level>
  </Grid>
  <DataArchiver><filebase>bar.uda</filebase><outputInterval>0</outputInterval>{saves}</DataArchiver>
</Uintah_specification>
"""
MATERIAL = """<material><density>1000</density>
  <constitutive_model type="comp_neo_hook"><bulk_modulus>1e6</bulk_modulus><shear_modulus>5e5</shear_modulus>{start}
  </constitutive_model>
  <geom_object>{shape}<res>{res}</res><velocity>{velocity}</velocity></geom_object></material>"""
CLOSED = ("x-", "x+", "y-", "y+", "z-", "z+")
OPEN = ("x-", "y-", "y+", "z-", "z+")
PRESSED = "<useInitialStress>true</useInitialStress><initial_pressure>{}</initial_pressure>"


def box(lower, upper):
    return f"<box><min>{lower}</min><max>{upper}</max></box>"


def body(shape, res="[2,2,2]", velocity="[0,0,0]", start=""):
    return MATERIAL.format(shape=shape, res=res, velocity=velocity, start=start)


class Measured(SceneTest):
    def globals(self, *names, materials, upper, cells, faces=CLOSED, component="mpm", interpolator="linear", end=1.0,
                step=1.0, multiplier=.3, **others):
        parts = dict.fromkeys(("times", "mpm", "contact", "loads"), "") | others
        text = SCENE.format(
            component=component, interpolator=interpolator, end=end, step=step, multiplier=multiplier,
            materials=materials, upper=upper, cells=cells, saves="".join(f'<save label="{name}"/>' for name in names),
            faces="".join(f'<Face side="{side}"><BCType id="all" var="symmetry" label="Symmetric"/></Face>'
                          for side in faces), **parts)
        return globals_of(self.scene(text), *names)

    def reaction(self, interpolator, across):
        """The mean force per area on a die that presses a column, which is so many cells wide [Pa]."""
        width = across * .125
        die = body(box("[0,.5,0]", f"[{width},.75,.125]"), "[2,2,1]", "[0,-1,0]")
        column = body(box("[0,0,0]", f"[{width},.5,.125]"), "[2,2,1]")
        found = self.globals("RigidReactionForce", materials=die + column, upper=f"[{width},1,.125]",
                             cells=f"[{across},8,1]", faces=("x-", "x+", "y-", "z-", "z+"), interpolator=interpolator,
                             end=4e-3, contact="<contact><type>specified</type><master_material>0</master_material>"
                                               "<direction>[0,1,0]</direction></contact>")
        forces = [line[2] for line in found["RigidReactionForce"]]
        return sum(forces) / len(forces) / (width * .125)

    def test_a_die_presses_with_a_force_in_proportion_to_its_width(self):
        for interpolator in ("linear", "gimp", "cpdi", "3rdorderBS"):
            expected = self.reaction(interpolator, 2)
            self.assertLess(expected, -1e4)
            for across in (4, 8):
                self.assertAlmostEqual(self.reaction(interpolator, across) / expected, 1, delta=1e-9)

    def test_a_filled_box_presses_on_its_sides_with_its_pressure(self):
        for interpolator in ("linear", "gimp", "cpdi", "3rdorderBS", "4thorderBS"):
            found = self.globals("BndyForce_xminus", "BndyContactArea_xminus",
                                 materials=body(box("[0,0,0]", "[1,.125,.125]"), start=PRESSED.format(1000)),
                                 upper="[1,.125,.125]", cells="[8,1,1]", interpolator=interpolator, end=1e-4)
            self.assertAlmostEqual(found["BndyForce_xminus"][-1][1] / 15.625, 1, delta=1e-9, msg=interpolator)
            self.assertAlmostEqual(found["BndyContactArea_xminus"][-1][1] / .125**2, 1, delta=1e-9)

    def test_the_force_on_a_side_changes_the_momentum(self):
        for viscous in ("false", "true"):
            found = self.globals("BndyForce_xminus", "TotalMomentum",
                                 materials=body(box("[0,0,0]", "[.5,.25,.25]"), velocity="[-20,0,0]"),
                                 upper="[1,.25,.25]", cells="[16,4,4]", faces=OPEN, end=2e-3, step=1e-5,
                                 mpm=f"<artificial_viscosity>{viscous}</artificial_viscosity>")
            force, momentum = found["BndyForce_xminus"], found["TotalMomentum"]
            impulse = sum(line[1] * (after[0] - line[0]) for line, after in zip(force, force[1:]))
            self.assertAlmostEqual(impulse / (momentum[-1][1] - momentum[0][1]), 1, delta=1e-6, msg=viscous)

    def test_bodies_that_start_under_pressure_have_their_energy_and_force_in_both_kinds_of_steps(self):
        pressed = body(box("[0,0,0]", "[.5,.25,.25]"), start=PRESSED.format(5e5))
        place = {"upper": "[1,.25,.25]", "cells": "[8,2,2]", "faces": OPEN, "materials": pressed}
        names = ("StrainEnergy", "TotalMomentum")
        explicit = self.globals(*names, end=1e-4, step=1e-5, **place)
        implicit = self.globals(*names, end=1e-4, step=1e-5, multiplier=1, component="impm",
                                mpm="<dynamic>true</dynamic>", times="<delt_init>1e-5</delt_init>", **place)
        for found in (explicit, implicit):
            start = found["StrainEnergy"][0][1]
            self.assertAlmostEqual(found["StrainEnergy"][1][1] / start, 1, delta=1e-2)
            time, momentum = found["TotalMomentum"][-1][:2]
            self.assertAlmostEqual(momentum / (5e5 * .0625 * time), 1, delta=2e-2)
        self.assertAlmostEqual(implicit["StrainEnergy"][0][1] / explicit["StrainEnergy"][0][1], 1, delta=1e-12)

    def test_the_centre_of_a_stretched_bar_moves_also_on_a_grid_that_goes_along(self):
        bar = body(box("[0,0,0]", "[.5,.25,.25]"))
        die = body(box("[.5,0,0]", "[.625,.25,.25]"), velocity="[1,0,0]").replace(
            "<density>", "<is_rigid>true</is_rigid><density>", 1)
        contact = ("<contact><type>rigid</type><master_material>1</master_material><materials>[0,1]</materials>"
                   "<direction>[1,0,0]</direction></contact>")
        places = []
        for resets in ("true", "false"):
            found = self.globals("CenterOfMassPosition", materials=bar + die, upper="[1,.25,.25]", cells="[8,2,2]",
                                 faces=OPEN, component="impm", end=.02, step=.005, multiplier=1, contact=contact,
                                 times="<delt_init>.005</delt_init>",
                                 mpm=f"<dynamic>false</dynamic><do_grid_reset>{resets}</do_grid_reset>")
            places.append([line[1] for line in found["CenterOfMassPosition"]])
        self.assertGreater(places[1][-1], places[1][0] * 1.01)
        self.assertAlmostEqual(places[1][-1] / places[0][-1], 1, delta=1e-3)

    def test_the_budget_leaves_out_the_strain_of_rigid_bodies(self):
        rigid = body(box("[0,0,0]", "[.5,.25,.25]")).replace("<density>", "<is_rigid>true</is_rigid><density>", 1)
        text = rigid.replace("<velocity>[0,0,0]", "<velocity>[1 - 2*x,0,0]")
        found = self.globals("StrainWork", materials=text, upper="[1,.25,.25]", cells="[8,2,2]", faces=(), end=.1)
        self.assertEqual({line[1] for line in found["StrainWork"]}, {0})

    def test_a_pressure_around_a_body_that_starts_elsewhere_pushes_it_nowhere(self):
        disc = "<cylinder><bottom>[{0},.5,-1]</bottom><top>[{0},.5,1]</top><radius>.25</radius></cylinder>"
        loads = ("<PhysicalBC><MPM><pressure><geom_object>" + disc.format(.5) + "</geom_object><load_curve><id>1</id>"
                 "<time_point><time>0</time><load>-1000</load></time_point></load_curve></pressure></MPM></PhysicalBC>")
        moved = disc.format(.25) + "<affineTransformation_b>[.25,0,0]</affineTransformation_b>"
        energies = []
        for shape in (disc.format(.5), moved):
            found = self.globals("TotalMomentum", "KineticEnergy", materials=body(shape, "[3,3,1]"), loads=loads,
                                 upper="[1,1,.0625]", cells="[16,16,1]", faces=("z-", "z+"), interpolator="gimp",
                                 end=5e-4, mpm="<use_load_curves>true</use_load_curves>")
            energies.append(found["KineticEnergy"][-1][1])
            self.assertLess(max(map(abs, found["TotalMomentum"][-1][1:])), 1e-9)
        self.assertAlmostEqual(energies[1] / energies[0], 1, delta=1e-9)
        self.assertGreater(energies[0], 1e-6)


if __name__ == "__main__":
    unittest.main()
