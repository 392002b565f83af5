"""The panels of a figure: profiles along a line, images and clouds of points in a plane."""
from __future__ import annotations

import re
from typing import Any, Dict, List, Optional, Tuple

import matplotlib.collections
import matplotlib.colors
import matplotlib.ticker
import numpy as np

from tushar.errors import ArchiveError
from tushar.grid import Values
from tushar.view import Output, Quantity, Range

# The classic four of a shock tube: label in the archive, column of the exact solution, name on the axis.
GAS = [("p.density", "density", "density"), ("p.velocity", "velocity", "velocity"),
       ("p.pressure", "pressure", "pressure"), ("p.internalEnergy", "energy", "specific internal energy")]
MARKS, MARK = "os^Dvp", 3.5  # of the levels of a refined grid; size [pt]
OUTLINE = "#4a5568"
COLOURS = ["#2b6cb0", "#c05621", "#2f855a", "#6b46c1", "#b83280", "#2c7a7b"]


def pretty_unit(unit: str) -> str:
    """A unit as shown in figures: `kg/m^3` -> `kg/m³`."""
    raised = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
    return re.sub(r"\^(-?\d+)", lambda power: power.group(1).translate(raised), unit)


def axis_label(name: str, unit: str) -> str:
    return f"{name} [{pretty_unit(unit)}]" if unit not in ("", "1") else name


def words(label: str) -> str:
    """A label in words: `c.temperature` -> `temperature`, `p.internalEnergy` -> `internal energy`, `p.particleID` ->
    `particle ID`."""
    return re.sub(r"(?<=[a-z])([A-Z]{2,}(?![a-z])|[A-Z])", lambda found: " " + _uncapitalized(found[1]),
                  label.split(".")[-1])


def _uncapitalized(letters: str) -> str:
    """A capital in lower case; an abbreviation as it is."""
    return letters if len(letters) > 1 else letters.lower()


def name_of(output: Output, quantity: Quantity, on_line: bool = False) -> str:
    """The name of a quantity for an axis: density, |velocity|, velocity x, difference of density."""
    base = quantity.variable.name
    name = next((name for known, _, name in GAS if known == base), words(base))
    if quantity.component is not None:
        name += " " + quantity.label.split(".")[-1]
    elif not quantity.is_scalar and not on_line:
        name = f"|{name}|"
    return f"difference of {name}" if output.other else name


def profile(panel: Any, output: Output, quantity: Quantity) -> None:
    """Draws values along the only remaining axis, with the exact solution if the archive has it."""
    axis = output.axes[0]
    extent_of(output, quantity, output.values_of(quantity))
    if quantity.variable.centring == "particle":
        _points_on_line(panel, output, quantity, axis)
    else:
        x = output.grid.coordinates(quantity.variable.centring)[axis]
        for colour, owner in zip(COLOURS * 9, output.owners(quantity)):
            values = output.field(quantity, owner, axis).ravel()
            if output.grid.is_refined and quantity.variable.centring == "cell":
                _refined_line(panel, output, axis, values, colour, owner)
                continue
            panel.plot(x, values, "-o" if len(x) <= 200 else "-", color=colour, markersize=3, linewidth=1.4,
                       label=owner or quantity.variable.centring + "s")
    if not output.other and not output.view.slices:
        _exact(panel, output, quantity.label)
    panel.set_ylabel(axis_label(name_of(output, quantity, on_line=True), quantity.variable.unit))
    panel.set_xlim(output.extent(axis))
    _limit(panel, output.view.limits(quantity.label), output.view.log)


def _refined_line(panel: Any, output: Output, axis: int, values: Values, colour: str, owner: Optional[str]) -> None:
    """Draws the cells of a refined grid at their positions, with a different marker for each level."""
    x, levels, cells = output.cells_along(axis)
    panel.plot(x, values[cells], "-", color=colour, linewidth=1.2, label=owner or "cells")
    for level in np.unique(levels):
        here = levels == level
        panel.plot(x[here], values[cells][here], MARKS[level % len(MARKS)], color=colour, markersize=MARK,
                   markerfacecolor="white" if level % 2 == 0 else colour, markeredgewidth=0.7,
                   label=f"level {level}" + (f" of {owner}" if owner else ""))
    if output.view.boxes:
        for low, high in output.boxes():
            panel.axvspan(low[axis], high[axis], fill=False, edgecolor=OUTLINE, linewidth=0.5)


