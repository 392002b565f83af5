#!/usr/bin/env python3
"""Errors of the scenes in ups/fsi against exact values: python3 tests/support/gas_and_bodies.py plug 100 200

Each name below is a scene; the numbers are cells along x, and each gives a line.
"""
import math
import pathlib
import sys
import tempfile

from solids import archive_of, columns
from sus import ROOT

PRESSURE, DENSITY, FREE = "c.pressure [Pa]", "c.density [kg/m^3]", "c.freeVolume [1]"
# Width and height of scenes in a plane, m.
PLANE = {"bubble_and_body": (.1, .05), "rest": (1, 1),
         "burning_grain": (1, 1), "carried_disc": (1, 1), "ring": (1, 1), "cylinder": (1, .2), "wedge": (1, .8)}
# In scenes of more than one dimension, cfl limits the sum of rates over axes.
SUM = "<TimeStepControl><Scheme_for_delT_calc>conservative</Scheme_for_delT_calc></TimeStepControl>"


def scene(name):
    return ROOT / f"ups/fsi/{name}.ups"


def changed(text, *changes):
    """Returns a scene with texts replaced; each text must occur."""
    for before, after in changes:
        assert before in text, before
        text = text.replace(before, after)
    return text


def resolution(name, cells):
    """Returns the overrides for a number of cells along x."""
    width, height = PLANE.get(name, (1, 0))
    across = max(1, round(cells * height / width))
    sets = [f"Grid/Level/Box/resolution=[{cells},{across},1]"]
    if name in PLANE:
        width, height = PLANE[name]
        sets.append(f"Grid/Level/Box/upper=[{width},{height},{width / cells}]")
    return sets


PLUG, DISC = (scene(name).read_text() for name in ("plug", "carried_disc"))
LIGHT = ("<density>1000<", "<density>10<")
VISCOUS = changed(DISC, LIGHT, ("<dynamic_viscosity>0", "<dynamic_viscosity>0.01"),
                  ("<thermal_conductivity>0", "<thermal_conductivity>0.03"),
                  ("<heat>[0]", "<heat>[1]"),
                  ("</constitutive_model>", "</constitutive_model><specific_heat>1</specific_heat>"
                                            "<thermal_conductivity>0</thermal_conductivity>"))
RESTING = "<velocity>[1,0.618,0]</velocity>\n        </geom_object>\n      </material>\n    </MPM>"


class Outcome:
    """The archive and report of a run."""

    def __init__(self, name, cells=None, sets=()):
        self.cells = cells
        with tempfile.TemporaryDirectory() as folder:
            sets = [*(resolution(name, cells) if cells else []), *sets]
            archive = archive_of(scene(name), folder, *sets)
            self.totals = {file.stem: [[float(word) for word in line.split()] for line in file.read_text().splitlines()
                                       if not line.startswith("#")] for file in archive.glob("*.dat")}
            self.fields = columns(archive, "c.pressure", "c.velocity", "c.density", "c.freeVolume")
            self.bodies = columns(archive, "p.velocity", "p.stress") if name == "elastic_wall" else {}

    def last(self, name, component=0):
        return self.totals[name][-1][1 + component]

    def first(self, name, component=0):
        return self.totals[name][0][1 + component]

    def of_gas(self, column):
        """Returns a column of the cells that contain gas."""
        return [value for value, mass, free in zip(self.fields[column], self.fields[DENSITY], self.fields[FREE])
                if mass > 0 and free >= 1e-9]

    def of_bodies(self, name, component=0):
        """Returns a total of the bodies alone, without the gas."""
        gas = {"TotalMass": "GasMass", "TotalMomentum": "GasMomentum", "KineticEnergy": "GasKineticEnergy"}[name]
        return [whole[1 + component] - part[1 + component] for whole, part in zip(self.totals[name], self.totals[gas])]

    def worst(self, column, value):
        """Returns the largest difference from a value in the gas."""
        return max(abs(found - value) for found in self.of_gas(column))

    def energies(self):
        """Returns the energy of the gas plus the bodies' kinetic energy [J] over time."""
        return [gas[1] + body for gas, body in zip(self.totals["GasEnergy"], self.of_bodies("KineticEnergy"))]

    def drift(self, values):
        return max(abs(value / values[0] - 1) for value in values)


