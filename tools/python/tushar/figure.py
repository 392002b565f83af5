"""Draws an output of an archive: profiles along a line, images or point clouds."""
import re

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from tushar.uda import UdaError, check_name

# The classic four of a shock tube: label in the archive, column of the exact solution, name on the axis.
GAS = [("p.density", "density", "density"), ("p.velocity", "velocity", "velocity"),
       ("p.pressure", "pressure", "pressure"), ("p.internalEnergy", "energy", "specific internal energy")]
COLOURS = ["#2b6cb0", "#c05621", "#2f855a", "#6b46c1", "#b83280", "#2c7a7b"]
STYLE = {"font.family": "DejaVu Sans", "font.size": 10, "axes.spines.top": False, "axes.spines.right": False,
         "axes.edgecolor": "#4a5568", "axes.labelcolor": "#1a202c", "xtick.color": "#4a5568", "ytick.color": "#4a5568",
         "axes.grid": True, "grid.color": "#e2e8f0", "grid.linewidth": 0.8, "axes.axisbelow": True,
         "legend.frameon": False, "figure.dpi": 150, "svg.fonttype": "none", "figure.constrained_layout.w_pad": 0.12,
         "figure.constrained_layout.h_pad": 0.12, "figure.constrained_layout.wspace": 0.03,
         "figure.constrained_layout.hspace": 0.03}


def pretty_unit(unit):
    """`kg/m^3` -> `kg/m³`."""
    raised = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
    return re.sub(r"\^(-?\d+)", lambda power: power.group(1).translate(raised), unit)


def axis_label(name, unit):
    return f"{name} [{pretty_unit(unit)}]" if unit else name


def words(label):
    """`c.temperature` -> `temperature`, `p.internalEnergy` -> `internal energy`."""
    return re.sub(r"(?<=[a-z])([A-Z])", lambda letter: " " + letter.group(1).lower(), label.split(".")[-1])


