#!/usr/bin/env python3
"""Scalars that fall with time, by rates and exponentially: the solution in closed form, on any layout and after a
restart alike, alone and beside bodies; tables of coefficients, and mistakes in them."""
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from module_runs import ModuleTest, np, sus, tushar
from sus import ROOT

SCALARS = ROOT / "ups/ice/scalars.ups"
SMALL = ["--set", "Grid/Level/Box/resolution=[16,16,1]", "--set", "Time/maxTime=0.4"]
FALLS = "<constants><diffusivity>0</diffusivity>{}</constants>"
DECAYS = "<exponentialDecay><c1>{}</c1><c2{}</c2><c3>{}</c3></exponentialDecay>"


def coefficient(x, y):
    return 1 + x + 3 * y


class Decay(ModuleTest):
    def scene(self, rates="", decay="", start="1", velocity="[1,1,0]", of=SCALARS):
        """The scene with the scalar `wave`, which falls; without the other one and without its reference."""
        text = of.read_text()
        first, last = text.index('    <Model type="PassiveScalar">'), text.rindex('    <Model type="PassiveScalar">')
        text = text[:first] + text[last:]
        text = text[:text.index("<DataAnalysis>")] + "</Uintah_specification>"
        for name in ("scalar-box", "totalSum_scalar-box"):
            text = text.replace(f'<save label="{name}"/>', "")
        text = text.replace('<box label="whole"/>', '<box label="whole"><min>[0,0,0]</min><max>[1,1,1]</max></box>')
        text = text.replace("0.5+0.5*sin(2*pi*x)*sin(2*pi*y)", start).replace("[1,1,0]</velocity>",
                                                                             f"{velocity}</velocity>")
        text = text.replace(FALLS.format(""), FALLS.format(rates)).replace("<initialization>", decay +
                                                                            "<initialization>")
        path = self.folder / "decay.ups"
        path.write_text(text)
        return path

    def values(self, name, scene, *options, ranks=1, label="c.scalar-wave"):
        whole = tushar.open(self.run_in(name, scene, *SMALL, *options, ranks=ranks))
        return whole.times[-1], whole[-1][label][:]

    def table(self, cells=16, change=lambda lines: lines):
        lines = [f"{(i + .5) / cells},{(j + .3) / cells},0.5,{coefficient((i + .5) / cells, (j + .5) / cells)}"
                 for j in range(cells) for i in range(cells)]
        (self.folder / "c2.csv").write_text("\n".join(["# x,y,z,c2", *change(lines)]) + "\n")
        return DECAYS.format("0.5", ' type="variable"><filename>c2.csv</filename>', ".25")

    def test_rates_give_the_closed_form(self):
        cases = {
            "<rateOfChange0>1.5</rateOfChange0>": lambda t: 1 - 1.5 * t,
            "<rateOfChange0>4</rateOfChange0>": lambda t: 0,
            "<rateOfChange0>-1</rateOfChange0>": lambda t: 1 + t,
            "<rateOfChange1>2</rateOfChange1>": lambda t: math.exp(-2 * t),
            "<rateOfChange0>.5</rateOfChange0><rateOfChange1>2</rateOfChange1>":
                lambda t: 1.25 * math.exp(-2 * t) - .25,
        }
        for number, (rates, exact) in enumerate(cases.items()):
            t, found = self.values(f"rates{number}", self.scene(rates))
            self.assertAlmostEqual(t, .4, delta=1e-12)
            np.testing.assert_allclose(found, exact(t), atol=1e-13, err_msg=rates)

    def test_exponential_decay_gives_the_closed_form(self):
        decay = DECAYS.format("4", "><value>.5</value>", "1")
        t, found = self.values("plain", self.scene(decay=decay))
        np.testing.assert_allclose(found, math.exp(-3 * t), rtol=1e-13)
        decay = DECAYS.format("4", ' type="constant"><value>.5</value>', "1")
        together = "<rateOfChange0>.3</rateOfChange0><rateOfChange1>1</rateOfChange1>"
        t, found = self.values("together", self.scene(together, decay))
        np.testing.assert_allclose(found, (1 + .3 / 4) * math.exp(-4 * t) - .3 / 4, rtol=1e-12)

    def test_it_goes_with_the_gas_as_it_falls(self):
        """The same as without decay, times exp(-k t)."""
        start = "0.5+0.5*sin(2*pi*x)*sin(2*pi*y)"
        t, found = self.values("decays", self.scene(decay=DECAYS.format("4", "><value>.5</value>", "0"), start=start))
        _, carried = self.values("carried", self.scene(start=start))
        np.testing.assert_allclose(found, carried * math.exp(-2 * t), rtol=1e-12)

    def test_coefficients_of_cells_come_from_a_file(self):
        scene = self.scene(decay=self.table(), velocity="[0,0,0]")
        t, found = self.values("table", scene)
        y, x = np.meshgrid((np.arange(16) + .5) / 16, (np.arange(16) + .5) / 16, indexing="ij")
        np.testing.assert_allclose(found[0], np.exp(-(.5 * coefficient(x, y) + .25) * t), rtol=1e-12)
        scene.write_text(scene.read_text().replace("</DataArchiver>",
                                                   '<save label="scalar-wave_expDecayCoef"/></DataArchiver>'))
        _, saved = self.values("saved", scene, label="c.scalar-wave_expDecayCoef")
        np.testing.assert_array_equal(saved[0], coefficient(x, y))

    def test_any_layout_and_a_restart_have_the_same_bits(self):
        scene = self.scene("<rateOfChange0>.3</rateOfChange0>", self.table(), "0.5+0.5*sin(2*pi*x)*sin(2*pi*y)")
        _, expected = self.values("one", scene, "-nthreads", "1")
        for name, (ranks, patches) in {"patches": (1, "[2,3,1]"), "ranks": (3, "[4,2,1]")}.items():
            _, found = self.values(name, scene, "--set", f"Grid/Level/Box/patches={patches}", ranks=ranks)
            self.assertEqual(found.tobytes(), expected.tobytes(), name)
        cut = self.run_in("cut", scene, *SMALL, "--set", "DataArchiver/checkpoint/@timestepInterval=3", "--set",
                          "Time/max_Timesteps=4")
        self.well(sus("-restart", cut, "-t", "3", "--set", "Time/max_Timesteps=100000"))
        self.assertEqual(tushar.open(cut)[-1]["c.scalar-wave"][:].tobytes(), expected.tobytes(), "after a restart")

    def test_beside_bodies(self):
        text = (ROOT / "ups/fsi/cylinder.ups").read_text()
        region = ('<geom_object><box label="everywhere"><min>[-9,-9,-9]</min><max>[9,9,9]</max></box>'
                  "<scalar>1</scalar></geom_object>")
        decay = DECAYS.format("400", "><value>.5</value>", "100")
        model = ('<Models><Model type="PassiveScalar"><PassiveScalar><scalar name="f">' +
                 FALLS.format("") + decay + f"<initialization>{region}</initialization></scalar></PassiveScalar>"
                 "</Model></Models></Uintah_specification>")
        text = text.replace("</Uintah_specification>", model)
        text = text.replace("</DataArchiver>", '<save label="scalar-f"/><save label="c.density"/></DataArchiver>')
        path = self.folder / "beside.ups"
        path.write_text(text)
        whole = tushar.open(self.run_in("beside", path, "--set", "Time/max_Timesteps=20", "--set",
                                        "DataArchiver/outputTimestepInterval=20", "--set",
                                        "DataArchiver/outputInterval=0"))
        found, density = whole[-1]["c.scalar-f"][:], whole[-1]["c.density"][:]
        self.assertGreater(whole.times[-1], 0)
        np.testing.assert_allclose(found[density > 1e-6], math.exp(-300 * whole.times[-1]), rtol=1e-11)

    def test_mistakes_get_a_sentence(self):
        wrong = {
            DECAYS.format("4", ">", "0"): "missing tag <value> in <c2>: type 'constant' needs it",
            DECAYS.format("4", ' type="variable">', "0"): "missing tag <filename> in <c2>: type 'variable' needs it",
            DECAYS.format("4", ' type="table"><value>1</value>', "0"): "found 'table', expected",
            DECAYS.format("-4", "><value>1</value>", "0"): "found '-4', expected",
            DECAYS.format("4", ' type="variable"><filename>none.csv</filename>', "0"):
                "none.csv' cannot be read: there is no such file",
            self.table(change=lambda lines: [*lines[:3], "1,2,x", *lines[3:]]):
                "c2.csv' has '1,2,x' in line 5, expected x,y,z,c2",
        }
        for decay, sentence in wrong.items():
            ended = sus(self.scene(decay=decay), "-check")
            self.assertEqual(ended.returncode, 3, decay)
            self.assertIn(sentence, ended.stderr, decay)
        fewer = sus(self.scene(decay=self.table(change=lambda lines: lines[:-1])), *SMALL, "--output",
                    self.folder / "fewer")
        self.assertEqual(fewer.returncode, 3)
        self.assertIn("c2.csv' has no line for the cell at (0.96875, 0.96875, 0.5); every cell needs one, x,y,z,c2",
                      fewer.stderr)


if __name__ == "__main__":
    unittest.main()
