"""Outputs as datasets of pyvista and yt."""
from __future__ import annotations

from typing import Any, Dict, Tuple

import numpy as np

from tushar.errors import ArchiveError, need
from tushar.frames import columns_of, fields_of
from tushar.grid import Values
from tushar.refined import Refined
from tushar.snapshot import Snapshot


def to_pyvista(snapshot: Snapshot) -> Any:
    pyvista = need("pyvista", "to_pyvista")
    blocks = pyvista.MultiBlock()
    if snapshot.grid.is_refined:
        blocks["cells"] = _boxes(pyvista, snapshot)
    else:
        cells = _image(pyvista, snapshot)
        if cells.array_names:
            blocks["cells"] = cells
    for material, count in snapshot.materials.items():
        if count:
            blocks[material] = _points(pyvista, snapshot, material)
    return blocks


def _image(pyvista: Any, snapshot: Snapshot) -> Any:
    """A VTK grid of one level, with the fields on its cells and nodes. VTK has two nodes where an axis has one."""
    grid = snapshot.grid
    image = pyvista.ImageData(dimensions=grid.cells + 1, spacing=grid.spacing, origin=grid.lower)
    nodes = tuple(int(count) + 1 for count in grid.cells[::-1])
    for name, variable, owner in fields_of(snapshot):
        values = (snapshot[variable.name, owner] if owner else snapshot[variable.name]).values
        tail = values.shape[3:]
        if variable.centring == "cell":
            image.cell_data[name] = values.reshape(-1, *tail)
        else:
            image.point_data[name] = np.broadcast_to(values, (*nodes, *tail)).reshape(-1, *tail)
    return image


def _boxes(pyvista: Any, snapshot: Snapshot) -> Any:
    """A VTK image for each box of a refined grid."""
    blocks = pyvista.MultiBlock()
    fields = [(name, snapshot[variable.name, owner]) for name, variable, owner in fields_of(snapshot)]
    boxes = [(name, field.boxes) for name, field in fields if isinstance(field, Refined)]
    for name, own in boxes:
        for number, box in enumerate(own):
            block = f"level {box.level} box {number}"
            if block not in blocks.keys():
                blocks[block] = pyvista.ImageData(dimensions=box.cells + 1, spacing=box.spacing, origin=box.lower)
            values = box.values
            blocks[block].cell_data[name] = values.reshape(-1, *values.shape[3:])
    return blocks


def _points(pyvista: Any, snapshot: Snapshot, material: str) -> Any:
    particles = snapshot.particles(material)
    cloud = pyvista.PolyData(particles["p.x"].values)
    for name in particles.variables:
        if name != "p.x":
            cloud.point_data[name] = particles[name].values
    return cloud


def to_yt(snapshot: Snapshot) -> Any:
    yt = need("yt", "to_yt")
    grid = snapshot.grid
    box = np.stack([grid.lower, grid.upper], axis=1)
    fields = _of_cells(snapshot)
    particles = _of_particles(snapshot)
    common = dict(length_unit="m", mass_unit="kg", time_unit="s", velocity_unit="m/s", bbox=box, sim_time=snapshot.time)
    if fields:
        return yt.load_uniform_grid({**fields, **particles}, tuple(map(int, grid.cells)), **common)
    if not particles:
        raise ArchiveError(f"output {snapshot.index} of '{snapshot.archive.folder}' contains neither cells nor "
                           "particles")
    return yt.load_particles({name: values for (_, name), values in particles.items()}, **common)


def _of_cells(snapshot: Snapshot) -> Dict[Any, Tuple[Values, str]]:
    """Component -> values (x, y, z) and unit, as yt expects them."""
    found: Dict[Any, Tuple[Values, str]] = {}
    for name, variable, owner in fields_of(snapshot):
        if variable.centring == "cell":
            values = (snapshot[variable.name, owner] if owner else snapshot[variable.name]).values
            shape = values.shape[:3]
            for column, line in columns_of(name, values.reshape(np.prod(shape), -1)).items():
                found["stream", column] = (line.reshape(shape).transpose(2, 1, 0).copy(), unit_of(variable.unit))
    return found


def _of_particles(snapshot: Snapshot) -> Dict[Any, Tuple[Values, str]]:
    """yt's names of positions, and those of the archive; only variables that all materials have."""
    found: Dict[Any, Tuple[Values, str]] = {}
    everything = snapshot.particles()
    if not len(everything):
        return found
    for name in everything.variables:
        values = everything[name].values
        if len(values) == len(everything):
            for column, line in columns_of(name, values).items():
                column = column.replace("p.x.", "particle_position_") if name == "p.x" else column
                found["io", column] = (line, unit_of(snapshot.archive.variables[name].unit))
    return found


def unit_of(unit: str) -> str:
    """A unit in yt's notation: `kg/m^3` -> `kg/m**3`; no unit for 1."""
    return "" if unit == "1" else unit.replace("^", "**")
