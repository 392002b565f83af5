"""The figures of a study: error against cell width, error against run time, where the time went."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from tushar.figure import COLOURS, STYLE

MARKERS = "osD^vP"


def lines_of(rows):
    """Method -> its rows that lived, widest cells first."""
    lines = {}
    for row in rows:
        if "died" not in row:
            lines.setdefault(row["method"], []).append(row)
    return {name: sorted(line, key=lambda row: -row["h"]) for name, line in lines.items()}


def draw(rows, error, folder):
    """Writes error_h, error_time and where_the_time_went as PNG and SVG; the names of the PNGs."""
    lines = lines_of(rows)
    if not lines:
        return []
    with plt.rc_context(STYLE):
        figures = {"error_h": _against(lines, "h", "cell width h [m]", error),
                   "error_time": _against(lines, "seconds", "time loop [s]", error),
                   "where_the_time_went": _time_by_task(lines)}
        for name, figure in figures.items():
            for ending in ("png", "svg"):
                figure.savefig(folder / f"{name}.{ending}")
            plt.close(figure)
    return [f"{name}.png" for name in figures]


def _against(lines, column, label, error):
    figure, axes = plt.subplots(figsize=(6, 4.6), layout="constrained")
    for number, (name, line) in enumerate(lines.items()):
        axes.loglog([row[column] for row in line], [row["error"] for row in line], color=COLOURS[number % len(COLOURS)],
                    marker=MARKERS[number % len(MARKERS)], markersize=5, linewidth=1.4, label=name)
    if column == "h":
        for order in (1, 2):
            _order_triangle(axes, lines, order)
    axes.set_xlabel(label)
    axes.set_ylabel("error, " + error.replace(".", " "))
    axes.grid(True, which="minor", linewidth=0.3)
    axes.legend()
    return figure


def _order_triangle(axes, lines, order):
    """A triangle of that slope below the finest two points of the best line."""
    best = min((line for line in lines.values() if len(line) > 1), key=lambda line: line[-1]["error"], default=None)
    if best is None:
        return
    right, left = best[-2]["h"], best[-1]["h"]
    top = best[-1]["error"] * (0.75 if order == 1 else 0.2)
    bottom = top * (left / right) ** order
    axes.plot([left, right, right, left], [bottom, bottom, top, bottom], color="#718096", linewidth=0.8)
    axes.annotate(str(order), (right, (top * bottom) ** 0.5), textcoords="offset points", xytext=(4, -3), fontsize=8,
                  color="#718096")


def _time_by_task(lines):
    """A bar a method, at its finest cells: share of each task in the time loop."""
    figure, axes = plt.subplots(figsize=(7.5, 1.6 + 0.5 * len(lines)), layout="constrained")
    names = list(dict.fromkeys(task for line in lines.values() for task in line[-1]["tasks"]))
    colours = plt.get_cmap("tab20").colors
    for at, (method, line) in enumerate(lines.items()):
        row, left = line[-1], 0.0
        for task, seconds in row["tasks"].items():
            share = 100 * seconds / row["seconds"]
            axes.barh(at, share, left=left, color=colours[names.index(task) % 20],
                      label=task if task not in axes.get_legend_handles_labels()[1] else None)
            left += share
        axes.barh(at, max(0.0, 100 - left), left=left, color="#e2e8f0")
    axes.set_yticks(range(len(lines)), [f"{name}, h = {line[-1]['h']:g}" for name, line in lines.items()])
    axes.set_xlabel("share of the time loop [%]")
    axes.grid(False)
    axes.legend(loc="upper center", bbox_to_anchor=(0.4, -0.25 - 0.25 / len(lines)), ncols=3, fontsize=7)
    return figure
