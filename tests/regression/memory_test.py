#!/usr/bin/env python3
"""No run takes more memory the longer it lasts: every component and both kinds of particles, in one, two and three
dimensions, on several patches and ranks."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import run

FEW, MANY = 50, 400
MOST = 1.05  # times the memory after few steps
# Bytes of pages that a program of 20 MB touches late. Where variables grow at all, they do by a multiple of this: a
# single buffer of a thousand particles that is lost in each step makes 8 MB.
TOUCHED_LATE = 2e6
# Steps with a global solve take many times as long as others: fewer of them, of which each may lose about as much,
# 12.5 kB (by the limits above, of a program of 55 MB with PETSc, 13.6 kB).
FEW_SOLVES, MANY_SOLVES = 40, 120
TOUCHED_LATE_BY_SOLVES = 1e6

BOX = "Grid/Level/Box"
LINE = (f"{BOX}/resolution=[200,1,1]",)
PLANE = (f"{BOX}/resolution=[40,6,1]", f"{BOX}/upper=[1,.15,1]")
SPACE = (f"{BOX}/resolution=[16,4,4]", f"{BOX}/upper=[1,.25,.25]")
SMALL_SPACE = (f"{BOX}/resolution=[12,12,4]",)
SPHERES = (f"{BOX}/resolution=[12,12,12]", "Time/timestep_multiplier=0.1")
IMPLICIT = ("MPM/time_integrator=implicit", "Time/delt_max=1e-3", "Time/delt_init=1e-3", "Time/timestep_multiplier=1")
GIMP, CPDI = "MPM/interpolator=gimp", "MPM/interpolator=cpdi"

# Scene, overrides, layout of patches.
CASES = {
    "burgers on levels": ("ups/burgers/levels.ups", (f"{BOX}/resolution=[32,1,1]",), "4x1x1"),
    "burgers": ("ups/burgers/sine.ups", LINE, "4x1x1"),
    "heat": ("ups/heat/sine.ups", PLANE, "4x2x1"),
    "heat on levels": ("ups/heat/levels.ups", (), "4x1x1"),
    "implicit heat in 1-D": ("ups/heat/implicit.ups", (), "4x1x1"),
    "implicit heat in 2-D": ("ups/heat/implicit.ups", PLANE, "4x2x1"),
    "implicit heat in 3-D": ("ups/heat/implicit.ups", SPACE, "4x2x2"),
    "implicit heat on levels": ("ups/heat/implicit_levels.ups", (), "2x2x1"),
    "poisson in 1-D": ("ups/poisson/sine.ups", (f"{BOX}/resolution=[48,1,1]",), "4x1x1"),
    "poisson in 2-D": ("ups/poisson/sine.ups", (f"{BOX}/resolution=[16,16,1]",), "2x2x1"),
    "poisson in 3-D": ("ups/poisson/sine.ups", (f"{BOX}/resolution=[8,8,8]",), "2x2x2"),
    "poisson on levels": ("ups/poisson/levels.ups", (), "2x2x1"),
    "euler in 1-D": ("ups/euler/sod.ups", LINE, "4x1x1"),
    "euler in 2-D": ("ups/euler/vortex.ups", (f"{BOX}/resolution=[24,24,1]",), "3x2x1"),
    "euler in 3-D": ("ups/euler/vortex_3d.ups", SMALL_SPACE, "2x2x2"),
    "ice in 1-D": ("ups/ice/sod.ups", LINE, "4x1x1"),
    "ice in 2-D": ("ups/ice/vortex_slow.ups", (f"{BOX}/resolution=[24,24,1]",), "3x2x1"),
    "ice in 3-D": ("ups/ice/sod.ups", SPACE, "4x2x2"),
    "implicit ice": ("ups/ice/sod_implicit.ups", LINE, "4x1x1"),
    "two gases": ("ups/ice/two_gases.ups", LINE, "4x1x1"),
    "bodies in gas in 1-D": ("ups/fsi/closed_box.ups", (), "4x1x1"),
    "bodies in gas in 2-D": ("ups/fsi/carried_disc.ups", (f"{BOX}/resolution=[24,24,1]",), "3x2x1"),
    "bodies in gas in 3-D": ("ups/fsi/ball.ups", (f"{BOX}/resolution=[12,6,6]",), "2x2x2"),
    "rigid bodies in gas": ("ups/fsi/slow_piston.ups", (), "4x1x1"),
    "implicit solids in 1-D": ("ups/solid/bar_vibration.ups", IMPLICIT, "4x1x1"),
    "implicit solids in 3-D": ("ups/solid/implicit_cantilever.ups", (f"{BOX}/resolution=[8,5,2]",), "2x1x1"),
    "implicit solids in 2-D": ("ups/solid/implicit_cantilever.ups", (f"{BOX}/resolution=[12,8,1]",), "2x2x1"),
    "euler on levels": ("ups/euler/vortex_levels.ups", (), "2x2x1"),
    "solids on levels": ("ups/solid/penetration_levels.ups", (), "2x2x1"),
    "gas in 1-D": ("ups/mpm/sod.ups", LINE, "4x1x1"),
    "gas in 2-D": ("ups/mpm/sod.ups", PLANE, "4x2x1"),
    "gas in 3-D": ("ups/mpm/sod.ups", SPACE, "4x2x2"),
    "redistributed gas": ("ups/mpm/sod_redistribute.ups", PLANE, "4x2x1"),
    "conserving gas in 1-D": ("ups/mpm/smooth_wave_conserving.ups", (), "4x1x1"),
    "conserving gas in 2-D": ("ups/mpm/vortex.ups", (f"{BOX}/resolution=[20,20,1]",), "3x2x1"),
    "conserving gas in 3-D": ("ups/mpm/vortex_3d.ups", (f"{BOX}/resolution=[8,8,4]",), "2x2x2"),
    "solids in 1-D": ("ups/solid/riemann.ups", (), "4x1x1"),
    "solids in 2-D": ("ups/solid/two_discs.ups", (), "3x2x1"),
    "solids in 3-D": ("tests/benchmark/spheres.ups", SPHERES, "2x2x2"),
    "solids in 3-D, GIMP": ("tests/benchmark/spheres.ups", (*SPHERES, GIMP), "3x2x2"),
    "solids in 3-D, CPDI": ("tests/benchmark/spheres.ups", (*SPHERES, CPDI), "2x2x3"),
}


SOLVES = frozenset(name for name in CASES
                   if name.startswith(("implicit", "poisson")) or name in ("ice in 2-D", "rigid bodies in gas"))

# On three ranks, which exchange all that two do, and more: one of each component and kind of particles in each number
# of dimensions that it has. The others on two, and so all with global solves: their ranks wait for each other so often
# that they must not be more than the cores.
ON_THREE_RANKS = ("burgers", "heat", "euler in 3-D", "gas in 1-D", "gas in 3-D", "conserving gas in 2-D",
                  "conserving gas in 3-D",
                  "solids in 1-D", "solids in 2-D", "solids in 3-D, GIMP", "ice in 3-D", "two gases",
                  "bodies in gas in 2-D", "bodies in gas in 3-D", "euler on levels", "solids on levels")


class Memory(unittest.TestCase):
    def after(self, steps, name, ranks):
        scene, sets, layout = CASES[name]
        options = ("--quiet", *(("-layout", layout) if layout else ()))
        ends = ("Time/maxTime=1e9", f"Time/max_Timesteps={steps}", "DataArchiver/outputTimestepInterval=0")
        result = run(scene, *sets, *ends, options=options, ranks=ranks)
        self.assertIsNotNone(result.report, result.err)
        self.assertEqual(result.report["steps"], steps, result.err)
        return result.report["memory"]["resident"]

    def check(self, names, ranks):
        for name in names:
            solves = name in SOLVES
            steps = (FEW_SOLVES, MANY_SOLVES) if solves else (FEW, MANY)
            with self.subTest(name, ranks=ranks):
                for _ in range(3):  # memory that is lost is lost each time; pages touched by chance are not
                    few, many = (self.after(count, name, ranks) for count in steps)
                    self.assertGreater(few, 0)
                    most = few + TOUCHED_LATE_BY_SOLVES if solves else MOST * few + TOUCHED_LATE
                    if many <= most:
                        break
                self.assertLessEqual(many, most,
                                     f"{few / 1e6:.1f} MB after {steps[0]} steps, {many / 1e6:.1f} after {steps[1]}")

    def test_on_several_patches(self):
        self.check(CASES, 1)

    def test_on_two_ranks(self):
        self.check([name for name in CASES if name not in ON_THREE_RANKS], 2)

    def test_on_three_ranks(self):
        self.check(ON_THREE_RANKS, 3)


if __name__ == "__main__":
    unittest.main()
