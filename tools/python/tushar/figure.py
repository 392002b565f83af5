"""Draws an output of an archive: profiles along a line, images and clouds of points in a plane, views in 3-D."""
from __future__ import annotations

import textwrap
from typing import Any, List, Optional, Sequence, Tuple

import matplotlib

matplotlib.use("Agg")
import matplotlib.cm
import matplotlib.pyplot as plt
import numpy as np

from tushar import space
from tushar.archive import Archive
from tushar.errors import ArchiveError
from tushar.panels import (COLOURS, GAS, axis_label, bounds, cloud, colouring, image, name_of, outlines, plain_marks,
                           profile, words)
from tushar.snapshot import ID
from tushar.view import Output, Quantity, View

STYLE = {"font.family": "DejaVu Sans", "font.size": 10, "axes.spines.top": False, "axes.spines.right": False,
         "axes.edgecolor": "#4a5568", "axes.labelcolor": "#1a202c", "xtick.color": "#4a5568", "ytick.color": "#4a5568",
         "axes.grid": True, "grid.color": "#e2e8f0", "grid.linewidth": 0.8, "axes.axisbelow": True,
         "legend.frameon": False, "figure.dpi": 150, "svg.fonttype": "none", "figure.constrained_layout.w_pad": 0.12,
         "figure.constrained_layout.h_pad": 0.12, "figure.constrained_layout.wspace": 0.03,
         "figure.constrained_layout.hspace": 0.03}
TITLE = {"fontsize": 12.5, "fontweight": "bold", "color": "#1a202c"}
SIDE = 4.2  # of the longest axis among three slices [inch]
LETTER = 0.108  # width of one in a title [inch]


def choose(output: Output) -> Tuple[List[str], List[str]]:
    """Chooses the labels to draw by default; notes missing ones."""
    archive, dimension = output.snapshot.archive, len(output.axes)
    counts, wanted = output.snapshot.materials, output.view.material
    held = [name for name, count in counts.items() if count and wanted in (None, name)]
    saved = [v for v in archive.variables.values()
             if v.centring == "particle" and v.name != "p.x" and set(held) & set(v.materials)]
    names = [variable.name for variable in saved]
    gas = [label for label, _, _ in GAS if label in names]
    if gas:
        is_gas = any(label != "p.velocity" for label in gas)  # solids have a velocity, too
        missing = [(label, name) for label, _, name in GAS if label not in gas and dimension == 1 and is_gas]
        notes = [f'there is no {name}: the scene does not save it; add <save label="{label}"/> to DataArchiver'
                 for label, name in missing]
        return gas if dimension == 1 else gas[:1], notes
    fields = [v.name for v in archive.variables.values() if v.centring in ("cell", "node")
              and (wanted is None or not v.materials or wanted in v.materials)]
    names = [name for name in names if name != ID]
    others = [v.name for v in saved if v.components == 1 and v.name in names] or names
    if held and not fields and not others:
        return ["p.x"], []  # where the particles of each material are
    if not fields and not others:
        raise ArchiveError(f"'{archive.folder}' contains nothing to draw at this output")
    return (fields or others)[:4 if dimension == 1 else 1], []


def broken(title: str, letters: int) -> str:
    """Breaks a title into lines of limited length, before the time or the position if possible."""
    lines: List[str] = []
    for part in title.split(",  "):
        if lines and len(lines[-1]) + len(part) + 3 <= letters:
            lines[-1] += ",  " + part
        else:
            lines += textwrap.wrap(part, letters)
    return "\n".join(lines)


