"""Archives for tests in the format of core/output: Sod's shock tube, and heat in 1-D and 2-D."""
import os

import h5py
import numpy as np

INDEX = """<?xml version="1.0"?>
<tushar_archive{format} version="0.1.0">
 <variables>
{variables} </variables>
 <globals>
{globals} </globals>
 <timesteps>
{outputs} </timesteps>
</tushar_archive>
"""


def sod(x, time):
    """Density, velocity, pressure and internal energy of Sod's problem, diaphragm at 0.5; states rounded to 5 digits
    from Toro (2009), table 4.3."""
    gamma, p, u = 1.4, 0.30313, 0.92745
    left, right = 0.42632, 0.26557
    c = np.sqrt(gamma)
    tail = u - np.sqrt(gamma * p / left)
    speed = 1.75216
    xi = (np.asarray(x) - 0.5) / max(time, 1e-12)
    fan_u = 2 / (gamma + 1) * (c + xi)
    fan_c = np.maximum(c - (gamma - 1) / 2 * fan_u, 0)
    fan_rho = (fan_c / c) ** (2 / (gamma - 1))
    where = [xi < -c, xi < tail, xi < u, xi < speed]
    density = np.select(where, [1, fan_rho, left, right], 0.125)
    velocity = np.select(where, [0, fan_u, u, u], 0)
    pressure = np.select(where, [1, fan_rho ** gamma, p, p], 0.1)
    return density, velocity, pressure, pressure / ((gamma - 1) * density)


def write_index(folder, variables, globals_, outputs, title, form=None):
    """variables: (name, centring, components, unit, materials); globals_: (name, unit); outputs: (step, time)."""
    lines = "".join(f'  <variable name="{name}" centring="{centring}" type="double" components="{components}" '
                    f'unit="{unit}" description="the {name}"' + (f' materials="{materials}"' if materials else "") +
                    " />\n"
                    for name, centring, components, unit, materials in variables)
    more = "".join(f'  <global name="{name}" href="{name}.dat" components="1" unit="{unit}" description="the {name}" '
                   f'/>\n'
                   for name, unit in globals_)
    times = "".join(f'  <timestep href="t{step:05}.h5" time="{time}" delT="0.001">{step}</timestep>\n'
                    for step, time in outputs)
    with open(os.path.join(folder, "index.xml"), "w", encoding="utf-8") as file:
        file.write(INDEX.format(variables=lines, globals=more, outputs=times,
                                format="" if form is None else f' format="{form}"'))
    with open(os.path.join(folder, "input.xml"), "w", encoding="utf-8") as file:
        file.write(f"<Uintah_specification><Meta><title>{title}</title></Meta></Uintah_specification>")


def open_output(folder, step, time, cells, spacing, dimension):
    file = h5py.File(os.path.join(folder, f"t{step:05}.h5"), "w")
    file.attrs.update(step=step, time=time, delT=0.001, version="0.1.0")
    file.create_group("grid").attrs.update(lower=np.zeros(3), spacing=np.array(spacing, float), cells=np.array(cells),
                                           dimension=dimension)
    return file


def make_folder(where, name):
    folder = os.path.join(where, name + ".uda.000")
    os.makedirs(folder)
    os.symlink(os.path.basename(folder), os.path.join(where, name + ".uda"))
    return folder