def outlines(panel: Any, output: Output, axes: List[int], slices: Optional[Dict[int, float]] = None) -> None:
    """Draws the boxes of a refined grid in a plane, if requested."""
    if not output.view.boxes:
        return
    across, up = axes
    corners = [[(low[across], low[up]), (high[across], low[up]), (high[across], high[up]), (low[across], high[up])]
               for low, high in output.boxes(slices)]
    panel.add_collection(matplotlib.collections.PolyCollection(corners, facecolor="none", edgecolor=OUTLINE,
                                                               linewidth=0.4))


def _points_on_line(panel: Any, output: Output, quantity: Quantity, axis: int) -> None:
    materials = output.materials_with(quantity.variable)
    for colour, material in zip(COLOURS * len(materials), materials):
        x, values = output.particles(quantity, material, axis)
        name = f"particles of {material}" if len(materials) > 1 else "particles"
        panel.plot(x[:, axis], values, "o", color=colour, markersize=marker_size(len(x)), markeredgewidth=0, label=name)


def _exact(panel: Any, output: Output, label: str) -> None:
    table = output.snapshot.reference
    column = next((column for known, column, _ in GAS if known == label), words(label))
    if "x" in table and column in table and column != "x":  # x is where the others are
        panel.plot(table["x"], table[column], "-", color="#1a202c", linewidth=1.2, label="exact")


def _limit(panel: Any, limits: Range, log: bool) -> None:
    """The range of the values on an axis, with a margin in a film."""
    if log:
        panel.set_yscale("log")
    low, high = limits
    if low is not None and high is not None and not log:
        margin = 0.04 * (high - low)
        panel.set_ylim(low - margin, high + margin)
    else:
        panel.set_ylim(low, high)
    if log:
        plain_marks(panel.yaxis)
    else:
        widen(panel)


def plain_marks(axis: Any) -> None:
    """Ticks at 1, 2, 3 instead of powers on a logarithmic axis that spans less than two decades."""
    low, high = axis.get_view_interval()
    if high < 100 * low:
        axis.set_major_formatter(matplotlib.ticker.LogFormatter())
        axis.set_minor_formatter(matplotlib.ticker.LogFormatter(minor_thresholds=(2, 0.5)))


def image(panel: Any, output: Output, quantity: Quantity, axes: List[int],
          slices: Optional[Dict[int, float]] = None) -> Any:
    """Draws a field in a plane; returns the object for the colour bar."""
    owners = output.owners(quantity)
    if len(owners) > 1:
        output.notes.append(f"{quantity.label}: only that of {owners[0]}; --material selects another one")
    values = output.field(quantity, owners[0], slices=slices)
    across, up = axes
    pad = output.grid.spacing / 2 if quantity.variable.centring == "node" else np.zeros(3)
    box = [edge for axis in axes for edge in (output.extent(axis)[0] - pad[axis], output.extent(axis)[1] + pad[axis])]
    drawn = panel.imshow(values, origin="lower", extent=box, interpolation="nearest", aspect="equal",
                         **colouring(output, quantity, values))
    _frame(panel, output, across, up)
    return drawn


def cloud(panel: Any, output: Output, quantity: Quantity, axes: List[int], width: float,
          slices: Optional[Dict[int, float]] = None) -> Any:
    """Draws particles in a plane, on a panel of this width [pt]; returns the object for the colour bar."""
    materials = output.materials_with(quantity.variable)
    found = [output.particles(quantity, name, slices=slices) for name in materials]
    x, values = (np.concatenate(part) for part in zip(*found))
    across, up = axes
    if quantity.label == "p.x" and slices is None:
        return _places(panel, output, dict(zip(materials, (places for places, _ in found))), axes, width)
    colours = colouring(output, quantity, values)
    drawn = panel.scatter(x[:, across], x[:, up], c=values, s=_point_area(output, x, axes, width), linewidths=0,
                          rasterized=True, **colours)
    panel.set_aspect("equal")
    _frame(panel, output, across, up)
    return drawn


def _places(panel: Any, output: Output, places: Dict[str, Values], axes: List[int], width: float) -> None:
    """Draws the particles of each material in one colour, without values."""
    area = _point_area(output, np.concatenate(list(places.values())), axes, width)
    for colour, (material, x) in zip(COLOURS * len(places), places.items()):
        panel.scatter(x[:, axes[0]], x[:, axes[1]], s=area, color=colour, linewidths=0, label=material, rasterized=True)
    panel.set_aspect("equal")
    _frame(panel, output, *axes)
    if len(places) > 1:
        panel.legend(loc="best", markerscale=2, fontsize=9)


def _frame(panel: Any, output: Output, across: int, up: int) -> None:
    panel.set_xlim(output.extent(across))
    panel.set_ylim(output.extent(up))
    panel.grid(False)
    panel.set_xlabel(f"{'xyz'[across]} [m]")
    panel.set_ylabel(f"{'xyz'[up]} [m]")
    set_ticks(panel, output, across, up)