class Figure:
    """One output of an archive as a figure. `notes` tells what could not be drawn. Raises UdaError if nothing can."""

    def __init__(self, uda, index=-1, variables=(), title=None):
        if not uda.times:
            raise UdaError(f"'{uda.folder}' has no outputs yet")
        self.uda, self.index = uda, index
        self.grid = uda.grid(index)
        self.notes = []
        labels = [check_name("variable", name, uda.variables) for name in variables] or self._choose()
        with plt.rc_context(STYLE):
            self._draw(labels, title or f"{uda.title},  t = {uda.times[index]:.4g} s")

    def save(self, path):
        """Writes PNG, SVG or PDF by the ending of the path."""
        with plt.rc_context(STYLE):
            self.figure.savefig(path)
        plt.close(self.figure)

    def _choose(self):
        """The labels to draw when none are named."""
        held = [name for name, count in self.uda.materials(self.index).items() if count]
        saved = [v for v in self.uda.variables.values() if v.centring == "particle" and v.name != "p.x"] if held else []
        names = [variable.name for variable in saved]
        gas = [label for label, _, _ in GAS if label in names]
        if gas:
            for label, _, name in GAS if self.grid.dimension == 1 else ():
                if label not in gas:
                    self.notes.append(f'no {name}: the scene does not save it; add <save label="{label}"/> to '
                                      f'DataArchiver')
            return gas if self.grid.dimension == 1 else gas[:1]
        fields = [v.name for v in self.uda.variables.values() if v.centring in ("cell", "node")]
        others = [v.name for v in saved if v.components == 1 and v.name != "p.particleID"] or names
        if not fields and not others:
            raise UdaError(f"'{self.uda.folder}' holds nothing to draw at this output")
        return (fields or others)[:4 if self.grid.dimension == 1 else 1]

    def _draw(self, labels, title):
        columns = 1 if len(labels) == 1 else 2
        rows = (len(labels) + columns - 1) // columns
        flat = self.grid.dimension > 1
        size = (7.2, 5.2) if len(labels) == 1 else (9.6, 0.6 + (3.8 if flat else 3.3) * rows)
        self.figure, panels = plt.subplots(rows, columns, figsize=size, squeeze=False, sharex=not flat,
                                           constrained_layout=True)
        panels = panels.ravel()
        for panel in panels[len(labels):]:
            panel.remove()
        for panel, label in zip(panels, labels):
            self._panel(panel, label)
        for panel in panels[max(0, len(labels) - columns):len(labels)] if not flat else ():
            panel.set_xlabel(f"{'xyz'[self.grid.axes[0]]} [m]")
            panel.tick_params(labelbottom=True)
        self.figure.suptitle(title, fontsize=12.5, fontweight="semibold", color="#1a202c")
        self._legend(panels[0])

    def _legend(self, panel):
        handles, names = panel.get_legend_handles_labels()
        if len(handles) > 1:
            panel.legend(handles, names, loc="best", handlelength=1.6, fontsize=9)

    def _panel(self, panel, label):
        variable = self.uda.variables[label]
        name = next((name for known, _, name in GAS if known == label), words(label))
        if self.grid.dimension == 1:
            self._profile(panel, variable)
            panel.set_ylabel(axis_label(name, variable.unit))
            panel.set_xlim(self._range(self.grid.axes[0]))
            widen(panel)
        elif variable.centring == "particle":
            self._cloud(panel, variable, name)
        else:
            self._image(panel, variable, name)

    def _along(self, variable, values):
        """The component along the line, or the magnitude in 2-D and 3-D."""
        if variable.components == 1:
            return values
        if variable.components == 3 and self.grid.dimension == 1:
            return values[..., self.grid.axes[0]]
        return np.linalg.norm(values, axis=-1)

    def _materials_with(self, variable):
        counts = self.uda.materials(self.index)
        return [name for name in counts if counts[name] and name in variable.materials]

    def _profile(self, panel, variable):
        if variable.centring == "particle":
            materials = self._materials_with(variable)
            for colour, material in zip(COLOURS * len(materials), materials):
                x = self.uda.particles("p.x", material, self.index)[:, self.grid.axes[0]]
                values = self._along(variable, self.uda.particles(variable.name, material, self.index))
                name = f"particles of {material}" if len(materials) > 1 else "particles"
                panel.plot(x, values, "o", color=colour, markersize=marker_size(len(x)), markeredgewidth=0, label=name)
        else:
            x = self.grid.coordinates(variable.centring)[self.grid.axes[0]]
            for colour, (material, values) in zip(COLOURS * 9, self._fields(variable)):
                panel.plot(x, self._along(variable, values).ravel(), "-o" if len(x) <= 200 else "-", color=colour,
                           markersize=3, linewidth=1.4, label=material or variable.centring + "s")
        self._exact(panel, variable.name)

    def _exact(self, panel, label):
        table = self.uda.reference(self.index)
        column = next((column for known, column, _ in GAS if known == label), words(label))
        if "x" in table and column in table:
            panel.plot(table["x"], table[column], "-", color="#1a202c", linewidth=1.2, label="exact")

    def _fields(self, variable):
        names = variable.materials or [None]
        return [(name, self.uda.field(variable.name, name, self.index)) for name in names]

    def _image(self, panel, variable, name):
        across, up = self.grid.axes[:2]
        fields = self._fields(variable)
        if len(fields) > 1:
            self.notes.append(f"{variable.name}: only that of {fields[0][0]}")
        values = self._along(variable, fields[0][1])
        if self.grid.dimension == 3:
            values = values[values.shape[0] // 2][None]
            self.notes.append(f"{variable.name}: the slice in the middle of z")
        values = values.reshape([count for axis, count in zip((2, 1, 0), values.shape) if axis in (across, up)])
        lower, upper = self.grid.lower, self.grid.lower + self.grid.spacing * self.grid.cells
        pad = self.grid.spacing / 2 if variable.centring == "node" else np.zeros(3)
        box = (lower[across] - pad[across], upper[across] + pad[across], lower[up] - pad[up], upper[up] + pad[up])
        drawn = panel.imshow(values, origin="lower", extent=box, cmap="viridis", interpolation="nearest",
                             aspect="equal")
        panel.set_xlim(self._range(across))
        panel.set_ylim(self._range(up))
        self._finish_map(panel, drawn, variable, name)

    def _cloud(self, panel, variable, name):
        x = np.concatenate([self.uda.particles("p.x", m, self.index) for m in self._materials_with(variable)])
        values = [self.uda.particles(variable.name, m, self.index) for m in self._materials_with(variable)]
        values = self._along(variable, np.concatenate(values))
        across, up = self.grid.axes[:2]
        if self.grid.dimension == 3:
            order = np.argsort(x[:, 2])
            x, values = x[order], values[order]
            self.notes.append(f"{variable.name}: seen along z")
        panel.set_aspect("equal")
        panel.set_xlim(self._range(across))
        panel.set_ylim(self._range(up))
        drawn = panel.scatter(x[:, across], x[:, up], c=values, s=self._point_area(x), cmap="viridis", linewidths=0,
                              rasterized=True)
        self._finish_map(panel, drawn, variable, name)

    def _point_area(self, x):
        """Area [pt^2] of points that just touch where the particles lie as dense as in the mean occupied cell."""
        axes = self.grid.axes[:2]
        cells = np.unique(np.floor((x - self.grid.lower) / self.grid.spacing)[:, axes], axis=0)
        area = np.prod(self.grid.spacing[axes]) * len(cells) / max(len(x), 1)
        points_per_metre = 290 / max(high - low for low, high in map(self._range, axes))
        return float(np.clip(area * points_per_metre ** 2, 0.2, 200))

    def _range(self, axis):
        return self.grid.lower[axis], self.grid.lower[axis] + self.grid.spacing[axis] * self.grid.cells[axis]

    def _finish_map(self, panel, drawn, variable, name):
        panel.grid(False)
        panel.set_xlabel(f"{'xyz'[self.grid.axes[0]]} [m]")
        panel.set_ylabel(f"{'xyz'[self.grid.axes[1]]} [m]")
        bar = self.figure.colorbar(drawn, ax=panel, shrink=0.9, pad=0.02)
        bar.set_label(axis_label(f"|{name}|" if variable.components > 1 else name, variable.unit))
        bar.outline.set_visible(False)


def marker_size(count):
    """Points small enough that `count` of them can be told apart."""
    return float(np.clip(80 / np.sqrt(max(count, 1)), 0.8, 5))


def widen(panel):
    """Keeps a constant from being drawn as its rounding errors."""
    low, high = panel.get_ylim()
    middle, least = (low + high) / 2, 1e-6 * max(abs(low), abs(high), 1e-12)
    if high - low < least:
        panel.set_ylim(middle - max(0.05 * abs(middle), least), middle + max(0.05 * abs(middle), least))