def uniform(name, cells, velocity):
    """Returns the largest errors of pressure and velocity where both should be constant, and of the energy."""
    run_of = Outcome(name, cells)
    errors = {"p": run_of.worst(PRESSURE, 1)}
    for axis, value in zip("xy", velocity):
        errors["u" + axis] = run_of.worst(f"c.velocity.{axis} [m/s]", value)
    errors["energy"] = run_of.drift([line[1] for line in run_of.totals["GasEnergy"]])
    return errors


def rest(cells):
    return uniform("rest", cells, (0, 0))


def contact(cells):
    return uniform("contact", cells, (1,))


def contact_of_gases(cells):
    return uniform("contact_of_gases", cells, (1,)) | gas_masses("contact_of_gases", cells, "air", "helium")


def gas_masses(name, cells, *gases):
    """Returns the relative change of each gas's mass."""
    run = Outcome(name, cells)
    return {f"mass of {gas}": run.last(f"TotalMass-{gas}") / run.first(f"TotalMass-{gas}") - 1 for gas in gases}


def carried_disc(cells):
    return uniform("carried_disc", cells, (1, .618))


def moved(name, cells, mass, velocity, way):
    """Returns the errors of a rigid body's velocity and displacement, and the drift of the total energy."""
    run_of = Outcome(name, cells)
    start, end = (line[1] for line in (run_of.totals["CenterOfMassPosition"][k] for k in (0, -1)))
    return {"v": run_of.of_bodies("TotalMomentum")[-1] / mass - velocity, "x": (end - start) / mass - way,
            "energy": run_of.drift(run_of.energies())}


def gun(cells):
    return moved("gun", cells, 1, .78825284, .70748862)


def plug(cells):
    return moved("plug", cells, .5, .28778364, .13371990)


def plug_of_gases(cells):
    return moved("plug_of_gases", cells, .5, 0.24544904, 0.09448638) | \
        gas_masses("plug_of_gases", cells, "stiff", "soft")


def bubble_and_body(cells):
    """The mass of air; what the body got of momentum along x against what the gas gave; and the pressure in the corner
    behind the shock, before the bubble's fan gets there, against jump conditions."""
    run_of = Outcome("bubble_and_body", cells)
    gave, got = run_of.last("GasImpulseOnBodies"), run_of.of_bodies("TotalMomentum")[-1]
    corner = Outcome("bubble_and_body", cells, ("Time/maxTime=1e-5",)).fields[PRESSURE][0]
    air = run_of.last("TotalMass-air") / run_of.first("TotalMass-air") - 1
    return {"mass of air": air, "p behind the shock": corner / 9.01028e8 - 1, "impulse": got / gave - 1}


def sod_plate(cells):
    return moved("sod_plate", cells, .03, .918035, .151810)


def elastic_wall(cells):
    """Returns relative errors of the gas pressure at the wall, and of stress and speed behind the wave in the wall."""
    run_of = Outcome("elastic_wall", cells)
    pressure, speed = 51.361597, .01007232
    places = run_of.fields["x [m]"]
    gas = [p for x, p in zip(places, run_of.fields[PRESSURE]) if .9 < x < 1 - 4 / cells]
    behind = [k for k, x in enumerate(run_of.bodies["x [m]"]) if 1.1 < x < 1.4]
    stress = [-run_of.bodies["p.stress.xx [Pa]"][k] for k in behind]
    speeds = [run_of.bodies["p.velocity.x [m/s]"][k] for k in behind]
    load = pressure - 1
    return {"gas": mean(gas) / pressure - 1, "stress": mean(stress) / load - 1,
            "worst stress": max(abs(s / load - 1) for s in stress), "v": mean(speeds) / speed - 1}


