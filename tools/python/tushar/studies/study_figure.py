"""The figures of a study: error against cell width, run time and, on several levels, cell updates; and the time of each
task."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from tushar.figure import COLOURS, STYLE

MARKERS = "osD^vP"


def lines_of(rows):
    """Method -> the rows of its successful runs, largest cells first."""
    lines = {}
    for row in rows:
        if "died" not in row:
            lines.setdefault(row["method"], []).append(row)
    return {name: sorted(line, key=lambda row: -row["h"]) for name, line in lines.items()}


def draw(rows, error, folder):
    """Writes error_h, error_time, where_the_time_went and, if a grid is refined, error_updates as PNG and SVG; the
    names of the PNGs."""
    lines = lines_of(rows)
    if not lines:
        return []
    with plt.rc_context(STYLE):
        figures = {"error_h": _against(lines, "h", "cell width h [m]", error),
                   "error_time": _against(lines, "seconds", "time loop [s]", error),
                   "where_the_time_went": _time_by_task(lines)}
        if any(row.get("is_refined") for row in rows):
            figures["error_updates"] = _side_by_side(lines, {"seconds": "time loop [s]", "updates": "cell updates"},
                                                     error)
        for name, figure in figures.items():
            for ending in ("png", "svg"):
                figure.savefig(folder / f"{name}.{ending}")
            plt.close(figure)
    return [f"{name}.png" for name in figures]


def _against(lines, column, label, error):
    tall = 4.3, 0.24 * ((len(lines) + 1) // 2)
    figure, (axes, key) = plt.subplots(2, 1, figsize=(6.6, sum(tall)), height_ratios=tall, layout="constrained")
    _draw_errors(axes, lines, column, label)
    if column == "h":
        for order in (1, 2):
            _order_triangle(axes, lines, order)
    axes.set_ylabel("error, " + error.replace(".", " "))
    _draw_key(key, axes)
    return figure


def _side_by_side(lines, labels, error):
    """The error against several columns, each with its label."""
    tall = 3.6, 0.24 * ((len(lines) + 2) // 3)
    figure = plt.figure(figsize=(5.2 * len(labels), sum(tall)), layout="constrained")
    parts = figure.add_gridspec(2, len(labels), height_ratios=tall)
    all_axes = [figure.add_subplot(parts[0, place]) for place in range(len(labels))]
    for axes, (column, label) in zip(all_axes, labels.items()):
        _draw_errors(axes, lines, column, label)
    all_axes[0].set_ylabel("error, " + error.replace(".", " "))
    _draw_key(figure.add_subplot(parts[1, :]), all_axes[0], 3)
    return figure


def _draw_errors(axes, lines, column, label):
    for number, (name, line) in enumerate(lines.items()):
        axes.loglog([row[column] for row in line], [row["error"] for row in line], color=COLOURS[number % len(COLOURS)],
                    marker=MARKERS[number % len(MARKERS)], linestyle="-" if number < len(COLOURS) else "--",
                    markersize=5,
                    linewidth=1.4, label=name)
    axes.set_xlabel(label)
    axes.grid(True, which="minor", linewidth=0.3)


def _draw_key(key, axes, columns=2):
    key.axis("off")
    key.legend(*axes.get_legend_handles_labels(), loc="center", ncols=columns, fontsize=8, handlelength=2.6)


def _order_triangle(axes, lines, order):
    """Draws a triangle with this slope below the finest two points of the best line."""
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
    """A stacked bar for each method and resolution: the time of each task per step and cell, labelled with the time of
    the time loop."""
    bars = [(method, row) for method, line in lines.items() for row in line]
    colours = _colours_of_tasks(bars)
    tall = 0.8 + 0.24 * len(bars) + 0.17 * len(lines), 0.3 + 0.16 * (len(colours) // 3 + 1)
    figure, (axes, key) = plt.subplots(2, 1, figsize=(9.6, sum(tall)), height_ratios=tall, layout="constrained")
    heights, at = [], 0.0
    for number, (method, row) in enumerate(bars):
        at += 1.7 if number and method != bars[number - 1][0] else 1.0
        heights.append(at)
        left = 0.0
        for task, seconds in row["tasks"].items():
            width = 1e9 * seconds / (row["steps"] * row["cells"])
            axes.barh(at, width, left=left, color=colours[task], height=0.85)
            left += width
        axes.annotate(f"{1e3 * row['seconds']:.3g} ms", (left, at), xytext=(4, 0), textcoords="offset points",
                      va="center",
                      fontsize=8)
    axes.set_yticks(heights, [_name_of_bar(method, row) for method, row in bars], fontsize=8)
    axes.invert_yaxis()
    axes.margins(x=0.1)
    axes.set_xlabel("time per step and cell [ns]; the label of each bar is the time of the whole time loop")
    axes.grid(False, axis="y")
    key.axis("off")
    key.legend([plt.Rectangle((0, 0), 1, 1, color=colour) for colour in colours.values()], colours, loc="center",
               ncols=3,
               fontsize=8)
    return figure


def _colours_of_tasks(bars):
    """Task -> colour, the same in all bars; grey for the remaining tasks."""
    names = [task for task in dict.fromkeys(task for _, row in bars for task in row["tasks"])
             if task != "between tasks"]
    palette = plt.get_cmap("tab20").colors + plt.get_cmap("tab20b").colors
    return {name: palette[number % len(palette)] for number, name in enumerate(names)} | {"between tasks": "#cbd5e0"}


def _name_of_bar(method, row):
    varied = [f"{name.split('/')[-1]} = {value}" for name, value in row["varied"].items()]
    return ", ".join([method, *varied])