class Figure:
    """One output of an archive as a figure. `notes` describe choices, and parts that could not be drawn. Raises
    ArchiveError if nothing can be drawn."""

    def __init__(self, archive: Archive, index: int = -1, variables: Sequence[str] = (), title: Optional[str] = None,
                 view: Optional[View] = None) -> None:
        if not archive.times:
            raise ArchiveError(f"'{archive.folder}' has no outputs yet")
        with archive[index] as snapshot:
            self.output = Output(snapshot, view or View())
            self.notes = self.output.notes
            labels = list(variables)
            if not labels:
                labels, notes = choose(self.output)
                self.notes += notes
            self.quantities = [Quantity.of(archive, label) for label in labels]
            self._check_slices()
            with plt.rc_context(STYLE):
                self._draw(title or self._title())

    def _check_slices(self) -> None:
        """Raises ArchiveError if a slice contains nothing; in a film with common ranges, this is allowed for some
        outputs."""
        slices = self.output.view.slices
        if not slices or self.output.view.ranges:
            return
        if not any(len(self.output.values_of(quantity)) for quantity in self.quantities):
            places = ", ".join(f"{'xyz'[axis]} = {place:g} m" for axis, place in slices.items())
            raise ArchiveError(f"no particles lie within half a cell of {places}")

    def save(self, path: Any) -> None:
        """Writes PNG, SVG or PDF, according to the extension of the path."""
        with plt.rc_context(STYLE):
            self.figure.savefig(path)
        plt.close(self.figure)

    def pixels(self) -> Any:
        """The picture as an array (height, width, 3) of bytes; height and width are even, as films require."""
        with plt.rc_context(STYLE):
            self.figure.canvas.draw()
            drawn = np.asarray(self.figure.canvas.buffer_rgba())[..., :3].copy()
        plt.close(self.figure)
        return drawn[:drawn.shape[0] // 2 * 2, :drawn.shape[1] // 2 * 2]

    def _title(self) -> str:
        output = self.output
        title = f"{output.snapshot.archive.title},  t = {output.snapshot.time:.4g} s"
        for axis, place in output.view.slices.items():
            title += f",  {'xyz'[axis]} = {place:.4g} m"
        return title

    def _draw(self, title: str) -> None:
        draw = (self._lines, self._planes, self._spaces)[len(self.output.axes) - 1]
        draw()
        letters = max(20, int(self.figure.get_figwidth() / LETTER))
        self.figure.suptitle(broken(title, letters), **TITLE)

    def _lines(self) -> None:
        count = len(self.quantities)
        columns = 1 if count == 1 else 2
        rows = -(-count // columns)
        size = (7.2, 5.2) if count == 1 else (9.6, 0.6 + 3.3 * rows)
        self.figure, grid = plt.subplots(rows, columns, figsize=size, squeeze=False,
                                         sharex=True, constrained_layout=True)
        panels = grid.ravel()
        for panel in panels[count:]:
            panel.remove()
        for panel, quantity in zip(panels, self.quantities):
            profile(panel, self.output, quantity)
        for panel in panels[max(0, count - columns):count]:
            panel.set_xlabel(f"{'xyz'[self.output.axes[0]]} [m]")
            panel.tick_params(labelbottom=True)
        handles, names = panels[0].get_legend_handles_labels()
        if len(handles) > 1:
            panels[0].legend(handles, names, loc="best", handlelength=1.6, fontsize=9)

    def _planes(self) -> None:
        count = len(self.quantities)
        columns = 1 if count == 1 else 2
        rows = -(-count // columns)
        (left, right), (low, high) = (self.output.extent(axis) for axis in self.output.axes)
        ratio = (right - left) / (high - low)
        most = (5.4, 4.6) if count == 1 else (4.2, 3.6)
        width = max(0.9, min(most[0], most[1] * ratio))
        flat = ratio > 2.2
        tall = max(0.5, width / ratio) + (1.5 if flat else 0.65)
        size = (max(columns * (width + (0.9 if flat else 1.9)), 4.4), 0.55 + rows * tall)
        self.figure, grid = plt.subplots(rows, columns, figsize=size, squeeze=False, constrained_layout=True)
        panels = grid.ravel()
        for panel in panels[count:]:
            panel.remove()
        for panel, quantity in zip(panels, self.quantities):
            if quantity.variable.centring == "particle":
                drawn = cloud(panel, self.output, quantity, self.output.axes, 72 * width)
            else:
                drawn = image(panel, self.output, quantity, self.output.axes)
            outlines(panel, self.output, self.output.axes)
            if drawn is not None:
                self._bar(self.figure, drawn, quantity, panel, "horizontal" if flat else "vertical")

    def _bar(self, figure: Any, drawn: Any, quantity: Quantity, panels: Any, orientation: str = "vertical") -> None:
        shape = {"shrink": 0.9, "pad": 0.02} if orientation == "vertical" else {"shrink": 0.7, "aspect": 35}
        bar = figure.colorbar(drawn, ax=panels, orientation=orientation, extend=_beyond(drawn), **shape)
        bar.set_label(axis_label(name_of(self.output, quantity), quantity.variable.unit))
        bar.outline.set_visible(False)
        if self.output.view.log:
            plain_marks(bar.ax.yaxis if orientation == "vertical" else bar.ax.xaxis)

    def _spaces(self) -> None:
        count = len(self.quantities)
        columns = 1 if count == 1 else 2
        rows = -(-count // columns)
        views = [space.render(self.output, quantity) for quantity in self.quantities]
        width, height = self._size_of_slices() if views[0] is None else (7.4, 5.8)
        self.figure = plt.figure(figsize=(width * columns, 0.5 + height * rows), layout="constrained")
        parts = self.figure.subfigures(rows, columns, squeeze=False).ravel()
        for part, quantity, seen in zip(parts, self.quantities, views):
            if seen is None:
                self._slices(part, quantity)
            else:
                self._seen(part, quantity, seen)

    def _lengths(self) -> List[float]:
        """Relative lengths of the drawn axes, the longest being 1; none is too short for its ticks."""
        long = [high - low for low, high in map(self.output.extent, range(3))]
        return [max(0.15, length / max(long)) for length in long]

    def _size_of_slices(self) -> Tuple[float, float]:
        x, y, z = self._lengths()
        return SIDE * (x + z) + 3.0, SIDE * (y + z) + 1.6

    def _seen(self, part: Any, quantity: Quantity, seen: Any) -> None:
        panel = part.subplots()
        panel.imshow(seen.pixels)
        panel.axis("off")
        for mark in seen.marks:
            shift = (5 if mark.side == "left" else -5, -3 if mark.height == "top" else 3)
            panel.annotate(mark.text, mark.place, xytext=shift, textcoords="offset points", ha=mark.side,
                           va=mark.height, color="#4a5568", annotation_clip=False)
        values = self.output.values_of(quantity)
        self._bar(part, matplotlib.cm.ScalarMappable(**colouring(self.output, quantity, values)), quantity, panel)

    def _slices(self, part: Any, quantity: Quantity) -> None:
        """Three planes: one normal to z, below it one normal to y with the same x axis, and beside it one normal to x
        with the same y axis."""
        middle = self.output.planes(quantity)
        x, y, z = self._lengths()
        grid = part.add_gridspec(2, 2, width_ratios=[x, z], height_ratios=[y, z])
        values = self.output.values_of(quantity)
        low, high = bounds(self.output, quantity, values)
        shown = Output(self.output.snapshot, self.output.view.with_ranges({quantity.label: (low, high)}))
        panels: List[Any] = []
        for cell, axes, cut in ((grid[0, 0], [0, 1], 2), (grid[1, 0], [0, 2], 1), (grid[0, 1], [2, 1], 0)):
            panel = part.add_subplot(cell)
            drawn = _plane(panel, shown, quantity, axes, {cut: middle[cut]})
            outlines(panel, shown, axes, {cut: middle[cut]})
            panel.set_title(f"{'xyz'[cut]} = {middle[cut]:.4g} m", fontsize=10, loc="left")
            panels.append(panel)
        self._bar(part, drawn, quantity, panels)
        self.notes.append(f"{quantity.label}: three planes; --slice selects another plane, and with pyvista "
                          "installed there is a three-dimensional view")


def _beyond(drawn: Any) -> str:
    """The ends of the colour bar beyond which there are values."""
    values = drawn.get_array()
    if values is None or not np.size(values):
        return "neither"
    (low, high), known = drawn.get_clim(), np.ma.masked_invalid(values)
    below, above = bool(known.min() < low), bool(known.max() > high)
    return {(True, True): "both", (True, False): "min", (False, True): "max"}.get((below, above), "neither")


def _plane(panel: Any, output: Output, quantity: Quantity, axes: List[int], cut: Any) -> Any:
    """A slice with swapped axes: z is horizontal instead of x."""
    if quantity.variable.centring == "particle":
        long = [high - low for low, high in map(output.extent, range(3))]
        return cloud(panel, output, quantity, axes, 72 * SIDE * long[axes[0]] / max(long), cut)
    drawn = image(panel, output, quantity, sorted(axes), cut)
    if axes != sorted(axes):
        drawn.set_data(output.field(quantity, output.owners(quantity)[0], slices=cut).T)
        left, right, low, high = drawn.get_extent()
        drawn.set_extent((low, high, left, right))
        panel.set_xlim(output.extent(axes[0]))
        panel.set_ylim(output.extent(axes[1]))
        panel.set_xlabel(f"{'xyz'[axes[0]]} [m]")
        panel.set_ylabel(f"{'xyz'[axes[1]]} [m]")
    return drawn




__all__ = ["COLOURS", "STYLE", "Figure", "words"]