def make_sod(where, name="sod", count=400, noise=0.0, leave_out=()):
    """Creates a tube of 100 cells with `count` particles; returns the path of the link."""
    folder = make_folder(where, name)
    outputs = [(0, 0.0), (100, 0.1), (200, 0.2)]
    units = {"p.density": "kg/m^3", "p.velocity": "m/s", "p.pressure": "Pa", "p.internalEnergy": "J/kg"}
    variables = [("p.x", "particle", 3, "m", "gas")] + [
        (label, "particle", 3 if label == "p.velocity" else 1, unit, "gas")
        for label, unit in units.items() if label not in leave_out]
    write_index(folder, variables, [("KineticEnergy", "J")], outputs, "Sod's shock tube")
    random = np.random.default_rng(1)
    for step, time in outputs:
        with open_output(folder, step, time, (100, 1, 1), (0.01, 1, 1), 1) as file:
            x = (np.arange(count) + 0.5) / count
            group = file.create_group("particles/gas")
            group.attrs["index"] = 0
            group["p.x"] = np.column_stack([x, np.full(count, 0.5), np.full(count, 0.5)])
            for label, values in zip(units, sod(x, time)):
                values = values * (1 + noise * random.standard_normal(count))
                if label in leave_out:
                    continue
                wide = np.column_stack([values, 0 * values, 0 * values])
                group[label] = wide if label == "p.velocity" else values
            line = np.linspace(0, 1, 1001)
            for column, values in zip(("x", "density", "velocity", "pressure", "energy"), (line, *sod(line, time))):
                file[f"reference/{column}"] = values
    with open(os.path.join(folder, "KineticEnergy.dat"), "w", encoding="utf-8") as file:
        file.write("# time [s] KineticEnergy [J]\n0 0\n0.1 0.05\n0.2 0.1\n0.3 0.")  # the last line is not complete
    return os.path.join(where, name + ".uda")


def make_heat(where, cells=(50, 1, 1), dimension=1, name="heat"):
    """Creates a cell field, warm in the middle, and a node field; returns the path of the link."""
    folder = make_folder(where, name)
    write_index(folder, [("c.temperature", "cell", 1, "K", ""), ("g.mass", "node", 1, "kg", "")], [],
                [(0, 0.0), (10, 1.0)],
                "Heat")
    for step, time in ((0, 0.0), (10, 1.0)):
        with open_output(folder, step, time, cells, [1 / n for n in cells], dimension) as file:
            z, y, x = np.meshgrid(*[(np.arange(n) + 0.5) / n for n in reversed(cells)], indexing="ij")
            file["cells/c.temperature"] = 300 + 50 * np.exp(-20 * ((x - 0.5) ** 2 + 2 * (y - 0.5) ** 2)) / (1 + time)
            nodes = [n + 1 if axis < dimension else n for axis, n in enumerate(cells)]
            file["nodes/g.mass"] = np.ones(nodes[::-1])
    return os.path.join(where, name + ".uda")


def make_disks(where, name="disks"):
    """Creates two 2-D particle materials and one without particles; returns the path of the link."""
    folder = make_folder(where, name)
    write_index(folder, [("p.x", "particle", 3, "m", "left, right, none"),
                         ("p.density", "particle", 1, "kg/m^3", "left, right, none"),
                         ("p.velocity", "particle", 3, "m/s", "left, right")], [], [(3, 0.5)], "Two disks")
    with open_output(folder, 3, 0.5, (40, 40, 1), (0.025, 0.025, 1), 2) as file:
        side = np.linspace(-0.2, 0.2, 60)
        x, y = (axis.ravel() for axis in np.meshgrid(side, side))
        x, y = x[x ** 2 + y ** 2 < 0.04], y[x ** 2 + y ** 2 < 0.04]
        for index, (material, centre) in enumerate((("left", 0.3), ("right", 0.7))):
            group = file.create_group(f"particles/{material}")
            group.attrs["index"] = index
            group["p.x"] = np.column_stack([x + centre, y + centre, np.full(len(x), 0.5)])
            group["p.density"] = 1000 + 100 * (x ** 2 + y ** 2) / 0.04 + index
            group["p.velocity"] = np.column_stack([y, -x, 0 * x])
        group = file.create_group("particles/none")
        group.attrs["index"] = 2
        group["p.x"] = np.zeros((0, 3))
        group["p.density"] = np.zeros(0)
    return os.path.join(where, name + ".uda")


