#!/usr/bin/env python3
"""Tracers move with a gas: exactly in a uniform flow, alone, in several gases and beside a moving body; they turn with
a vortex, stay between walls, leave through open sides, decay, show values of cells and are made during a run, on any
layout and after a restart alike; mistakes in their tags."""
import json
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import gas_and_bodies as fsi
from module_runs import ModuleTest, np, sus, tushar
from solids import RefusedSceneTest
from sus import ROOT

SCALARS, TRACERS, GASES = (ROOT / f"ups/ice/{name}.ups" for name in ("scalars", "tracers", "three_gases"))
SMALL = ["--set", "Grid/Level/Box/resolution=[16,16,1]", "--set", "Time/maxTime=0.4"]
SAVES = ("p.x", "p.velocity", "p.displacement", "p.particleID", "Tracers")
OPEN = ("<periodic>[1,1,0]</periodic>", "")


def box(start, end, label="part"):
    return f'<geom_object><box label="{label}"><min>{start}</min><max>{end}</max></box>'


WHOLE = box("[-1,-1,-1]", "[2,2,2]", "everything")


def model(tags="", initial=3, sources="", start=WHOLE, material="gas"):
    sources = sources and f"<interiorSources>{sources}</interiorSources>"
    return (f'<Model type="TracerParticles"><TracerParticles><material>{material}</material>{tags}<tracer name="t">'
            f"<initialization>{start}<particlesPerCell>{initial}</particlesPerCell></geom_object></initialization>"
            f"{sources}</tracer></TracerParticles></Model>")


def source(rate, start="[0.25,0.25,0]", end="[0.5,0.5,1]"):
    return f"{box(start, end)}<particlesPerCellPerSecond>{rate}</particlesPerCellPerSecond></geom_object>"


def with_tracers(text, tracers, *labels):
    """The scene with a model and what it saves; analysis modules are left out."""
    if "<DataAnalysis>" in text:
        text = text[:text.index("<DataAnalysis>")] + "</Uintah_specification>"
    saves = "".join(f'<save label="{label}"/>' for label in (*SAVES, *labels))
    text = text.replace("</DataArchiver>", saves + '<checkpoint timestepInterval="4" cycle="100"/></DataArchiver>')
    if "</Models>" in text:
        return text.replace("</Models>", tracers + "</Models>")
    return text.replace("</Uintah_specification>", f"<Models>{tracers}</Models></Uintah_specification>")


def scalar(name="q", coefficient="><value>1</value>", c1=2, c3=.5):
    return (f'<scalar name="{name}"><initialValue>3</initialValue><exponentialDecay><c1>{c1}</c1><c2{coefficient}</c2>'
            f"<c3>{c3}</c3></exponentialDecay></scalar>")


def clone(name):
    return f'<cloneVariables><CCVarLabel label="{name}"/></cloneVariables>'


def gas_of(text):
    """The name of the first gas."""
    start = text.index("<material", text.index("<ICE>", text.index("<MaterialProperties>")))
    return text[start:].split('"')[1]


