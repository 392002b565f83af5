#!/usr/bin/env python3
"""Hard cases for walls of bodies in a gas: python3 tests/support/wall_gallery.py [NAME...] prints a line for each.

Each case changes ups/fsi/plug.ups: a plate between gas of pressure 2 and 1, in a closed box of 2 m. Thicknesses are in
cells of 1/32 m.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

from gas_and_bodies import DENSITY, scene
from solids import columns
from sus import ROOT, SUS

WIDTH = 1 / 32
BODY = "MaterialProperties/MPM/material"
LEFT, RIGHT = (f"MaterialProperties/ICE/material/geom_object[{k}]" for k in (1, 2))
TOTALS = ("GasMass", "GasEnergy", "GasWorkOnBodies", "LeastGasMass", "LeastGasHeat", "MergedCells")
PLANE = ("Grid/Level/Box/resolution=[64,64,1]", f"Grid/Level/Box/upper=[2,2,{WIDTH}]",
         f"{BODY}/geom_object/res=[2,2,1]", f"{LEFT}/box/max=[1,2,1]", f"{RIGHT}/box/max=[2,2,1]")


def line(thickness, start=1.0, sets=()):
    """A plate across a tube."""
    return ("Grid/Level/Box/resolution=[64,1,1]", f"{BODY}/geom_object/box/min=[{start},0,0]",
            f"{BODY}/geom_object/box/max=[{start + thickness * WIDTH},1,1]", *sets)


def hot(pressure):
    """Gas of this pressure on the left."""
    return (f"{LEFT}/temperature={pressure}/1.4",)


def elastic(modulus):
    """An elastic body with this bulk modulus."""
    return (f"{BODY}/is_force_transmitting_material=false", f"{BODY}/constitutive_model/bulk_modulus={modulus}",
            f"{BODY}/constitutive_model/shear_modulus={.4 * modulus}")


def oblique(thickness, sets=()):
    """A plate at 30 degrees to the y axis, from wall to wall."""
    along, across = (1.1547, 2.0), thickness * WIDTH * 1.1547
    corners = ((.4, 0), (.4 + across, 0), (.4 + along[0], along[1]))
    shape = "".join(f"<p{k + 1}>[{x:.9g},{y:.9g},0]</p{k + 1}>" for k, (x, y) in enumerate(corners))
    shape += f"<p4>[{corners[0][0]:.9g},0,1]</p4>"
    return (*PLANE, *sets), f'<parallelepiped label="plate">{shape}</parallelepiped>'


def leaving(velocity, viscosity):
    """A block that leaves a wall, in a gas with viscosity and conduction: the gas enters the vacuum behind it."""
    gas = "MaterialProperties/ICE/material"
    return (*PLANE, f"{BODY}/geom_object/velocity={velocity}", f"{BODY}/geom_object/box/min=[0,0.5,0]",
            f"{BODY}/geom_object/box/max=[0.5,1.5,1]", f"{BODY}/density=1000",
            f"{gas}/dynamic_viscosity={viscosity}", f"{gas}/thermal_conductivity={5 * viscosity}")


DISC = '<cylinder label="disc"><bottom>[1,1,-1]</bottom><top>[1,1,1]</top><radius>0.3</radius></cylinder>'

# Name: overrides, end time in s, the largest share of the gas that may cross the plate, and a shape other than a box.
CASES = {
    "thin, .75": (line(.75), .1, 2e-2),
    "thin, 1": (line(1), .1, 2e-3),
    "thin, 1.25": (line(1.25), .1, 1e-12),
    "thin walls, .32": (line(.32, 1.004, ("CFD/ICE/thin_walls=true", f"{BODY}/density=100")), .3, 2e-2),
    "thin walls, .75": (line(.75, 1.004, ("CFD/ICE/thin_walls=true", f"{BODY}/density=25")), .3, 2e-3),
    "soft, 1.25": (line(1.25, sets=(*hot(100), *elastic(100))), .02, 1e-3),
    "soft, 2.24": (line(2.24, sets=(*hot(1000), *elastic(1000))), .02, 1e-3),
    "stiff, 2.24": (line(2.24, sets=(*hot(1000), *elastic(1e5))), .02, 1e-3),
    "soft, 3.2": (line(3.2, sets=(*hot(1000), *elastic(500))), .02, 1e-3),
    "soft, 5": (line(5, sets=(*hot(100), *elastic(1000))), .05, 1e-3),
    "strong, 1e4": (line(2, sets=(*hot(1e4), f"{BODY}/density=1000")), .01, 1e-12),
    "strong, 1e8": (line(2, sets=(*hot(1e8), f"{BODY}/density=1000")), 1e-4, 1e-12),
    "light": (line(2, sets=(f"{BODY}/density=.05",)), .2, 1e-12),
    "light, cfl .5": (line(2, sets=(f"{BODY}/density=.05", "CFD/cfl=0.5")), .2, 1e-12),
    "heavy": (line(2, sets=(f"{BODY}/density=1e6",)), .2, 1e-12),
    "fast": (line(3, .5, (f"{BODY}/geom_object/velocity=[5,0,0]", f"{BODY}/density=1000")), .15, 1e-12),
    "at a side": (line(3, 0, (f"{BODY}/geom_object/velocity=[2,0,0]", f"{BODY}/density=1000")), .1, 1e-12),
    "oblique": (*oblique(3)[:1], .1, 1e-3, oblique(3)[1]),
    "oblique, soft": (oblique(2.24, (*hot(300), *elastic(300)))[0], .02, 2e-3, oblique(2.24)[1]),
    "oblique, strong": (oblique(3, (*hot(1e4), f"{BODY}/density=1000"))[0], 5e-3, 1e-3, oblique(3)[1]),
    "fast disc": ((*PLANE, f"{BODY}/geom_object/velocity=[5,0,0]", f"{BODY}/density=1000"), .1, None, DISC),
    "soft disc": ((*PLANE, *hot(100), *elastic(300)), .02, None, DISC),
    "soft block, into walls": ((*PLANE, *elastic(1000), f"{BODY}/geom_object/velocity=[2,1.3,0]",
                                f"{BODY}/geom_object/box/min=[1.1,1.1,0]", f"{BODY}/geom_object/box/max=[1.7,1.7,1]",
                                f"{BODY}/density=33", "Grid/Level/Box/resolution=[24,24,1]"), .4, None),
    "viscous, leaves a wall": (leaving("[0.8,0,0]", 1e-3), .4, None),
    "viscous, leaves a wall fast": (leaving("[4,0,0]", 1e-4), .2, None),
    "viscous, leaves a wall sideways": (leaving("[3,0.3,0]", .05), .2, None),
}


def heights(found):
    """The coordinates y of places in a plane, 0 on a line."""
    return found.get("y [m]", [0] * len(found["x [m]"]))


def text_of(sets, shape=()):
    """Returns the text of the scene with which the overrides work."""
    text = scene("plug").read_text()
    saves = "".join(f'<save label="{label}"/>' for label in (*TOTALS[2:], "p.x"))
    text = text.replace("<save ", saves + "<save ", 1)
    if "velocity=[" in " ".join(sets):
        text = text.replace("</geom_object>", "<velocity>[0,0,0]</velocity></geom_object>", 1)
    return re.sub(r'<box label="plug">.*?</box>', shape[0], text, count=1) if shape else text


class Case:
    """A case and what its run shows."""

    def __init__(self, name):
        self.name = name
        sets, end, self.most_leak, *shape = CASES[name]
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "scene.ups")
            path.write_text(text_of(sets, shape))
            report = pathlib.Path(folder, "report.json")
            command = [SUS, path, "--quiet", "--nthreads", "1", "--output", folder, "--json", report]
            for override in (*sets, f"Time/maxTime={end}", f"DataArchiver/outputInterval={end}"):
                command += ["--set", override]
            done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
            self.code, self.err = done.returncode, done.stderr
            self.report = json.loads(report.read_text()) if report.exists() else {}
            archive = next(pathlib.Path(folder).glob("*.uda.*"))
            self.totals = {file.stem: [[float(word) for word in row.split()] for row in file.read_text().splitlines()
                                       if not row.startswith("#")] for file in archive.glob("*.dat")}
            self.leak = self.measure_leak(archive) if self.most_leak is not None and self.code == 0 else None

    @staticmethod
    def measure_leak(archive):
        """Returns the change of the share of gas on the left of the plate, which is where particles are."""
        shares = []
        for time in (1e-30, None):
            gas = columns(archive, "c.density", time=time)
            body = columns(archive, "p.x", time=time)
            middle = {}
            for x, y in zip(body["x [m]"], heights(body)):
                middle.setdefault(round(y / WIDTH - .5), []).append(x)
            rows = sorted(middle)
            def is_left(x, y):
                row = min(rows, key=lambda at: abs(at - round(y / WIDTH - .5)))
                return x < .5 * (min(middle[row]) + max(middle[row]))
            masses = [(is_left(x, y), m) for x, y, m in zip(gas["x [m]"], heights(gas), gas[DENSITY])]
            shares.append(sum(m for left, m in masses if left) / sum(m for _, m in masses))
        return abs(shares[1] - shares[0])

    def drift(self, *names):
        """Returns the greatest change of a sum of totals, relative to the sum at the start."""
        sums = [sum(row[1] for row in rows) for rows in zip(*(self.totals[name] for name in names))]
        return max(abs(one / sums[0] - 1) for one in sums)

    def least(self, name):
        return min(row[1] for row in self.totals[name])


def main(names):
    print("| case | steps (repeated) | mass | energy with work | least density, heat | share that crossed |")
    print("|---|---|---|---|---|---|")
    for name in names or CASES:
        case = Case(name)
        if case.code:
            print(f"| {name} | exit {case.code}: {case.err[:150]!r} |")
            continue
        report = case.report
        print(f"| {name} | {report['steps']} ({report['retries']}) | "
              f"{case.drift('GasMass'):.0e} | {case.drift('GasEnergy', 'GasWorkOnBodies'):.0e} | "
              f"{case.least('LeastGasMass'):.1e}, {case.least('LeastGasHeat'):.1e} | "
              f"{'' if case.leak is None else f'{case.leak:.1e}'} |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