def mean(values):
    return math.fsum(values) / len(values)


def moving_piston(cells):
    """Returns relative errors of the pressure on both faces of a piston that moves at speed 1."""
    run_of = Outcome("moving_piston", cells)
    x, p = run_of.fields["x [m]"], run_of.fields[PRESSURE]
    shock = 1 + 1.4 * (.6 + math.sqrt(.36 + 1))  # of p = 1, c = 1, gamma = 1.4
    pushed = [one for place, one in zip(x, p) if 1.75 < place < 1.95]
    drawn = [one for place, one in zip(x, p) if 1.3 < place < 1.45]
    return {"ahead": mean(pushed) / shock - 1, "behind": mean(drawn) / .8 ** 7 - 1}


def slow_piston(cells):
    """Returns the largest relative pressure errors on both sides of the piston, away from it, and the number of
    steps."""
    run_of = Outcome("slow_piston", cells)
    cut = list(zip(run_of.fields["x [m]"], run_of.fields[PRESSURE]))
    exact = {"ahead": .6 ** -1.4, "behind": 1.4 ** -1.4}
    found = {"ahead": [p for x, p in cut if x > 1.65], "behind": [p for x, p in cut if x < 1.35]}
    errors = {side: max(abs(p / exact[side] - 1) for p in found[side]) for side in exact}
    return {**errors, "steps": len(run_of.totals["GasMass"]) - 1}


def burning_slab(cells):
    """Returns the relative error of the burnt depth of a slab at constant pressure."""
    run_of = Outcome("burning_slab", cells)
    return {"way": run_of.last("BurntMass") / (20 * .1) - 1}


def burnt_in_vessel(time, steps=2000):
    """Returns the burnt mass in burning_vessel [kg], computed by the fourth-order Runge-Kutta method."""
    def pressure(mass):
        return .4 * (1.25 + 3.45 * mass) / (.5 + mass / 20)

    mass, dt = 0, time / steps
    for _ in range(steps):
        a = .02 * pressure(mass) ** .778
        b = .02 * pressure(mass + .5 * dt * a) ** .778
        c = .02 * pressure(mass + .5 * dt * b) ** .778
        d = .02 * pressure(mass + dt * c) ** .778
        mass += dt / 6 * (a + 2 * b + 2 * c + d)
    return mass, pressure(mass)


def burning_vessel(cells):
    """Returns relative errors of the burnt mass and of the mean pressure in a closed vessel, and the relative changes
    of mass and energy."""
    run_of = Outcome("burning_vessel", cells)
    mass, pressure = burnt_in_vessel(20)
    gas = [(p, free) for p, free in zip(run_of.fields[PRESSURE], run_of.fields[FREE]) if free >= 1e-9]
    mean_pressure = math.fsum(p * free for p, free in gas) / math.fsum(free for _, free in gas)
    return {"burnt": run_of.last("BurntMass") / mass - 1, "p": mean_pressure / pressure - 1,
            "mass": run_of.drift([line[1] for line in run_of.totals["TotalMass"]]),
            "energy": run_of.drift(energies_of_burning(run_of))}


def energies_of_burning(run_of):
    """Returns the energy of gas and bodies minus the heat of reaction [J] over time."""
    names = [name for name in ("GasEnergy", "ThermalEnergy", "StrainEnergy") if name in run_of.totals]
    sums = [math.fsum(run_of.totals[name][k][1] for name in names) - heat[1]
            for k, heat in enumerate(run_of.totals["ReactionHeat"])]
    bodies = run_of.of_bodies("KineticEnergy") if "KineticEnergy" in run_of.totals else [0] * len(sums)
    return [one + body for one, body in zip(sums, bodies)]


def burning_grain(cells, sets=()):
    """Returns the relative changes of the totals of a burning grain and the gases around it, and the burnt fraction."""
    run_of = Outcome("burning_grain", cells, sets)
    return {"mass": run_of.drift([line[1] for line in run_of.totals["TotalMass"]]),
            "mass of air": run_of.drift([line[1] for line in run_of.totals["TotalMass-air"]]),
            "energy": run_of.drift(energies_of_burning(run_of)),
            "burnt": run_of.last("BurntMass") / run_of.of_bodies("TotalMass")[0]}


