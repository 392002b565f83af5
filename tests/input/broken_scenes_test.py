#!/usr/bin/env python3
"""Broken scenes: each gives its error message and a documented exit code, and writes nothing."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, SUS, run

SOD = (ROOT / "ups/mpm/sod.ups").read_text()
BOX = "Grid/Level/Box/"
GAS = "MPM/gas_dynamics/"
MATERIAL = "MaterialProperties/MPM/material/"
LEFT = MATERIAL + "geom_object[1]/"

# name: (override, sentence after the location)
OVERRIDES = {
    "unknown component": ("SimulationComponent/@type=mpn",
                          "SimulationComponent: type: found 'mpn', expected 'burgers', 'euler', 'heat', 'ice', "
                          "'implicit_heat', 'impm', 'mpm', 'mpmice', 'poisson' or 'rmpmice' (did you mean "
                          "'mpm'?); --load FILE loads one of your own"),
    "unknown tag": (BOX + "resolutoin=[3,1,1]", BOX + "resolutoin: unknown tag <resolutoin> in <Box> (did you mean "
                    "'resolution'?); allowed here: lower, upper, resolution, patches, autoPatch, extraCells"),
    "unknown section": ("Gird/x=1", "Gird: unknown section <Gird> (did you mean 'Grid'?); allowed here: Meta, "
                        "SimulationComponent, Time, DataArchiver, Grid, AMR, DataAnalysis, MPM, MaterialProperties"),
    "unknown constitutive model": (MATERIAL + "constitutive_model/@type=ideal_gaz",
                                   MATERIAL + "constitutive_model: attribute 'type': found 'ideal_gaz', expected "
                                   "'ideal_gas' or 'stiffened_gas' (did you mean 'ideal_gas'?)"),
    "ideal gas with p_infinity": (MATERIAL + "constitutive_model/p_infinity=6e8", "MaterialProperties/MPM/material/"
                                  "constitutive_model: an ideal_gas has no p_infinity; use type=\"stiffened_gas\""),
    "unknown module": ("DataAnalysis/Module/@name=exactRieman",
                       "DataAnalysis/Module: name: found 'exactRieman', expected "
                       "'burgersWave', 'controlVolFluxes', 'energyBudget', 'exactRiemann', 'exactSolution', "
                       "'firstLawThermo', 'gresho', 'isentropicVortex', 'lineExtract', 'manufacturedError', "
                       "'massProjection', 'minMax', 'noh', 'particleExtract', 'planeAverage', 'planeExtract', 'sedov', "
                       "'simpleWave', 'slice', 'statistics', 'tabulated', 'turbulentFluxes' or 'vorticity' (did you "
                       "mean 'exactRiemann'?)"),
    "unknown choice": (GAS + "volume_model=tracket", GAS + "volume_model: found 'tracket', expected 'cell_share' or "
                       "'tracked' (did you mean 'tracked'?)"),
    "unknown boundary label": ("Grid/BoundaryConditions/Face[1]/BCType/@label=Symetric",
                               "Grid/BoundaryConditions/Face/BCType: label: found 'Symetric', expected 'Symmetric', "
                               "'Velocity' or 'Temperature' (did you mean 'Symmetric'?)"),
    "unknown boundary kind": ("Grid/BoundaryConditions/Face[1]/BCType/@var=symetry",
                              "Grid/BoundaryConditions/Face/BCType: var: found 'symetry', expected 'symmetry', "
                              "'Dirichlet' or 'Neumann' (did you mean 'symmetry'?)"),
    "unknown side": ("Grid/BoundaryConditions/Face[1]/@side=w-",
                     "Grid/BoundaryConditions/Face: attribute 'side': found "
                     "'w-', expected 'x-', 'x+', 'y-', 'y+', 'z-' or 'z+' (did you mean 'x-'?)"),
    "negative resolution": (BOX + "resolution=[-5,1,1]", BOX +
                            "resolution: found '[-5,1,1]', expected a value of at least 1"),
    "zero resolution": (BOX + "resolution=[0,1,1]",
                        BOX + "resolution: found '[0,1,1]', expected a value of at least 1"),
    "huge resolution": (BOX + "resolution=[2000000000,100,1]",
                        "Grid/Level/Box: resolution [2000000000,100,1] gives 2e+11 cells; at most 2.15e+09 are "
                        "possible"),
    "fractional resolution": (BOX + "resolution=[1.5,1,1]", BOX +
                              "resolution: in '[1.5,1,1]': found '1.5', expected an integer"),
    "not a number": ("Time/maxTime=soon", "Time/maxTime: found 'soon', expected a number"),
    "infinite": ("Time/maxTime=inf", "Time/maxTime: found 'inf', expected"),
    "maxTime of 0": ("Time/maxTime=0", "Time/maxTime: found '0', expected a value greater than 0 s"),
    "a negative dt": ("Time/delt_max=-1", "Time/delt_max: found '-1', expected a value of at least 0 s"),
    "no multiplier": ("Time/timestep_multiplier=0", "Time/timestep_multiplier: found '0', expected a value greater "
                                                    "than 0"),
    "negative cfl": (GAS + "cfl=-1", GAS + "cfl: found '-1', expected a value greater than 0"),
    "inverted box": (BOX + "upper=[-1,1,1]", "Grid/Level/Box: upper is below lower along x: -1 < 0 m"),
    "no extent": (BOX + "upper=[0,1,1]", "Grid/Level/Box: there are 100 cells along x, but the box has no extent "
                                         "along this axis"),
    "more patches than cells": (BOX + "patches=[101,1,1]", "Grid/Level/Box: there are 101 patches along x, but only "
                                                           "100 cells"),
    "both patches and autoPatch": (BOX + "autoPatch=4", "Grid/Level/Box: gives both patches and autoPatch; keep one"),
    "both spacing and resolution": ("Grid/Level/spacing=[.01,1,1]",
                                    "Grid/Level: gives both spacing and resolution; keep one"),
    "periodic": ("Grid/Level/periodic=[2,0,0]", "Grid/Level/periodic: found '[2,0,0]', expected a value from 0 to 1"),
    "no particles": (LEFT + "res=[0,1,1]", "MaterialProperties/MPM/material/geom_object/res: found '[0,1,1]', expected "
                     "a value from 1 to 64"),
    "negative density": (LEFT + "density=-1", "MaterialProperties/MPM/material/geom_object/density: found '-1', "
                         "expected a value greater than 0 kg/m^3"),
    "gamma of 1": (MATERIAL + "constitutive_model/gamma=1", MATERIAL +
                   "constitutive_model/gamma: found '1', expected a value "
                   "greater than 1"),
    "bad formula": (LEFT + "density=1+", "MaterialProperties/MPM/material/geom_object/density: found '1+', expected a "
                                         "number"),
    "pressure and temperature": (LEFT + "temperature=300", "MaterialProperties/MPM/material/geom_object: gives both "
                                 "<pressure> and <temperature>; keep one"),
    "flat shape": (LEFT + "box/max=[0,1,1]", "MaterialProperties/MPM/material/geom_object/box"),
    "density that is not a number": (LEFT + "density=sqrt(x-0.2)",
                                     "geom_object: its density is -nan at the point (0.000625, "
                                     "0.5, 0.5); expected a density greater than 0"),
    "pressure negative in places": (LEFT + "pressure=x-0.1", "geom_object: its pressure is -0.099375 at the point"),
    "overlapping boxes": (LEFT + "box/max=[0.6,1,1]", "geom_object: overlaps the geom_object at"),
    "both output intervals": ("DataArchiver/outputTimestepInterval=5", "DataArchiver: gives both outputInterval and "
                              "outputTimestepInterval; keep one"),
    "folder in filebase": ("DataArchiver/filebase=a/b.uda", "DataArchiver/filebase: found 'a/b.uda', expected the name "
                                                            "of a "
                           "folder"),
    "folder itself as filebase": ("DataArchiver/filebase=..",
                                  "DataArchiver/filebase: found '..', expected the name of a folder"),
    "outputs too near to each other": ("DataArchiver/outputInterval=1e-13",
                                       "DataArchiver/outputInterval: found 1e-13 s, expected "
                                       "more than 2e-13 s"),
    "flag that is neither": ("DataArchiver/outputInitTimestep=maybe",
                             "DataArchiver/outputInitTimestep: found 'maybe', expected "
                             "true or false"),
    "unknown placement": (LEFT + "placement=jitterd", "MaterialProperties/MPM/material/geom_object/placement: found "
                          "'jitterd', expected 'midpoint', 'jittered' or 'random' (did you mean 'jittered'?)"),
    "unknown saved label": ("DataArchiver/save[1]/@label=p.densty",
                            "DataArchiver/save: no task of this component computes "
                            "'p.densty' (did you mean 'p.density'?); available: 'CellError.density'"),
    "unknown saved material": ("DataArchiver/save[1]/@material=gass",
                               "DataArchiver/save: there is no material 'gass' (did you "
                               "mean 'gas'?); available: 'gas'"),
    "checkpoint without interval": ("DataArchiver/checkpoint/@cycle=2",
                                    "DataArchiver/checkpoint: gives none of interval, "
                                    "timestepInterval, walltimeInterval and walltimeIntervalHours; give exactly one"),
    "no checkpoint kept": ("DataArchiver/checkpoint/@cycle=0", "DataArchiver/checkpoint: attribute 'cycle': found '0', "
                           "expected a value of at least 1"),
    "unknown checkpoint interval": ("DataArchiver/checkpoint/@timestepinterval=2",
                                    "DataArchiver/checkpoint: unknown attribute "
                                    "'timestepinterval' of <checkpoint> (did you mean 'timestepInterval'?)"),
    "redistribution that cannot be": (GAS + "redistribute/min_particles=20",
                                      GAS + "redistribute: min_particles is greater than "
                                      "max_particles"),
    "ambiguous override": (MATERIAL + "geom_object/cfl=1", f"--set {MATERIAL}geom_object/cfl=1: 2 tags <geom_object> "
                                                           f"in <material> match; choose one, such as geom_object[1] "
                                                           f"or geom_object["),
    "override without a value": ("Time/maxTime", "--set Time/maxTime: expected PATH=VALUE, such as Time/maxTime=0.2"),
}

FAR = "<min>[5,0,0]</min><max>[6,1,1]</max>"

# name: (scene, position, sentence)
TEXTS = {
    "empty file": ("", "", "is empty"),
    "unclosed tag": ("<Uintah_specification>\n  <Time>\n", ":3:1", "found the end of the file while <Time> of "),
    "wrong root": ("<Uintah_spec>\n</Uintah_spec>\n", ":1:2", "Uintah_specification"),
    "tag given twice": (SOD.replace("<Time>", "<Time>\n    <maxTime>1</maxTime>"), ":15:6",
                        "Time/maxTime: tag <maxTime> is given twice, on line 14 and on line 15; only one is allowed"),
    "missing section": (SOD[:SOD.index("  <Grid>")] + SOD[SOD.index("  </Grid>") + 10:], ":10:2",
                        "the section <Grid> is missing"),
    "missing value": (SOD.replace("<maxTime>0.2</maxTime>", ""), ":13:4", "Time: missing tag <maxTime> in <Time>"),
    "missing attribute": (SOD.replace('side="x-"', ""), ":19:8", "missing attribute 'side' of <Face>"),
    "unknown attribute": (SOD.replace('side="x-"', 'side="x-" sied="x"'), ":19:8",
                          "unknown attribute 'sied' of <Face> (did you mean 'side'?)"),
    "text among tags": (SOD.replace("<Time>", "<Time> soon "), ":13:4",
                        "text 'soon' in <Time>, where only tags are allowed"),
    "text in the outermost tag": (SOD.replace("<Time>", "soon <Time>"), "",
                                  "text 'soon' in <Uintah_specification>, where only tags are allowed"),
    "an attribute of the outermost tag": (SOD.replace("<Uintah_specification>", '<Uintah_specification version="2">'),
                                          "", "unknown attribute 'version' of <Uintah_specification>"),
    "text among modules": (SOD.replace("<DataAnalysis>", "<DataAnalysis> soon"), "",
                           "text 'soon' in <DataAnalysis>, where only tags are allowed"),
    "an attribute of modules": (SOD.replace("<DataAnalysis>", '<DataAnalysis name="x">'), "",
                                "unknown attribute 'name' of <DataAnalysis>"),
    "an attribute of a title": (SOD.replace("<title>", '<title lang="en">'), "", "unknown attribute 'lang' of <title>"),
    "loads on a gas": (SOD.replace("<MaterialProperties>", "<PhysicalBC/><MaterialProperties>"), "",
                       "PhysicalBC: a gas cannot have <PhysicalBC>"),
    "two checkpoint intervals": (SOD.replace("<filebase>", '<checkpoint interval="1" timestepInterval="2"/><filebase>'),
                                 ":36:6",
                                 "gives more than one of interval, timestepInterval, walltimeInterval and "
                                 "walltimeIntervalHours; give exactly one"),
    "start without wall time": (SOD.replace("<filebase>", '<checkpoint interval="1" walltimeStart="2"/><filebase>'),
                                ":36:6",
                                "DataArchiver/checkpoint: gives walltimeStart without walltimeInterval"),
    "second checkpoint": (SOD.replace("<filebase>", '<checkpoint interval="1"/><checkpoint interval="2"/><filebase>'),
                          ":36:32",
                          "tag <checkpoint> is given twice"),
    "second Box": (SOD.replace("</Level>", "<Box><lower>[1,0,0]</lower><upper>[2,1,1]</upper>"
                               "<resolution>[9,1,1]</resolution></Box></Level>"), ":33:6",
                   "its cells are 0.111111 m wide along x, but those of the first Box, at "),
    "second Level": (SOD.replace("</Level>", "</Level><Level><Box><lower>[0,0,0]</lower><upper>[.5,1,1]</upper>"
                                 "<resolution>[100,1,1]</resolution></Box></Level>"), ":33:14",
                     "'mpm' needs a grid of one level: its gas fills the grid"),
    "levels of <AMR>": (SOD.replace("</Grid>", '</Grid><AMR><Regridder><adaptive>true</adaptive></Regridder><MPM>'
                                    '<Refinement_Criteria_Thresholds><Variable name="p.x" value="1"/>'
                                    '</Refinement_Criteria_Thresholds></MPM></AMR>'), ":34:11",
                        "'mpm' needs a grid of one level: its gas fills the grid"),
    "unknown tag of <AMR>": (SOD.replace("</Grid>", "</Grid><AMR><Regridder><max_level>2</max_level></Regridder>"
                                          "</AMR>"), ":34:27",
                             "unknown tag <max_level> in <Regridder> (did you mean 'max_levels'?)"),
    "unknown type of threshold":
        (SOD.replace("</Grid>", '</Grid><AMR><MPM><Refinement_Criteria_Thresholds><Variable name="c.x" value="1" '
                     'type="gradiant"/></Refinement_Criteria_Thresholds></MPM></AMR>'), ":34:",
         "attribute 'type': found 'gradiant', expected 'jump', 'second_derivative', 'gradient', 'above' or 'below' "
         "(did you mean 'gradient'?)"),
    "levels of no three integers": (SOD.replace("</Grid>", "</Grid><AMR><Regridder><min_patch_size>8</min_patch_size>"
                                                "</Regridder></AMR>"), ":34:27",
                                    "expected lists of three integers, such as [[1,2,3]]"),
    "a solid without density": (SOD[:SOD.index("    <gas_dynamics>")] + SOD[SOD.index("    </gas_dynamics>") + 20:],
                                ":55:8",
                                "MaterialProperties/MPM/material: missing tag <density> in <material>"),
    "no particle on the grid": (SOD.replace("<min>[0,0,0]</min><max>[0.5,1,1]</max>", FAR)
                                .replace("<min>[0.5,0,0]</min><max>[1,1,1]</max>",
                                         FAR.replace("5,", "7,").replace("6,", "8,")), ":63:10",
                                "geom_object: it has no particle: none of the points where particles start"),
    "unknown shape": (SOD.replace('<box label="left">', '<bax label="left">')
                      .replace("</min><max>[0.5,1,1]</max></box>", "</min><max>[0.5,1,1]</max></bax>"), ":64:12",
                      "(did you mean 'box'?)"),
}


class BrokenScenes(unittest.TestCase):
    def assert_refused(self, result, sentence):
        self.assertEqual(result.code, 3, result.err)
        self.assertIn(sentence, result.err)
        self.assertEqual(result.files, [])
        self.assertEqual(result.out, "")

    def test_conditions_on_periodic_sides_are_said_to_do_nothing(self):
        result = run("ups/mpm/smooth_wave.ups", "Grid/Level/periodic=[1,0,0]", "Time/max_Timesteps=1", options=())
        self.assertEqual(result.code, 0, result.err)
        self.assertEqual((result.out + result.err).count("x is periodic, so this side can have no condition"), 2)

    def test_overrides_that_cannot_be(self):
        for name, (override, sentence) in OVERRIDES.items():
            with self.subTest(name):
                result = run("ups/mpm/sod.ups", override, outputs=True)
                self.assert_refused(result, sentence)
                self.assertEqual(len(result.err.strip().splitlines()), 1, result.err)

    def test_scenes_that_cannot_be(self):
        for name, (text, position, sentence) in TEXTS.items():
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                scene = pathlib.Path(folder, "scene.ups")
                scene.write_text(text)
                result = run(scene, outputs=True)
                self.assert_refused(result, sentence)
                self.assertIn(f"{scene}{position}", result.err)

    def test_boxes_that_cannot_stand_anywhere(self):
        result = run("ups/mpm/sod_conserving.ups", LEFT + "placement=random", outputs=True)
        self.assert_refused(result, "geom_object: placement: the boxes of <conserving_gas_dynamics> must fill the gas "
                                    "without gaps; use midpoint")

    def test_stiffened_gases_that_nothing_holds(self):
        stiff = MATERIAL + "constitutive_model/@type=stiffened_gas", MATERIAL + "constitutive_model/p_infinity=6e8"
        measured = ("DataAnalysis/Module/p_infinity=6e8",)
        for scene, sets, sentence in (
                ("mpm/sod", (), "type: <gas_dynamics> takes only an ideal_gas; use <conserving_gas_dynamics>"),
                ("stability/sod_moving", measured, "type: a stiffened_gas needs a grid whose sides are symmetry planes "
                                                   "or periodic"),
                ("stability/sod", (*measured, LEFT + "box/max=[0.4,1,1]"),
                 "type: a stiffened_gas must fill the grid, and "),
                ("stability/sod", (), "Module: p_infinity: found 0 Pa, but the gas of the scene has 6e+08 Pa")):
            with self.subTest(scene):
                self.assert_refused(run(f"ups/{scene}.ups", *stiff, *sets, outputs=True), sentence)

    def test_gases_that_cannot_be_together(self):
        method, air = "MPM/conserving_gas_dynamics/", "MaterialProperties/MPM/material[2]/"
        for sets, sentence in (
                (("MPM/conserving_gas_dynamics/transfer=affine_flip",), "several gases need <transfer> apic"),
                ((method + "remap/every=4",), "several gases cannot have a <remap>; remove it"),
                ((method + "artificial_heat_conduction=1",), "several gases cannot have <artificial_heat_conduction>"),
                ((air + "relaxation/rate=1", air + "relaxation/internal_energy=1"),
                 "several gases cannot have <relaxation>"),
                ((air + "@name=water",), "two materials are called 'water'; give each a different name"),
                ((air + "geom_object/box/min=[0.6,0,0]",),
                  "several gases must fill the grid without overlap, but they fill 2 of"),
                ((air + "geom_object/box/min=[0.8,0,0]",),
                  "several gases must fill the grid without overlap, but they fill 0 of"),
                (("DataAnalysis/Module/right/gamma=1.5",),
                 "Module: gamma and p_infinity: found 1.5 and 0 Pa, but no gas of the scene has these values")):
            with self.subTest(sentence):
                self.assert_refused(run("ups/stability/water_air.ups", *sets, outputs=True), sentence)

    def test_a_mass_projection_that_cannot_be_measured(self):
        for sets, sentence in (((BOX + "resolution=[20,2,1]",),
                                "works only in one dimension, like its theorem, but this grid has 2"),
                               ((GAS + "volume_model=tracked",), "volume_model is tracked; use cell_share")):
            self.assert_refused(run("ups/mpm/mass_projection.ups", *sets, outputs=True), sentence)
        self.assert_refused(run("ups/heat/sine.ups", "DataAnalysis/Module[2]/@name=massProjection", outputs=True),
                            "DataAnalysis/Module: measures the <gas_dynamics> of the component mpm, which this scene "
                            "does not run")

    def test_labels_of_modules_can_be_saved_where_the_module_is(self):
        result = run("ups/mpm/sod.ups", "DataArchiver/save[1]/@label=g.massProjectionError", outputs=True)
        self.assert_refused(result, "no task of this component computes 'g.massProjectionError'")
        self.assertEqual(run("ups/mpm/sod.ups", "DataArchiver/save[1]/@label=g.massProjectionError",
                             "DataAnalysis/Module[2]/@name=massProjection", outputs=True).code, 0)

    def test_a_missing_file_and_a_folder(self):
        self.assert_refused(run("ups/mpm/sodd.ups", outputs=True), "ups/mpm/sodd.ups: there is no such file")
        self.assert_refused(run("ups/mpm", outputs=True), "ups/mpm")

    def test_all_mistakes_of_a_scene_at_once_in_the_order_of_lines(self):
        text = SOD.replace("<maxTime>0.2", "<maxTime>-1").replace("[100,1,1]",
                                                                  "[0,1,1]").replace("<cfl>0.2125", "<cfl>x")
        text = text.replace('label="p.density"', 'label="p.dnsity"').replace("<gamma>1.4</gamma></c",
                                                                             "<gama>2</gama></c")
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder, "scene.ups")
            scene.write_text(text)
            result = run(scene, outputs=True)
        lines = result.err.strip().splitlines()
        self.assertEqual(len(lines), 4, result.err)
        for line, tag in zip(lines, ("Time/maxTime", "Grid/Level/Box/resolution", "MPM/gas_dynamics/cfl", "gama")):
            self.assertIn(tag, line)
        numbers = [int(line.split(":")[1]) for line in lines]
        self.assertEqual(numbers, sorted(numbers))

    def test_a_bad_command_line_exits_with_2(self):
        result = run("ups/mpm/sod.ups", options=("--quiet", "--jsn", "x"))
        self.assertEqual(result.code, 2)
        self.assertIn("sus: unknown option '--jsn' (did you mean '--json'?)", result.err)
        self.assertEqual(run("ups/mpm/sod.ups", options=("-emit_taskgraphs",)).err,
                         "sus: unknown option '-emit_taskgraphs'; sus -h lists the options [T701]\n")
        self.assertEqual(run("ups/mpm/sod.ups", options=("ups/heat/sine.ups",)).err,
                         "sus: only one scene can be run: found 'ups/heat/sine.ups' after 'ups/mpm/sod.ups' [T701]\n")

    def test_says_what_it_has_checked(self):
        for scene, size in (("ups/mpm/sod.ups", "100 cells and 450 particles at the start"),
                            ("ups/heat/sine.ups", "64 cells")):
            self.assertEqual(run(scene, options=("--check",)).out, f"{scene}: fine, {size}\n")

    def test_a_screen_that_takes_nothing(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([SUS, "--list"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual((done.returncode, done.stderr), (1, "sus: standard output cannot be written [T402]\n"))


if __name__ == "__main__":
    unittest.main()