def make_moving(where, name="moving"):
    """Creates particles with ids, of two materials; 20 leaves after the first output, 40 appears with the second."""
    folder = make_folder(where, name)
    write_index(folder, [("p.x", "particle", 3, "m", "a, b"), ("p.particleID", "particle", 1, "1", "a, b"),
                         ("p.mass", "particle", 1, "kg", "a")], [], [(0, 0.0), (1, 1.0)], "Moving")
    for step, held in ((0, {"a": [10, 20], "b": [30]}), (1, {"a": [10], "b": [30, 40]})):
        with open_output(folder, step, float(step), (50, 1, 1), (1, 1, 1), 1) as file:
            for index, (material, ids) in enumerate(held.items()):
                group = file.create_group(f"particles/{material}")
                group.attrs["index"] = index
                group["p.particleID"] = np.array(ids, "u8")
                group["p.x"] = np.array([[number + step, 0, 0] for number in ids], float)
                if material == "a":
                    group["p.mass"] = np.array(ids, float)
    return os.path.join(where, name + ".uda")


BOXES = {1: [(0, 0, 0, 0, 2, 1, 1), (1, 4, 0, 0, 6, 1, 1), (2, 12, 0, 0, 16, 1, 1)],
         2: [(0, 0, 0, 0, 2, 2, 1), (1, 4, 0, 0, 6, 4, 1), (1, 6, 0, 0, 8, 2, 1), (2, 12, 4, 0, 16, 8, 1)],
         3: [(0, 0, 0, 0, 2, 2, 2), (1, 4, 0, 0, 8, 4, 2), (1, 4, 0, 2, 6, 4, 4), (1, 6, 0, 2, 8, 2, 4),
             (2, 12, 4, 4, 16, 8, 8)]}  # level, lower, upper: the left half as it is, the right half finer


def linear(x):
    """Returns a density (n,) and a velocity (n, 3) at positions (n, 3)."""
    return 1 + x @ [2, 3, 5], np.column_stack([x[:, 0], -x[:, 1], 7 + x[:, 2]])


def write_boxes(file, boxes, levels, spacing, dimension):
    """Writes the boxes of a refined grid, and the values at their cell centres, box by box."""
    widths = np.array([[h / 2**level if axis < dimension else h for axis, h in enumerate(spacing)]
                       for level in range(levels)])
    file["grid/boxes"], file["grid/levels"] = np.array(boxes, "i4"), widths
    places = []
    for level, *corners in boxes:
        lines = [(np.arange(corners[axis], corners[3 + axis]) + 0.5) * widths[level, axis] for axis in range(3)]
        z, y, x = np.meshgrid(*lines[::-1], indexing="ij")
        places.append(np.column_stack([x.ravel(), y.ravel(), z.ravel()]))
    density, velocity = linear(np.concatenate(places))
    file["cells/c.density"], file["cells/gas/c.velocity"] = density, velocity


def make_refined(where, dimension=2, name="refined"):
    """4 coarse cells along x, 2 along y and z; one level at the first output, three at the second; one particle."""
    folder = make_folder(where, name)
    write_index(folder, [("c.density", "cell", 1, "kg/m^3", ""), ("c.velocity", "cell", 3, "m/s", "gas"),
                         ("p.x", "particle", 3, "m", "gas")], [], [(0, 0.0), (10, 1.0)], "Refined", 2)
    cells, spacing = [4, *[2] * (dimension - 1), *[1] * (3 - dimension)], [0.25, 0.5, 0.5]
    for step, boxes, levels in ((0, [(0, 0, 0, 0, *cells)], 1), (10, BOXES[dimension], 3)):
        with open_output(folder, step, step / 10, cells, spacing, dimension) as file:
            write_boxes(file, boxes, levels, spacing, dimension)
            file["particles/gas/p.x"] = np.array([[0.9, 0.4, 0.3]])
            file["particles/gas"].attrs["index"] = 0
    return os.path.join(where, name + ".uda")


def make_all(where):
    """Creates one archive of each kind and returns them by name."""
    return {"sod": make_sod(where), "plate": make_heat(where, (6, 4, 1), 2, "plate"),
            "box": make_heat(where, (6, 4, 3), 3, "box"), "disks": make_disks(where), "moving": make_moving(where)}
