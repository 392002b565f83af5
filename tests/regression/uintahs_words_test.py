#!/usr/bin/env python3
"""Tags of Uintah's scenes that have another name here, or no effect: such scenes run
unchanged."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import columns, globals_of, archive_of
from sus import ROOT, run

DISCS, BEAM, BILLET, SPALL, COLUMN = (f"ups/solid/{name}.ups" for name in (
    "two_discs", "implicit_cantilever", "billet", "spall", "column_collapse"))
FEW = ("Time/max_Timesteps=3",)
FLAGS = """<cpdi_lcrit>1e10</cpdi_lcrit><minimum_mass_for_acc>1e-20</minimum_mass_for_acc><XPIC2>false</XPIC2>
  <artificial_viscosity_coeff1>.3</artificial_viscosity_coeff1><refine_particles>false</refine_particles>
  <do_contact_friction_heating>false</do_contact_friction_heating><DeleteGeometryObjects>true</DeleteGeometryObjects>
  <artificial_damping_coeff>1</artificial_damping_coeff>"""
SECTIONS = """<InitialConditions><MPM/></InitialConditions><SimulationController><doMultiTaskgraphScheduling>false
  </doMultiTaskgraphScheduling></SimulationController></Uintah_specification>"""
DAMAGE = """<damage_model type="hancock_mackenzie"><initial_mean_scalar_damage>0.005</initial_mean_scalar_damage>
  <initial_std_scalar_damage>0</initial_std_scalar_damage><critical_scalar_damage>0.3</critical_scalar_damage>
  <initial_scalar_damage_distrib>gauss</initial_scalar_damage_distrib></damage_model>"""
THRESHOLD = """<damage_model type="Threshold">
          <failure_criteria>MaximumPrincipalStress</failure_criteria>
          <failure_mean>1.5e9</failure_mean>
          <failure_distrib>constant</failure_distrib>
        </damage_model>"""

SYMMETRIC = '<BCType id="all" label="Symmetric" var="symmetry"/>'
STILL = '<BCType id="all" label="Velocity" var="Dirichlet"><value>[0,0,0]</value></BCType>'

# what: scene, text, what takes its place
RUN = {
    "an archive of a type": (DISCS, "<DataArchiver>", '<DataArchiver type="PIDX">'),
    "an archive by its path": (DISCS, "<filebase>two", "<filebase>/some/where/else/two"),
    "a compression by name": (DISCS, "<save ", "<compression>gzip</compression><save ", 1),
    "digits by an empty tag": (DISCS, "<save ", "<outputDoubleAsFloat/><save ", 1),
    "materials by their numbers": (BILLET, '<save label="p.x"/>', '<save label="p.x" material="0-1"/>'),
    "a list of one without brackets": (BILLET, "<materials>[0,1]</materials>", "<materials>1</materials>"),
    "all materials": (BILLET, '<save label="p.x"/>', '<save label="p.x" material="all"/>'),
    "constants of damage outside its model":
        (DISCS, "</constitutive_model>",
         "</constitutive_model><D1>-2</D1><D2>5</D2><D3>-.5</D3><D4>.02</D4><D5>.6</D5>", 1),
    "a rigid body without moduli":
        (BILLET, "<bulk_modulus>1e9</bulk_modulus><shear_modulus>1e9</shear_modulus>", ""),
    "an older word for a model": (BILLET, "comp_neo_hook_plastic", "cnhp_damage"),
    "sections of other components": (BILLET, "</Uintah_specification>", SECTIONS),
    "flags of explicit steps in implicit ones": (BEAM, "<dynamic>", FLAGS + "<dynamic>"),
    "a solver of Uintah's own": (BEAM, "<dynamic>", "<solver>simple</solver><dynamic>"),
    "Hancock's and Mackenzie's damage": (SPALL, THRESHOLD, DAMAGE),
    "damage that differs from particle to particle at the start": (SPALL, THRESHOLD, DAMAGE.replace(">0<", ">1e-3<")),
    "a velocity in a plane of symmetry": (DISCS, SYMMETRIC, SYMMETRIC + STILL, 1),
    "a value in a plane of symmetry": (DISCS, SYMMETRIC, SYMMETRIC.replace("/>", "><value>[0,0,0]</value></BCType>")),
    "a side without conditions": (BILLET, "</BoundaryConditions>", '<Face side="y+"/></BoundaryConditions>'),
    "a component in capitals": (DISCS, 'type="mpm"', 'type="MPM"'),
    "no title": (DISCS, "Two discs collide", ""),
    "a first step after a restart": (BILLET, "</Time>",
                                     "<override_restart_delt>1e-3</override_restart_delt></Time>"),
    "no greatest step": (BILLET, "</Time>",
                         "<delt_max>0</delt_max><override_restart_delt>0</override_restart_delt></Time>"),
    "a density of a body": (DISCS, "<geom_object>", '<geom_object name="one"><density>1</density>', 1),
    "variables that nobody computes here": (DISCS, "<save ", '<save label="AccStrainEnergy"/><save '
                                                             'label="g.surfnorm"/><save ', 1),
    "a body without particles": (DISCS, "</geom_object>",
                                 "</geom_object><geom_object><null/><res>[1,1,1]</res></geom_object>", 1),
}


class UintahsWords(unittest.TestCase):
    def test_run(self):
        for name, (scene, before, after, *count) in RUN.items():
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                text = (ROOT / scene).read_text()
                self.assertIn(before, text)
                path = pathlib.Path(folder, "scene.ups")
                path.write_text(text.replace(before, after, *count))
                result = run(path, *FEW)
                self.assertEqual(result.code, 0, result.err)

    def test_short_domains_change_a_run_alike_on_all_layouts(self):
        scene = ("ups/solid/cantilever.ups", "Time/max_Timesteps=20")
        found = [run(*scene, "MPM/cpdi_lcrit=.4", options=("--quiet", *layout)).report["fingerprint"]
                 for layout in ((), ("--layout", "3x2x1", "--nthreads", "2"))]
        self.assertEqual(*found)
        as_before = [run(*scene, *short).report["fingerprint"] for short in ((), ("MPM/cpdi_lcrit=1.8",))]
        self.assertEqual(*as_before)
        self.assertNotEqual(found[0], as_before[0])

    def test_a_variable_that_nobody_computes_is_noted(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "scene.ups")
            path.write_text((ROOT / DISCS).read_text().replace("<save ", '<save label="AccStrainEnergy"/><save ', 1))
            result = run(path, *FEW, options=())
            self.assertIn("'AccStrainEnergy' is not saved, since no task computes it in this scene", result.err)

    def test_a_saved_number_means_the_material_of_that_place(self):
        with tempfile.TemporaryDirectory() as folder:
            archive = archive_of(BILLET, folder, *FEW, "DataArchiver/save[1]/@material=1")
            self.assertGreater(len(columns(archive, "p.x", material="billet")["x [m]"]), 0)
        result = run(BILLET, *FEW, "DataArchiver/save[1]/@material=-1")
        self.assertEqual(result.code, 3)
        self.assertIn("there is no material '-1'", result.err)

    def test_the_number_behind_the_last_stands_for_all_materials(self):
        with tempfile.TemporaryDirectory() as folder:
            archive = archive_of(BILLET, folder, *FEW, "DataArchiver/save[1]/@material=2-4")
            for material in ("die", "billet"):
                self.assertGreater(len(columns(archive, "p.x", material=material)["x [m]"]), 0)
        result = run(BILLET, *FEW, "DataArchiver/save[1]/@material=2-4", options=())
        self.assertIn("in Uintah, material 2 means all materials together; here, 'p.x' is saved for each", result.err)
        self.assertIn("does nothing for 4: materials are numbered from 0 to 1", result.err)

    def test_what_is_saved_twice_is_saved_once(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "scene.ups")
            path.write_text((ROOT / BILLET).read_text().replace(
                '<save label="p.x"/>', '<save label="p.x"/><save label="p.x"/><save label="p.mass" material="billet"/>'
                '<save label="p.mass"/><save label="TotalMass"/><save label="TotalMass" material="0"/>'))
            result = run(path, *FEW, options=())
            self.assertEqual(result.code, 0, result.err)
            self.assertEqual(result.err.count("is saved by"), 3, result.err)
            lines = globals_of(path, "TotalMass", sets=FEW)["TotalMass"]
            self.assertEqual(len(lines), len({time for time, mass in lines}))

    def test_variables_of_soils_are_saved_by_their_names_here(self):
        water = ("<UseWaterRetention>1</UseWaterRetention><WR_Param1>.02</WR_Param1><WR_Param2>200</WR_Param2>"
                 "<WR_Param3>3.6e-4</WR_Param3><PhiB>12</PhiB><suction>3500</suction><SpecVol>1.9</SpecVol>")
        labels = "Suction", "SpecificVol", "c"
        saves = "<outputInitTimestep/>" + "".join(f'<save label="{label}"/>' for label in labels)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "scene.ups")
            text = (ROOT / COLUMN).read_text().replace("<save ", saves + "<save ", 1)
            path.write_text(text.replace("<c>0</c>", "<c>0</c>" + water))
            found = columns(archive_of(path, folder, *FEW), "p.Suction", "p.SpecificVol", time=1e-30)
            self.assertEqual(set(found["p.Suction [Pa]"]), {3500})
            self.assertEqual(set(found["p.SpecificVol [1]"]), {1.9})
            said = run(path, *FEW, options=()).err
            self.assertIn("'c' is saved as 'p.cohesion'", said)
            path.write_text(text)
            said = run(path, *FEW, options=()).err
            self.assertIn("'p.Suction' is not saved, since no task computes it in this scene", said)

    def test_what_is_saved_of_all_materials_is_saved_once_of_each(self):
        for order in ("all", "billet"), ("billet", "all"):
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder, "scene.ups")
                saves = "".join(f'<save label="p.mass" material="{material}"/>' for material in order)
                path.write_text((ROOT / BILLET).read_text().replace('<save label="p.x"/>',
                                                                    '<save label="p.x"/>' + saves))
                archive = archive_of(path, folder, *FEW)
                for material in ("billet", "die"):
                    self.assertGreater(len(columns(archive, "p.mass", material=material)["p.mass [kg]"]), 0)

    def test_what_uintahs_implicit_steps_do_with_heat_is_noted_or_refused(self):
        def checked(tags):
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder, "scene.ups")
                path.write_text((ROOT / BEAM).read_text().replace("<MPM>", "<MPM>" + tags, 1))
                return run(path, options=("--check",))

        kept = "<interpolateParticleTempToGridEveryStep>false</interpolateParticleTempToGridEveryStep>"
        self.assertNotIn("first step", checked(kept).err)
        conducting = checked(kept + "<DoImplicitHeatConduction>true</DoImplicitHeatConduction>").err
        self.assertIn("in Uintah, from those in the first step", conducting)
        self.assertEqual(checked("<DoMechanics>true</DoMechanics>").code, 0)
        refused = checked("<DoMechanics>false</DoMechanics>")
        self.assertEqual(refused.code, 3)
        self.assertIn("false leaves nothing to compute; set DoImplicitHeatConduction to true", refused.err)

    def test_materials_may_share_a_name(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "scene.ups")
            path.write_text((ROOT / DISCS).read_text().replace('name="upper"', 'name="lower"'))
            archive = archive_of(path, folder, *FEW)
            masses = [len(columns(archive, "p.x", material=name)["x [m]"]) for name in ("lower", "lower.1")]
        self.assertEqual(masses[0], masses[1])
        self.assertGreater(masses[0], 0)

    def test_a_particle_fills_the_edges_that_the_deformation_gives_it(self):
        with tempfile.TemporaryDirectory() as folder:
            archive = archive_of(DISCS, folder, *FEW, "DataArchiver/save[1]/@label=p.scalefactor",
                                 "DataArchiver/outputTimestepInterval=1", "DataArchiver/outputInterval=0")
            edges = columns(archive, "p.scalefactor", time=0)
        # Cells of .05 m with 2 x 2 x 2 particles each.
        for component in ("xx", "yy", "zz"):
            self.assertEqual({round(edge, 12) for edge in edges[f"p.scalefactor.{component} [m]"]}, {.025})
        self.assertEqual({round(edge, 12) for edge in edges["p.scalefactor.xy [m]"]}, {0})

    def test_the_volume_of_all_particles_is_that_of_the_bodies(self):
        volumes = globals_of(DISCS, "TotalVolumeDeformed", sets=(*FEW,
                                                                 "DataArchiver/save[1]/@label=TotalVolumeDeformed"))
        time, volume = volumes["TotalVolumeDeformed"][0]
        self.assertEqual(time, 0)
        self.assertAlmostEqual(volume, 13 / 1000, delta=1e-12)  # the mass that the scene names, over the density


if __name__ == "__main__":
    unittest.main()