def set_ticks(panel: Any, output: Output, across: int, up: int) -> None:
    """Sets as many ticks as fit: a short axis gets few."""
    long = [high - low for low, high in map(output.extent, (across, up))]
    for axis, length, least in (("x", long[0], 1), ("y", long[1], 2)):
        panel.locator_params(axis=axis, nbins=int(np.clip(round(6 * length / max(long)), least, 5)))


def colouring(output: Output, quantity: Quantity, values: Values) -> Dict[str, Any]:
    """Colour map and scale for values: those of the view; for a difference, symmetric about 0."""
    low, high = bounds(output, quantity, values)
    cmap = output.view.cmap or ("RdBu_r" if output.other and quantity.is_scalar else "viridis")
    scale = matplotlib.colors.LogNorm if output.view.log else matplotlib.colors.Normalize
    return {"cmap": cmap, "norm": scale(low, high)}


def drawable(output: Output, quantity: Quantity, values: Values) -> Values:
    """The values that can be drawn: numbers and, on a logarithmic scale, above 0. Notes how many are not numbers.
    Raises ArchiveError if none is left, except in a film with common ranges, whose other pictures have some."""
    label, (low, high) = quantity.label, output.view.limits(quantity.label)
    in_film = bool(output.view.ranges) and low is not None and high is not None
    known = np.asarray(values[np.isfinite(values)])
    if len(known) < values.size:
        count = f"{values.size - len(known)} of {values.size} values of '{label}' are not numbers"
        where = f"output {output.snapshot.index}: " if output.view.ranges else ""
        if not len(known) and not in_film:
            raise ArchiveError(f"{count}, so nothing can be drawn")
        if where + count not in output.notes:
            output.notes.append(where + count)
    if output.view.log:
        known = known[known > 0]
        if not len(known) and not in_film:
            raise ArchiveError(f"'{label}' has no values above 0, so a logarithmic scale is impossible")
    return known


def extent_of(output: Output, quantity: Quantity, values: Values) -> Tuple[float, float]:
    """The limits of the view, and for those that it leaves open the smallest or largest value, symmetric about 0 for a
    difference. Raises ArchiveError if all values are beyond a limit."""
    low, high = output.view.limits(quantity.label)
    known = drawable(output, quantity, values)
    least, most = (float(known.min()), float(known.max())) if len(known) else (low or 0.0, high or 1.0)
    if output.other and quantity.is_scalar and low is None and high is None:
        least, most = -max(abs(least), abs(most)), max(abs(least), abs(most))
    least, most = least if low is None else low, most if high is None else high
    if least > most and len(known):
        first, _ = output.view.range or (None, None)
        limit = f"ends at {most:g}" if first is None else f"begins at {least:g}"
        raise ArchiveError(f"the range {limit}, but the values of '{quantity.label}' extend from {known.min():g} to "
                           f"{known.max():g}")
    return least, most


def bounds(output: Output, quantity: Quantity, values: Values) -> Tuple[float, float]:
    """The smallest and the largest value in the range of the colour map."""
    least, most = extent_of(output, quantity, values)
    if most - least < 1e-9 * max(abs(least), abs(most)):  # a constant is not drawn as its rounding errors
        middle = (least + most) / 2
        least, most = middle - 0.05 * abs(middle), middle + 0.05 * abs(middle)
    return (least, most) if most > least else (least - 1e-12, least + 1e-12)


def _point_area(output: Output, x: Values, axes: List[int], width: float) -> float:
    """Area [pt^2] of points that just touch if the particles are as dense as in the average occupied cell."""
    grid = output.grid
    cells = np.unique(np.floor((x - grid.lower) / grid.spacing)[:, axes], axis=0)
    area = np.prod(grid.spacing[axes]) * len(cells) / max(len(x), 1)
    low, high = output.extent(axes[0])
    return float(np.clip(area * (width / (high - low)) ** 2, 0.2, 400))


def marker_size(count: int) -> float:
    """Point size at which `count` points can still be distinguished."""
    return float(np.clip(80 / np.sqrt(max(count, 1)), 0.8, 5))


def widen(panel: Any) -> None:
    """Widens the range of a constant, so that its rounding errors are not drawn."""
    low, high = panel.get_ylim()
    middle, least = (low + high) / 2, 1e-6 * max(abs(low), abs(high), 1e-12)
    if high - low < least:
        panel.set_ylim(middle - max(0.05 * abs(middle), least), middle + max(0.05 * abs(middle), least))
