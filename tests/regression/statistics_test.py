#!/usr/bin/env python3
"""The modules statistics and turbulentFluxes: means and moments over time agree with those of the outputs of all steps,
are the same on any layout, on levels and after a restart, and Uintah's names are understood."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from module_runs import SMALL, VORTEX, ModuleTest, np, sus, tushar
from sus import ROOT


def module(name, variables, tags="", start=0, stop=100):
    looked_at = "".join(f"<analyze {one}/>" for one in variables)
    times = f"<timeStart>{start}</timeStart><timeStop>{stop}</timeStop>"
    return f'<Module name="{name}">{times}<Variables>{looked_at}</Variables>{tags}</Module>'


def saves(*names):
    return "".join(f'<save label="{name}"/>' for name in names)


HIGHER = "<computeHigherOrderStats>true</computeHigherOrderStats>"
STRESS = 'label="c.velocity" computeReynoldsStress="true"'
STATISTICS = module("statistics", ('label="c.pressure"', STRESS, 'label="c.density"'), HIGHER)
NAMES = ("mean_pressure", "variance_pressure", "mean_velocity", "variance_velocity", "skewness_velocity",
         "kurtosis_velocity", "uv_vw_wu_prime", "mean_uv_vw_wu", "mean_density", "mean2_density", "sum_density",
         "kurtosis_density")
FLUXES = module("turbulentFluxes", ('label="c.temperature"', 'label="c.velocity" fluidVelocityLabel="true"'))


class Statistics(ModuleTest):
    def scene(self, modules, names, of=VORTEX):
        return self.with_modules(of, modules, saves(*names))

    def samples(self, archive, label, first=1):
        whole = tushar.open(archive)
        return np.stack([whole[k][label][:] for k, step in enumerate(whole.steps) if step >= first])

    def test_moments_agree_with_the_outputs_of_all_steps(self):
        archive = self.run_in("whole", self.scene(STATISTICS, NAMES), *SMALL)
        last = tushar.open(archive)[-1]
        for label in "pressure", "velocity", "density":
            all_of = self.samples(archive, f"c.{label}")
            self.assertEqual(len(all_of), 10)
            mean, scale = all_of.mean(axis=0), np.abs(all_of).max()
            np.testing.assert_allclose(last[f"c.mean_{label}"][:], mean, rtol=1e-14, atol=1e-15)
            for power, name in (2, "variance"), (3, "skewness"), (4, "kurtosis"):
                if f"{name}_{label}" not in NAMES:
                    continue
                # round-off of deviations from a mean of this size, with the second moment of up to 1 that they have
                np.testing.assert_allclose(last[f"c.{name}_{label}"][:], ((all_of - mean)**power).mean(axis=0),
                                           atol=1e-14 * scale**2)
        density, velocity = (self.samples(archive, f"c.{label}") for label in ("density", "velocity"))
        self.assertGreater(last["c.variance_velocity"][:].max(), 1e-5)
        np.testing.assert_allclose(last["c.mean2_density"][:], (density**2).mean(axis=0), rtol=1e-14)
        np.testing.assert_allclose(last["c.sum_density"][:], density.sum(axis=0), rtol=1e-14)
        mixed = velocity * np.roll(velocity, -1, axis=-1)  # uv, vw, wu
        np.testing.assert_allclose(last["c.mean_uv_vw_wu"][:], mixed.mean(axis=0), atol=1e-14)
        mean = velocity.mean(axis=0)
        np.testing.assert_allclose(last["c.uv_vw_wu_prime"][:], mixed.mean(axis=0) - mean * np.roll(mean, -1, axis=-1),
                                   atol=1e-14)
        self.assertGreater(np.abs(last["c.uv_vw_wu_prime"][:]).max(), 1e-5)

    def test_only_steps_between_the_times_are_samples(self):
        archive = self.run_in("times", self.scene(module("statistics", ('label="c.density"',)), ()), *SMALL)
        whole = tushar.open(archive)
        start, stop = ((whole.times[whole.steps.index(step)] + whole.times[whole.steps.index(step + 1)]) / 2
                       for step in (3, 7))
        tags = (module("statistics", ('label="c.density"',), "", start, stop) +
                module("statistics", ('label="c.pressure"',), "", stop))
        names = ("mean_density", "sum_density", "mean_pressure")
        part = tushar.open(self.run_in("part", self.scene(tags, names), *SMALL))
        density = self.samples(archive, "c.density")
        self.assertEqual(np.abs(part[part.steps.index(3)]["c.mean_density"][:]).max(), 0)
        np.testing.assert_allclose(part[part.steps.index(5)]["c.sum_density"][:], density[3:5].sum(axis=0), rtol=1e-14)
        for step in 7, 10:
            np.testing.assert_allclose(part[part.steps.index(step)]["c.mean_density"][:], density[3:7].mean(axis=0),
                                       rtol=1e-14)
        np.testing.assert_allclose(part[-1]["c.mean_pressure"][:], self.samples(archive, "c.pressure", 8).mean(axis=0),
                                   rtol=1e-14)

    def test_covariances_with_the_velocity(self):
        scene = self.scene(FLUXES, ("covariance_temperature", "covariance_velocity", "mean_Qu_Qv_Qw_temperature",
                                    "sum_Qu_Qv_Qw_velocity", "mean_temperature2"), ROOT / "ups/ice/gresho_slow.ups")
        few = ["--set", "Time/max_Timesteps=6", "--set", "DataArchiver/outputInterval=0", "--set",
               "DataArchiver/outputTimestepInterval=1", "--set", "Grid/Level/Box/resolution=[16,16,1]"]
        text = scene.read_text()
        scene.write_text(text.replace("</DataArchiver>", saves("temp_CC", "vel_CC") + "</DataArchiver>"))
        archive = self.run_in("fluxes", scene, *few)
        last = tushar.open(archive)[-1]
        temperature, velocity = self.samples(archive, "c.temperature"), self.samples(archive, "c.velocity")
        self.assertEqual(len(velocity), 6)
        with_t, mixed = temperature[..., None] * velocity, velocity * np.roll(velocity, -1, axis=-1)
        scale = temperature.max() * np.abs(velocity).max()
        means = temperature.mean(axis=0)[..., None] * velocity.mean(axis=0)
        np.testing.assert_allclose(last["c.covariance_temperature"][:],
                                   ((temperature - temperature.mean(axis=0))[..., None] *
                                    (velocity - velocity.mean(axis=0))).mean(axis=0), atol=1e-13 * scale)
        np.testing.assert_allclose(last["c.mean_Qu_Qv_Qw_temperature"][:], with_t.mean(axis=0), atol=1e-14 * scale)
        np.testing.assert_allclose(last["c.sum_Qu_Qv_Qw_velocity"][:], mixed.sum(axis=0), atol=1e-13)
        np.testing.assert_allclose(last["c.mean_temperature2"][:], (temperature**2).mean(axis=0), rtol=1e-13)
        self.assertEqual(means.shape, last["c.covariance_temperature"].shape)

    def files_of(self, archive):
        """The bits of all statistics at the end, which are in the archive instead of files of their own."""
        last = tushar.open(archive)[-1]
        return {name: last[f"c.{name}"][:].tobytes() for name in NAMES}

    def test_any_layout_and_a_restart_have_the_same_bits(self):
        moves = lambda found: self.assertTrue(any(found["variance_velocity"]))
        self.assert_same_bytes_on_any_layout(self.scene(STATISTICS, NAMES), moves)

    def test_the_run_is_the_same_with_and_without(self):
        with_it = self.well(sus(self.scene(STATISTICS, NAMES), "--output", self.folder / "a", *SMALL, options=()))
        without = self.well(sus(VORTEX, "--output", self.folder / "b", *SMALL, options=()))
        others = "of other saved variables"  # of the statistics
        prints = [[line for line in text.splitlines() if "fingerprint" in line and others not in line]
                  for text in (with_it, without)]
        self.assertEqual(*prints)
        self.assertEqual(len(prints[0]), 1)

    def test_a_restart_may_begin_statistics(self):
        plain = self.with_modules(VORTEX, "")
        archive = self.run_in("plain", plain, *SMALL, "--set", "Time/max_Timesteps=4")
        self.well(sus("-restart", archive, "--set", "Time/max_Timesteps=10", "--set",
                      "DataAnalysis/Module/@name=statistics", "--set", "DataAnalysis/Module/timeStart=0", "--set",
                      "DataAnalysis/Module/timeStop=9", "--set",
                      "DataAnalysis/Module/Variables/analyze/@label=c.density", "--set",
                      "DataArchiver/save[4]/@label=mean_density"))
        last = tushar.open(archive)[-1]
        np.testing.assert_allclose(last["c.mean_density"][:], self.samples(archive, "c.density", 5).mean(axis=0),
                                   rtol=1e-14)

    def test_refined_grids_carry_their_sums_along(self):
        """On a grid that follows a shock: any ranks and a restart have the same bits, and no sample is lost."""
        blast = ROOT / "ups/euler/blast_levels.ups"
        tags = module("statistics", ('label="c.density"', 'label="c.velocity"'))
        few = ["--set", "Time/max_Timesteps=20", "--set", "DataArchiver/outputInterval=0", "--set",
               "DataArchiver/outputTimestepInterval=1", "--set", "DataArchiver/checkpoint/@timestepInterval=7"]
        names = ("mean_density", "variance_density", "sum_density")
        scene = self.scene(tags, names, blast)
        one = self.run_in("one", scene, *few)
        with_ranks = self.run_in("ranks", scene, *few, ranks=2)
        cut = self.run_in("cut", scene, *few, "--set", "Time/max_Timesteps=15")
        self.well(sus("-restart", cut, "-t", "14", "--set", "Time/max_Timesteps=20"))
        expected = {name: self.values(tushar.open(one)[-1], name) for name in names}
        for archive in with_ranks, cut:
            for name in names:
                self.assertEqual(self.values(tushar.open(archive)[-1], name), expected[name], name)
        smaller = self.run_in("smaller", scene, *few, "--set", "AMR/useLockStep=false")
        for archive in one, smaller:
            last = tushar.open(archive)[-1]
            for mean, total in zip(*(map(np.frombuffer, self.values(last, name)) for name in ("mean_density",
                                                                                              "sum_density"))):
                np.testing.assert_allclose(total, 20 * mean, rtol=1e-13)
                self.assertGreater(len(mean), 0)

    @staticmethod
    def values(state, name):
        found = state[f"c.{name}"]
        levels = found if isinstance(found, (list, tuple)) else [found]
        return [np.asarray(level[:]).tobytes() for level in levels]

    def test_uintahs_names_are_understood(self):
        modules = module("statistics", ('label="press_CC" matl="0"', 'label="vel_CC"', 'label="uvel_FCME"'),
                         "<material>gas</material><samplingFrequency>1000</samplingFrequency>")
        scene = self.scene(modules, ("mean_press_CC", "variance_vel_CC"), ROOT / "ups/ice/channel.ups")
        ended = sus(scene, "--output", self.folder / "ice", "--set", "Time/max_Timesteps=3", options=())
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn("'uvel_FCME' is left out, since no task computes it in this scene", ended.stderr + ended.stdout)
        last = tushar.open(next((self.folder / "ice").glob("*.uda.000")))[-1]
        self.assertEqual(last["c.variance_vel_CC"].shape[-1], 3)
        self.assertGreater(last["c.mean_press_CC"][:].min(), 0)

    def test_mistakes_get_a_sentence(self):
        once = 'label="c.density"'
        wrong = {
            module("statistics", ('label="c.densty"',)):
                "found 'c.densty', expected a variable of cells that belongs to no material (did you mean "
                "'c.density'?)",
            module("statistics", (once, once)): "'c.density' is given twice",
            module("statistics", (once,), start=5, stop=4): "found 4 s, expected timeStart, 5 s, or later",
            module("statistics", ()): "analyze",
            module("statistics", ('label="c.density" computeReynoldsStress="true"',)):
                "found 'c.density', which is not a vector, expected a velocity",
            module("statistics", ('label="c.density" matl="2"',)): "there is no material 2",
            module("turbulentFluxes", (once,)): 'missing attribute fluidVelocityLabel="true" at the velocity',
            module("statistics", (STRESS, STRESS.replace("velocity", "momentum"))):
                "two variables are said to be the velocity; keep one",
            module("statistics", (once,)) + module("turbulentFluxes", (once, STRESS.replace(
                "computeReynoldsStress", "fluidVelocityLabel"))): "a module above already computes 'c.mean_density'",
        }
        for tags, sentence in wrong.items():
            ended = sus(self.scene(tags, ()), "-check")
            self.assertEqual(ended.returncode, 3, tags)
            self.assertIn(sentence, ended.stderr, tags)
        unlisted = sus(self.scene(module("statistics", (once,)), ("mean_pressure",)), "-check")
        self.assertIn("no task of this component computes 'mean_pressure'", unlisted.stderr)


if __name__ == "__main__":
    unittest.main()