def oblique_shock(mach, angle, gamma=1.4):
    """Returns angle and pressure ratio of the weak shock that turns a flow, angles in rad. Source: theta-beta-M
    relation."""
    def turned(beta):
        across = mach * mach * math.sin(beta) ** 2 - 1
        return math.atan(2 / math.tan(beta) * across / (mach * mach * (gamma + math.cos(2 * beta)) + 2))
    low, high = math.asin(1 / mach), math.radians(60)
    for _ in range(100):
        middle = .5 * (low + high)
        low, high = (low, middle) if turned(middle) > angle else (middle, high)
    return low, 1 + 2 * gamma / (gamma + 1) * ((mach * math.sin(low)) ** 2 - 1)


def wedge(cells):
    """Returns the relative error of the mean pressure from 4 cells above the surface up to .6 of the shock layer."""
    run_of = Outcome("wedge", cells)
    angle = math.radians(15)
    beta, ratio = oblique_shock(2, angle)
    inside = []
    for x, y, p in zip(run_of.fields["x [m]"], run_of.fields["y [m]"], run_of.fields[PRESSURE]):
        surface, shock = (x - .2) * math.tan(angle), (x - .2) * math.tan(beta)
        if .5 < x < .9 and surface + 4 / cells < y < surface + .6 * (shock - surface):
            inside.append(p)
    return {"p": mean(inside) / ratio - 1}


def cylinder(cells):
    """Returns the final position of the cylinder's centre."""
    run_of = Outcome("cylinder", cells)
    mass = run_of.of_bodies("TotalMass")[0]
    return {axis: run_of.last("CenterOfMassPosition", k) / mass for k, axis in enumerate("xy")}


def closed_box(cells):
    """Returns the relative changes of the gas mass and of the total energy, including strain energy."""
    run_of = Outcome("closed_box", cells)
    energies = [one + strain[1] for one, strain in zip(run_of.energies(), run_of.totals["StrainEnergy"])]
    return {"mass": run_of.drift([line[1] for line in run_of.totals["GasMass"]]),
            "energy": energies[-1] / energies[0] - 1}


def ring(cells):
    """Returns the relative errors of the mean radial displacement of a ring and of its mean hoop stress, against Lamé's
    solution in plane strain with the pressures of the gas on both sides."""
    inner, outer, shear, poisson = .26, .34, 1000, 2 / 7
    with tempfile.TemporaryDirectory() as folder:
        archive = archive_of(scene("ring"), folder, *resolution("ring", cells))
        gas = columns(archive, "c.pressure")
        body = columns(archive, "p.displacement", "p.stress")

    def load(is_there):
        return mean([p for x, y, p in zip(gas["x [m]"], gas["y [m]"], gas[PRESSURE])
                     if is_there(math.hypot(x, y))]) - 1

    inside, outside = load(lambda r: r < .2), load(lambda r: .45 < r < .9)
    spread = outer ** 2 - inner ** 2
    constant = (inside * inner ** 2 - outside * outer ** 2) / spread
    falling = (inside - outside) * (inner * outer) ** 2 / spread
    moved, exact, hoop, exact_hoop = [], [], [], []
    names = [f"p.displacement.{axis} [m]" for axis in "xy"] + [f"p.stress.{axes} [Pa]" for axes in ("xx", "xy", "yy")]
    for x, y, dx, dy, xx, xy, yy in zip(body["x [m]"], body["y [m]"], *(body[name] for name in names)):
        r = math.hypot(x - dx, y - dy)
        c, s = (x - dx) / r, (y - dy) / r
        moved.append(dx * c + dy * s)
        exact.append(((1 - 2 * poisson) * constant * r + falling / r) / (2 * shear))
        hoop.append(xx * s * s - 2 * xy * s * c + yy * c * c)
        exact_hoop.append(constant + falling / r ** 2)
    return {"u": mean(moved) / mean(exact) - 1, "hoop": mean(hoop) / mean(exact_hoop) - 1,
            "worst hoop": max(abs(one - other) for one, other in zip(hoop, exact_hoop)) / mean(exact_hoop)}