class Tracers(ModuleTest):
    def scene(self, tracers, *labels, of=SCALARS, changes=()):
        path = self.folder / "tracers.ups"
        path.write_text(with_tracers(fsi.changed(of.read_text(), *changes), tracers, *labels))
        return path

    def snapshots(self, scene, *options, name="run", ranks=1):
        return tushar.open(self.run_in(name, scene, *options, ranks=ranks))

    def assert_moved(self, whole, velocity, material="gas", size=1, tolerance=3e-15):
        """Asserts that each tracer has moved by v t, around the grid."""
        first, last, t = whole[0], whole[-1], whole.times[-1]

        def sorted_by_id(step, label):
            ids = step["p.particleID", material][:]
            return step[label, material][:][np.argsort(ids)]
        self.assertGreater(len(first["p.x", material][:]), 20)
        way = sorted_by_id(last, "p.displacement")
        np.testing.assert_allclose(way, np.broadcast_to(np.multiply(velocity, t), way.shape), atol=tolerance)
        np.testing.assert_allclose(sorted_by_id(last, "p.velocity"), np.broadcast_to(velocity, way.shape),
                                   atol=10 * tolerance)
        off = (sorted_by_id(first, "p.x") + np.multiply(velocity, t) - sorted_by_id(last, "p.x")) / size
        np.testing.assert_allclose(off[:, :2] - np.round(off[:, :2]), 0, atol=tolerance)
        self.assertEqual(len(np.unique(last["p.particleID", material][:])), len(way))

    def test_move_with_a_uniform_flow(self):
        for cells, velocity in (("[16,16,1]", (1, 1, 0)), ("[40,1,1]", (1, 0, 0)), ("[6,6,6]", (1, .5, .25))):
            periodic = ("[1,1,0]</periodic>", f"[1,1,{1 if cells[-2] == '6' else 0}]</periodic>")
            changes = [periodic, ("[1,1,0]</velocity>", f"[{','.join(map(str, velocity))}]</velocity>")]
            if cells[-2] == "6":
                changes += [(f'<Face side="z{side}"><BCType id="all" label="Symmetric" var="symmetry"/></Face>', "")
                            for side in "-+"]
            whole = self.snapshots(self.scene(model(), changes=changes), *SMALL, "--set",
                                   f"Grid/Level/Box/resolution={cells}", name=cells)
            self.assert_moved(whole, velocity, tolerance=1e-13)
            self.assertEqual(len(whole[-1]["p.x"][:]), 3 * math.prod(map(int, cells.strip("[]").split(","))))

    def test_move_with_several_gases(self):
        text = GASES.read_text()
        names = [part.split('"')[1] for part in text[text.index("<ICE>", text.index("<MaterialProp")):].split(
            "<material name=")[1:]]
        whole = self.snapshots(self.scene(model(material=names[1]), of=GASES), *SMALL)
        velocity = whole[0]["p.velocity", names[1]][:][0]
        self.assert_moved(whole, velocity, names[1], tolerance=1e-12)

    def beside_bodies(self, text):
        """The scene with the name of its gas for GAS, and this name."""
        gas = gas_of(text)
        path = self.folder / "bodies.ups"
        path.write_text(text.replace("GAS", gas))
        return path, gas

    def test_do_not_pass_one_another_in_one_dimension(self):
        # A plug that the gas on one side pushes, and what it pushes aside; tracers are in both.
        path, gas = self.beside_bodies(with_tracers(fsi.PLUG, model(material="GAS")))
        whole = self.snapshots(path)
        first, last = ([step[label, gas][:] for label in ("p.x", "p.particleID")] for step in (whole[0], whole[-1]))
        self.assertGreater(np.ptp(whole[-1]["p.displacement", gas][:][:, 0]), .1)
        order = [ids[np.argsort(x[:, 0])] for x, ids in (first, last)]
        np.testing.assert_array_equal(*order)

    def test_move_with_a_body_and_the_gas_around_it(self):
        path, gas = self.beside_bodies(with_tracers(fsi.DISC, model(material="GAS")))
        small = ["--set", "Grid/Level/Box/resolution=[25,25,1]", "--set", "Grid/Level/Box/upper=[1,1,0.04]"]
        whole = self.snapshots(path, *small, "--set", "Time/maxTime=0.2")
        self.assert_moved(whole, (1, .618, 0), gas, tolerance=1e-12)

    def test_turn_with_a_vortex(self):
        errors = []
        for cells in 20, 40:
            last = self.snapshots(TRACERS, "--set", f"Grid/Level/Box/resolution=[{cells},{cells},1]",
                                  name=str(cells))[-1]
            x, way = last["p.x"][:][:, :2] - .5, last["p.displacement"][:][:, :2]
            c, s = math.cos(2), math.sin(2)  # 5 rad/s for .4 s
            errors.append(np.abs((x - way) @ np.array([[c, s], [-s, c]]) - x).mean())
            self.assertAlmostEqual(last["p.age"][:].min(), math.exp(-.8), delta=1e-15)
        self.assertLess(errors[1], 1e-4)
        self.assertGreater(errors[0] / errors[1], 4)

    def test_leave_through_open_sides_and_are_made(self):
        done = self.folder / "report.json"
        scene = self.scene(model(sources=source(50)), changes=[OPEN])
        whole = self.snapshots(scene, *SMALL, "--json", done)
        report = json.loads(done.read_text())
        made = 4 * 4 * math.floor(50 * .4)
        self.assertEqual(len(whole[0]["p.x"][:]), 3 * 256)
        self.assertEqual(report["particles"] + report["particles_dropped"], 3 * 256 + made)
        self.assertGreater(report["particles_dropped"], 3 * 256 * .5)
        self.assertEqual(report["of_run"]["tracers"], report["particles"])
        last = whole[-1]
        x, way = last["p.x"][:], last["p.displacement"][:]
        source_of = (x - way)[last["p.particleID"][:] >= 1 << 63]
        self.assertGreater(len(source_of), made / 2)
        self.assertTrue(((source_of[:, :2] > .25) & (source_of[:, :2] < .5)).all())
        np.testing.assert_allclose(last["p.velocity"][:][:, :2], 1, atol=1e-12)

    def test_are_made_between_two_times(self):
        times = "<timeStart>0.1</timeStart><timeStop>0.3</timeStop>"
        whole = self.snapshots(self.scene(model(times, sources=source(100))), *SMALL)
        self.assertEqual([len(step["p.x"][:]) for step in whole], [0, 16 * 20])

    def test_of_several_sources_begin_at_different_places(self):
        rest = ("[1,1,0]</velocity>", "[0,0,0]</velocity>")
        x = self.snapshots(self.scene(model(initial=2, sources=source(50) + source(50)), changes=[rest]),
                           *SMALL)[-1]["p.x"][:]
        self.assertEqual(len(x), 2 * 256 + 2 * 16 * 20)
        self.assertEqual(len(np.unique(x, axis=0)), len(x))

    def test_stay_between_walls(self):
        walls = "".join(f'<Face side="{side}"><BCType id="all" label="Symmetric" var="symmetry"/></Face>'
                        for side in ("x-", "x+", "y-", "y+"))
        velocity = ("[1,1,0]</velocity>", "[sin(pi*x)*cos(pi*y), 0.5-y+x, 0]</velocity>")
        scene = self.scene(model(), changes=[OPEN, ("<BoundaryConditions>", "<BoundaryConditions>" + walls), velocity])
        x = self.snapshots(scene, *SMALL, "--set", "Time/maxTime=3")[-1]["p.x"][:]
        self.assertEqual(len(x), 3 * 256)
        self.assertTrue(((x[:, :2] >= 0) & (x[:, :2] <= 1)).all())

    def test_decay_and_show_values_of_cells(self):
        cells = 16
        lines = [f"{(i + .5) / cells},{(j + .5) / cells},0.5,{1 + i + 3 * j}" for j in range(cells)
                 for i in range(cells)]
        (self.folder / "c2.csv").write_text("\n".join(lines))
        tags = clone("scalar-wave") + scalar("q", ' type="variable"><filename>c2.csv</filename>', .1)
        scene = self.scene(model(tags), "p.clone-scalar-wave", "q", "q_totalDecay", "q_expDecayCoef")
        whole = self.snapshots(scene, *SMALL)
        for step, t in zip(whole, whole.times):
            i, j = (np.floor(step["p.x"][:][:, d] * cells).astype(int) for d in (0, 1))
            wave = np.asarray(step["c.scalar-wave"][:]).squeeze()
            shown = step["p.clone-scalar-wave"][:]
            self.assertTrue((shown == wave[j, i]).all() or (shown == wave[i, j]).all())
            np.testing.assert_array_equal(step["p.q_expDecayCoef"][:], 1 + i + 3 * j)
            np.testing.assert_allclose(step["p.q"][:], 3 * np.exp(-.1 * step["p.q_totalDecay"][:] - .5 * t), rtol=1e-13)
        self.assertGreater(np.ptp(step["p.q_totalDecay"][:]), 1)

    def assert_same_on_any_layout(self, scene, *options, material, patches):
        def state(archive):
            last = tushar.open(archive)[-1]
            return [last[label, material][:].tobytes() for label in ("p.particleID", "p.x", "p.velocity", "p.dose")]
        expected = state(self.run_in("one", scene, *options, "-nthreads", "1"))
        ids = np.frombuffer(expected[0], dtype=np.uint64)
        self.assertGreater((ids < 1 << 63).sum(), 100)
        self.assertGreater((ids >= 1 << 63).sum(), 0)
        for number, (ranks, threads, layout) in enumerate(((1, 2, patches[0]), (3, 1, patches[1]))):
            archive = self.run_in(str(number), scene, *options, "-nthreads", str(threads), "--set",
                                  f"Grid/Level/Box/patches={layout}", ranks=ranks)
            self.assertEqual(state(archive), expected, layout)
        cut = self.run_in("cut", scene, *options, "--set", "Time/max_Timesteps=7")
        self.well(sus("-restart", cut, "-t", "4", "--set", "Time/max_Timesteps=12"))
        self.assertEqual(state(cut), expected, "after a restart")

    def test_are_the_same_on_any_layout(self):
        velocity = ("[1,1,0]</velocity>", "[1+0.5*sin(2*pi*y),1-0.5*cos(2*pi*x),0]</velocity>")
        scene = self.scene(model(scalar("dose"), sources=source(70)), "dose", changes=[velocity])
        self.assert_same_on_any_layout(scene, *SMALL, "--set", "Time/max_Timesteps=12", material="gas",
                                       patches=("[3,2,1]", "[2,4,1]"))

    def test_are_the_same_beside_a_body_on_any_layout(self):
        text = with_tracers(fsi.scene("cylinder").read_text(), model(scalar("dose"), material="GAS", sources=source(
            1e4, "[0.2,0.05,0]", "[0.4,0.15,1]")), "dose")
        path, gas = self.beside_bodies(text)
        small = [word for one in fsi.resolution("cylinder", 40) for word in ("--set", one)]
        self.assert_same_on_any_layout(path, *small, "--set", "Time/max_Timesteps=12", material=gas,
                                       patches=("[3,2,1]", "[4,1,1]"))


