#!/usr/bin/env python3
"""Solids against what mechanics says about their scenes."""
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import globals_of, relative_drift
from sus import run

PLAIN_SHAPES = ("linear", "gimp", "3rdorderBS", "4thorderBS")


def observed_order(scene, coarse, fine, *sets):
    """The order of the displacement's mean error between two numbers of cells."""
    errors = [run(scene, f"Grid/Level/Box/resolution=[{n},{n},1]", *sets).report["errors"]["displacement"]["particle"]["L1"]
              for n in (coarse, fine)]
    return math.log(errors[0] / errors[1]) / math.log(fine / coarse)


class Bar(unittest.TestCase):
    def test_the_first_frequency_is_that_of_a_bar(self):
        lines = globals_of("ups/solid/bar_vibration.ups", "TotalMomentum")["TotalMomentum"]
        crossings = [a[0] + (b[0] - a[0]) * a[1] / (a[1] - b[1]) for a, b in zip(lines, lines[1:]) if a[1] * b[1] < 0]
        omega = math.pi * (len(crossings) - 1) / (crossings[-1] - crossings[0])
        self.assertAlmostEqual(omega / (100 * math.pi), 1, delta=1e-3)

    def test_energy_is_kept(self):
        values = globals_of("ups/solid/bar_vibration.ups", "KineticEnergy", "StrainEnergy")
        # hypo_elastic's StrainEnergy is what a step adds: the sum over the run is the energy.
        stored, total = 0, []
        for kinetic, strain in zip(values["KineticEnergy"], values["StrainEnergy"]):
            stored += strain[1]
            total.append(kinetic[1] + stored)
        self.assertLess(max(total) / total[0] - 1, 1e-2)


class Cylinder(unittest.TestCase):
    def test_the_work_of_the_pressure_is_lames(self):
        values = globals_of("ups/solid/thick_cylinder.ups", "StrainEnergy")["StrainEnergy"]
        young, poisson, p, a, b = 166.1538e9, .0384615, 2 * math.pi * 1e7, .5, 1
        r = .505  # of the innermost particles, which carry the pressure
        widening = p * a**2 * (1 + poisson) / (young * (b**2 - a**2)) * ((1 - 2 * poisson) * r + b**2 / r)
        work = .5 * p * a * .02 * widening  # of one radian of a slice of 2 cm
        late = [line[1] for line in values if line[0] > .032]
        self.assertAlmostEqual(sum(late) / len(late) / work, 1, delta=.01)


class Conservation(unittest.TestCase):
    """Of a disc on which nothing acts. Round-off: some 1e3 steps of sums over 1e3 particles."""
    SCENE = "ups/solid/spinning_disc.ups"

    def drift(self, name, *sets):
        return relative_drift(globals_of(self.SCENE, name, sets=sets)[name])

    def test_momentum_is_kept_by_every_shape_and_transfer(self):
        ways = [("MPM/apic=false", f"MPM/interpolator={shape}") for shape in (*PLAIN_SHAPES[1:], "cpdi")]
        ways += [("MPM/apic=false", "MPM/stress_update=musl"), ("MPM/apic=false", "MPM/stress_update=usf"),
                 ("MPM/apic=false", "MPM/XPIC2=true"), ("MPM/apic=false", "MPM/pic_fraction=.1"), ()]
        for way in ways:
            with self.subTest(way=way):
                self.assertLess(self.drift("TotalMomentum", *way, "Time/maxTime=.05"), 1e-12)

    def test_apic_keeps_angular_momentum(self):
        for shape in PLAIN_SHAPES[1:]:
            with self.subTest(shape=shape):
                self.assertLess(self.drift("AngularMomentum", f"MPM/interpolator={shape}"), 1e-12)

    def test_energy_never_grows(self):
        for way in ((), ("MPM/apic=false", "MPM/XPIC2=true"), ("MPM/apic=false", "MPM/stress_update=musl")):
            with self.subTest(way=way):
                values = globals_of(self.SCENE, "KineticEnergy", "StrainEnergy", sets=way)
                total = [k[1] + s[1] for k, s in zip(values["KineticEnergy"], values["StrainEnergy"])]
                self.assertLess(max(total), total[0] * (1 + 1e-3), "what the swinging of the spin-up leaves")


class ManufacturedSolutions(unittest.TestCase):
    def test_wide_shapes_are_of_second_order_on_the_vortex(self):
        for shape in ("gimp", "cpdi", "3rdorderBS"):
            with self.subTest(shape=shape):
                order = observed_order("ups/solid/generalized_vortex.ups", 24, 48, f"MPM/interpolator={shape}")
                self.assertGreater(order, 1.8)


class SameBits(unittest.TestCase):
    def test_every_way_gives_the_same_bits_on_any_patches(self):
        ways = [("MPM/apic=false", "MPM/interpolator=cpdi"), ("MPM/apic=false", "MPM/stress_update=musl"),
                ("MPM/apic=false", "MPM/stress_update=usf"), ("MPM/apic=false", "MPM/XPIC2=true"), ()]
        for way in ways:
            with self.subTest(way=way):
                prints = {run("ups/solid/spinning_disc.ups", f"Grid/Level/Box/patches={layout}", "Time/max_Timesteps=30",
                              *way).report["fingerprint"] for layout in ("[1,1,1]", "[2,3,1]")}
                self.assertEqual(len(prints), 1)


if __name__ == "__main__":
    unittest.main()
