"""Reads a `.uda` archive.

    from tushar.uda import Uda
    uda = Uda("sod.uda")
    x = uda.particles("p.x")[:, 0]            # last output, all materials
    rho = uda.particles("p.density", index=0)  # first output
    time, energy = uda.globals("KineticEnergy")
"""
import difflib
import glob
import os
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field

import h5py
import numpy as np


class UdaError(Exception):
    """What is wrong with an archive or a request, in one sentence."""


@dataclass
class Variable:
    """A saved variable or a global quantity."""
    name: str
    unit: str
    description: str
    components: int = 1
    centring: str = "global"  # particle, cell, node or global
    materials: list = field(default_factory=list)


@dataclass
class Grid:
    """The grid of an output; vectors are x, y, z. An axis that is not in use has one cell and one node."""
    lower: np.ndarray
    spacing: np.ndarray
    cells: np.ndarray
    dimension: int

    @property
    def axes(self):
        """The axes in use, 0 for x to 2 for z."""
        return sorted(sorted(range(3), key=lambda axis: (self.cells[axis] <= 1, axis))[:self.dimension])

    def coordinates(self, centring):
        """Three arrays: the positions of the cells or nodes along x, y and z [m]."""
        lines = []
        for axis in range(3):
            at_nodes = centring == "node" and axis in self.axes
            count = self.cells[axis] + 1 if at_nodes else self.cells[axis]
            lines.append(self.lower[axis] + (np.arange(count) + (0 if at_nodes else 0.5)) * self.spacing[axis])
        return lines


def check_name(kind, name, names):
    """Returns `name` if it is among `names`; else raises UdaError with the nearest and all others."""
    names = list(names)
    if name in names:
        return name
    lowered = {other.lower(): other for other in names}
    near = difflib.get_close_matches(name.lower(), lowered, 1, 0.5)
    hint = f" (did you mean '{lowered[near[0]]}'?)" if near else ""
    there = ", ".join(names) if names else "none"
    raise UdaError(f"no {kind} '{name}'{hint}; there is: {there}")


def _xml(path):
    try:
        return ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise UdaError(f"cannot read '{path}': {error}") from None


class Uda:
    """An archive, `sod.uda` or `sod.uda.000`. An `index` counts its outputs; -1 is the last. Wrong names and unreadable
    files raise UdaError."""

    def __init__(self, path):
        self.folder = os.path.normpath(path)
        index_file = os.path.join(self.folder, "index.xml")
        if not os.path.isfile(index_file):
            raise UdaError(self._not_an_archive())
        index = _xml(index_file)
        self.version = index.get("version", "")
        self.variables = {item.get("name"): self._variable(item) for item in index.iterfind("variables/variable")}
        self.global_variables = {item.get("name"): self._variable(item) for item in index.iterfind("globals/global")}
        outputs = index.findall("timesteps/timestep")
        self.times = [float(output.get("time")) for output in outputs]
        self.steps = [int(output.text) for output in outputs]
        self._files = [os.path.join(self.folder, output.get("href")) for output in outputs]
        self._dat_files = {item.get("name"): os.path.join(self.folder, item.get("href"))
                           for item in index.iterfind("globals/global")}

    def _not_an_archive(self):
        numbered = sorted(glob.glob(glob.escape(self.folder) + ".[0-9]*"))
        hint = f"; there is '{numbered[-1]}'" if numbered else ""
        what = "has no index.xml, so it is no archive" if os.path.isdir(self.folder) else "is no folder"
        return f"'{self.folder}' {what}{hint}"

    @staticmethod
    def _variable(item):
        materials = item.get("materials", "")
        return Variable(item.get("name"), item.get("unit", ""), item.get("description", ""),
                        int(item.get("components", 1)), item.get("centring", "global"),
                        materials.split(", ") if materials else [])

    @property
    def title(self):
        """`Meta/title` of the scene; the folder's name if it has none."""
        try:
            title = _xml(os.path.join(self.folder, "input.xml")).findtext("Meta/title", "").strip()
        except UdaError:
            title = ""
        return title or os.path.basename(self.folder)

    def has_file(self, index):
        """Whether the file of an output is there."""
        return os.path.exists(self._files[index])

    def index_at(self, time):
        """The output nearest to a time [s]."""
        if not self.times:
            raise UdaError(f"'{self.folder}' has no outputs yet")
        return int(np.argmin(np.abs(np.array(self.times) - time)))

    def open(self, index=-1):
        """The HDF5 file of an output, to be used in `with`."""
        count = len(self._files)
        if not -count <= index < count:
            raise UdaError(f"no output {index}: '{self.folder}' has {count}" +
                           (", 0 to %d" % (count - 1) if count else ""))
        try:
            return h5py.File(self._files[index], "r")
        except OSError as error:
            raise UdaError(f"cannot read '{self._files[index]}': {error}") from None

    def grid(self, index=-1):
        with self.open(index) as file:
            kept = file["grid"].attrs
            return Grid(kept["lower"], kept["spacing"], kept["cells"], int(kept["dimension"]))

    def materials(self, index=-1):
        """Material name -> number of particles, in the order of the scene."""
        with self.open(index) as file:
            groups = sorted(file.get("particles", {}).items(), key=lambda item: item[1].attrs.get("index", 0))
            return {name: len(group["p.x"]) for name, group in groups}

    def particles(self, label, material=None, index=-1):
        """Values of the particles, (n,) for scalars, (n, components) else; of all materials if none is named."""
        self._check_label(label, ("particle",))
        materials = [check_name("material", material, self.materials(index))] if material else self.materials(index)
        with self.open(index) as file:
            parts = [file["particles"][name][label][()] for name in materials if label in file["particles"][name]]
        if not parts:
            raise UdaError(f"output {index} holds no '{label}'" + (f" of material '{material}'" if material else ""))
        return np.concatenate(parts)

    def field(self, label, material=None, index=-1):
        """Values of the cells or nodes, shape (z, y, x) for scalars, (z, y, x, components) else. A field that belongs
        to materials needs the name of one if there are several."""
        variable = self._check_label(label, ("cell", "node"))
        if material:
            check_name("material", material, variable.materials)
        with self.open(index) as file:
            group = file.get(variable.centring + "s", {})
            if label in group and not material:
                return group[label][()]
            names = [material] if material else [name for name in variable.materials if label in group.get(name, {})]
            if len(names) > 1:
                raise UdaError(f"'{label}' belongs to several materials; name one: {', '.join(names)}")
            if not names or label not in group.get(names[0], {}):
                why = "; a step computes it, and this is the start" if file.attrs["step"] == 0 else ""
                raise UdaError(f"output {index} holds no '{label}'{why}")
            return group[names[0]][label][()]

    def globals(self, name):
        """Times [s] (n,) and values (n,) or (n, components) of a global quantity."""
        check_name("global", name, self.global_variables)
        with open(self._dat_files[name], encoding="utf-8") as file:
            rows = [line.split() for line in file if line.endswith("\n") and not line.startswith("#")]
        columns = 1 + self.global_variables[name].components
        table = np.array([row for row in rows if len(row) == columns], dtype=float).reshape(-1, columns)
        return table[:, 0], table[:, 1] if columns == 2 else table[:, 1:]

    def reference(self, index=-1):
        """Column -> values of the exact solution; empty if the archive has none."""
        with self.open(index) as file:
            return {name: column[()] for name, column in file.get("reference", {}).items()}

    def _check_label(self, label, centrings):
        names = [name for name, variable in self.variables.items() if variable.centring in centrings]
        return self.variables[check_name(" or ".join(centrings) + " variable", label, names)]
