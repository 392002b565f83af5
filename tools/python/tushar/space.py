"""Views in three dimensions, drawn by pyvista if it is installed: particles as balls, fields as isosurfaces."""
from __future__ import annotations

import os
from typing import Any, List, NamedTuple, Optional, Tuple

import numpy as np

from tushar.errors import MissingLibrary, need
from tushar.grid import Values
from tushar.panels import colouring
from tushar.view import Output, Quantity

SIZE = 1200, 1000  # pixels
SURFACES = 5
VTK_WITHOUT_SCREEN = 9, 4  # from this version on VTK draws where there is no display


def _pyvista() -> Any:
    """The module pyvista; None if it is not installed or cannot draw."""
    try:
        pyvista = need("pyvista", "a view in three dimensions")
    except MissingLibrary:
        return None
    if tuple(pyvista.vtk_version_info[:2]) < VTK_WITHOUT_SCREEN and not os.environ.get("DISPLAY"):
        return None
    logger = need("vtkmodules.vtkCommonCore", "a view in three dimensions").vtkLogger
    logger.SetStderrVerbosity(logger.VERBOSITY_ERROR)  # it warns where there is no display, and draws all the same
    return pyvista


class Mark(NamedTuple):
    """A label next to the box, with its position and alignment."""
    place: Tuple[float, ...]
    text: str
    side: str
    height: str


class Seen(NamedTuple):
    """A picture (height, width, 3) in bytes, and the labels to write on it, with positions in pixels."""
    pixels: Values
    marks: List[Mark]


def render(output: Output, quantity: Quantity) -> Optional[Seen]:
    """Draws a quantity in the whole grid; returns None if pyvista is not available."""
    pyvista = _pyvista()
    if pyvista is None:
        return None
    box = [edge for axis in range(3) for edge in output.extent(axis)]
    plotter = pyvista.Plotter(off_screen=True, window_size=list(SIZE))
    plotter.set_background("white")
    plotter.add_mesh(pyvista.Box(bounds=box), style="wireframe", color="#a0aec0", line_width=1)
    if output.view.boxes and output.grid.is_refined:
        ends = [np.stack(corners, axis=1).ravel() for corners in output.boxes()]
        plotter.add_mesh(pyvista.merge([pyvista.Box(bounds=own) for own in ends]), style="wireframe", color="#a0aec0",
                         line_width=0.5)
    if quantity.variable.centring == "particle":
        _balls(pyvista, plotter, output, quantity)
    else:
        _surfaces(pyvista, plotter, output, quantity)
    plotter.camera_position = "iso"
    plotter.reset_camera(bounds=box)
    plotter.camera.zoom(1.0)
    seen: Values = np.asarray(plotter.screenshot(None, return_img=True))
    marks = [mark._replace(place=_on_screen(plotter, mark.place)) for mark in _marks(output)]
    plotter.close()
    return Seen(seen, marks)


def _marks(output: Output) -> List[Mark]:
    """Labels with the ends and the name of each axis, next to the edges of the box at the border of the view."""
    (x0, x1), (y0, y1), (z0, z1) = (output.extent(axis) for axis in range(3))
    edges = (("x", (x0, x1), lambda x: (x, y1, z0), "left", "top"),
             ("y", (y0, y1), lambda y: (x1, y, z0), "right", "top"),
             ("z", (z0, z1), lambda z: (x1, y0, z), "right", "bottom"))
    found = []
    for name, (low, high), place, side, height in edges:
        found += [Mark(place(end), f"{end:.4g}", side, height) for end in (low, high)]
        found.append(Mark(place((low + high) / 2), f"{name} [m]", side, height))
    return found


def _on_screen(plotter: Any, place: Tuple[float, ...]) -> Tuple[float, ...]:
    """Position of a point in space on the screen, in pixels from the left and from the top."""
    renderer = plotter.renderer
    renderer.SetWorldPoint(*place, 1.0)
    renderer.WorldToDisplay()
    across, up, _ = renderer.GetDisplayPoint()
    return across, SIZE[1] - up


def _balls(pyvista: Any, plotter: Any, output: Output, quantity: Quantity) -> None:
    found = [output.particles(quantity, name) for name in output.materials_with(quantity.variable)]
    x, values = (np.concatenate(part) for part in zip(*found))
    cloud = pyvista.PolyData(x)
    cloud["colour"] = _colours(output, quantity, values)
    size = output.grid.spacing[output.grid.axes]
    cells = len(np.unique(np.floor((x - output.grid.lower) / output.grid.spacing), axis=0))
    radius = 0.5 * float(np.prod(size) * cells / max(len(x), 1)) ** (1 / 3)
    extent = np.linalg.norm(output.grid.cells * output.grid.spacing)
    plotter.add_mesh(cloud, scalars="colour", rgb=True, style="points", render_points_as_spheres=True,
                     point_size=max(2.0, 2 * radius / extent * SIZE[1]), lighting=True)


def _surfaces(pyvista: Any, plotter: Any, output: Output, quantity: Quantity) -> None:
    """Isosurfaces between the smallest and the largest value, from the values at cell centres."""
    owner = output.owners(quantity)[0]
    values = output.field(quantity, owner)
    lines = output.grid.coordinates(quantity.variable.centring)
    image = pyvista.ImageData(dimensions=values.shape[::-1], spacing=output.grid.spacing,
                              origin=[line[0] for line in lines])
    image["value"] = np.nan_to_num(values).ravel()
    norm = colouring(output, quantity, values)["norm"]
    levels = norm.inverse(np.linspace(0, 1, SURFACES + 2)[1:-1])
    for level in levels:
        surface = image.contour([float(level)], scalars="value")
        if surface.n_points:
            colour = _colours(output, quantity, np.array([level]), values)[0] / 255
            plotter.add_mesh(surface, color=colour, opacity=0.5, smooth_shading=True, ambient=0.5)


def _colours(output: Output, quantity: Quantity, values: Values, of: Optional[Values] = None) -> Values:
    """Colours (n, 3) in bytes for values, as in the colour bar for all values."""
    import matplotlib
    colours = colouring(output, quantity, values if of is None else of)
    shown = matplotlib.colormaps[colours["cmap"]](colours["norm"](values), bytes=True)
    return np.asarray(shown[..., :3])