def couette(cells):
    """Returns relative errors of the velocity, in full cells away from the plate, and of the force."""
    with tempfile.TemporaryDirectory() as folder:
        archive = archive_of(scene("couette"), folder, f"Grid/Level/Box/resolution=[4,{cells},1]",
                             f"Grid/Level/Box/upper=[{4 / cells},1,1]")
        found = columns(archive, "c.velocity")
        force = [float(word) for word in (archive / "GasForceOnBodies.dat").read_text().splitlines()[-1].split()][1]
    height, speed = .78, .1
    away = [(y / height, u / speed) for y, u in zip(found["y [m]"], found["c.velocity.x [m/s]"]) if y < .65]
    return {"u": max(abs(u - exact) for exact, u in away), "force": force / (-.1 * speed / height * 4 / cells) - 1}


def warm_body(cells, face=.78):
    """Returns the relative error of the heat that a body releases in a second, by the position of its face."""
    text = scene("warm_body").read_text().replace("[0.78,0,0]", f"[{face},0,0]")
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "warm_body.ups")
        path.write_text(text)
        archive = archive_of(path, folder, f"Grid/Level/Box/resolution=[{cells},1,1]")
        heat = [[float(word) for word in line.split()]
                for line in (archive / "GasHeatToBodies.dat").read_text().splitlines()[1:]]
    before = [line for line in heat if line[0] <= heat[-1][0] - 1][-1]
    rate = (heat[-1][1] - before[1]) / (heat[-1][0] - before[0])
    return {"heat": rate / (-.25 / face) - 1}


def tip_of_panel(archive, time):
    """Returns the downstream displacement [m] of the panel's tip: the mean of the upper half millimetre."""
    found = columns(archive, "p.displacement", time=time)
    moved = zip(found["p.displacement.x [m]"], found["p.displacement.y [m]"], found["y [m]"])
    return mean([dx for dx, dy, y in moved if y - dy > .0495])


def panel_until(cells, time, folder):
    height = .3 / cells
    return archive_of(scene("panel"), folder, f"Grid/Level/Box/resolution=[{cells},{round(.065 / height)},1]",
                      f"Grid/Level/Box/upper=[0.25,0.065,{height}]", f"Time/maxTime={time}")


def panel(cells):
    """Returns the downstream displacement [m] of the tip after 1.3 ms."""
    with tempfile.TemporaryDirectory() as folder:
        return {"tip": tip_of_panel(panel_until(cells, 1.3e-3, folder), 1.3e-3)}


def panel_period(cells):
    """Returns the first and the second peak of the tip [m], and the relative difference between the time from peak to
    peak and 2.72 ms, the first period of a clamped beam in plane strain."""
    with tempfile.TemporaryDirectory() as folder:
        archive = panel_until(cells, 4.3e-3, folder)
        return peaks_of_panel(archive, 5e-5)


def peaks_of_panel(archive, interval):
    """As panel_period, for an archive that has the tip's position at the given interval [s]."""
    times = {"first": (1e-3, 1.7e-3), "second": (3.5e-3, 4.3e-3)}
    peaks = {}
    for name, (start, end) in times.items():
        count = round((end - start) / interval)
        peaks[name] = max((tip_of_panel(archive, start + k * interval), start + k * interval) for k in range(count + 1))
    return {name: peak[0] for name, peak in peaks.items()} | \
        {"period": (peaks["second"][1] - peaks["first"][1]) / 2.72e-3 - 1}


if __name__ == "__main__":
    for count in sys.argv[2:]:
        found = globals()[sys.argv[1]](int(count))
        print(f"{sys.argv[1]} {count}:", ", ".join(f"{name} {value:.4g}" for name, value in found.items()))