class Mistakes(RefusedSceneTest):
    def test_are_refused(self):
        cases = (
            (model(material="air"), "material: found 'air', expected 'gas'"),
            (model(clone("scalar-z")), "found 'scalar-z', expected 'scalar-box', 'c.scalar-box'"),
            (model(clone("press_CC").replace("/></", "/><CCVarLabel label='press_CC'/></")),
             "'press_CC' is given twice"),
            (model() + model(), 'a second <Model type="TracerParticles"> is not available'),
            (model("<newVariables/>"), "write <cloneVariables>, Uintah's present name"),
            (model(scalar() + scalar("p.q")), "the name 'p.q' is given twice"),
            (model(scalar() + scalar("q_totalDecay")), "the name 'q_totalDecay' is given twice, or belongs to another"),
            (model(clone("press_CC") + scalar("clone-press_CC")), "the name 'clone-press_CC' is given twice"),
            (model(scalar("a/b")), "found the name 'a/b', expected letters, digits"),
            (model("<timeStart>.3</timeStart><timeStop>.1</timeStop>"), "timeStop, 0.1 s, is before timeStart, 0.3 s"),
            (model(initial=-1), "particlesPerCell"),
            (model(initial=70000), "a cell can contain at most 65536 tracer particles at the start"),
            (model(scalar("q", ' type="variable"><filename>none.csv</filename>')), "there is no such file"))
        for tracers, sentence in cases:
            self.assert_refused(with_tracers(SCALARS.read_text(), tracers), sentence)

    def test_names_of_bodies_are_refused(self):
        for name in ("q", "stress", "boxEdges"):
            text = with_tracers(fsi.DISC, model(scalar(name), material=gas_of(fsi.DISC)))
            self.assert_refused(text, f"the name '{name}' is given twice: bodies have a variable p.{name}")

    def test_levels_are_refused(self):
        amr = ('<AMR><Regridder type="Tiled"><adaptive>true</adaptive><max_levels>2</max_levels><min_patch_size>'
               "[[8,8,1]]</min_patch_size></Regridder></AMR>")
        text = with_tracers(SCALARS.read_text(), model()).replace("<CFD>", amr + "<CFD>")
        self.assert_refused(text, "the tracers of a <Model type=\"TracerParticles\"> move on one level")


if __name__ == "__main__":
    unittest.main()
