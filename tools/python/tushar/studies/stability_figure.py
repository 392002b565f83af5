"""The map of the gallery: one row for each case, one column for each method."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from tushar.figure import STYLE

COLOURS = {"pass": "#c6f6d5", "breaks a promise": "#fefcbf", "died": "#fed7d7"}


def kind(row):
    return row["verdict"][0] if row["verdict"][0] in COLOURS else "breaks a promise"


def draw(rows, path):
    """Draws the map: error and largest time-step factor of each case with each method."""
    cases = list(dict.fromkeys(row["case"] for row in rows))
    methods = list(dict.fromkeys(row["method"] for row in rows))
    with plt.rc_context(STYLE | {"axes.grid": False}):
        tall = 0.6 + 0.3 * len(cases), 0.3
        figure, (axes, key) = plt.subplots(2, 1, figsize=(3.2 + 1.5 * len(methods), sum(tall)), height_ratios=tall,
                                           layout="constrained")
        for row in rows:
            x, y = methods.index(row["method"]), cases.index(row["case"])
            axes.add_patch(plt.Rectangle((x, y), 1, 1, facecolor=COLOURS[kind(row)], edgecolor="white", linewidth=1.5))
            axes.text(x + 0.5, y + 0.5, _text(row), ha="center", va="center", fontsize=7.5)
        axes.set_xlim(0, len(methods))
        axes.set_ylim(len(cases), 0)
        axes.set_xticks([k + 0.5 for k in range(len(methods))], [name.replace("_", " ") for name in methods])
        axes.set_yticks([k + 0.5 for k in range(len(cases))], [name.replace("_", " ") for name in cases])
        axes.xaxis.tick_top()
        axes.tick_params(length=0)
        for side in axes.spines.values():
            side.set_visible(False)
        key.axis("off")
        key.legend([plt.Rectangle((0, 0), 1, 1, color=colour) for colour in COLOURS.values()], COLOURS, loc="center",
                   ncols=3, fontsize=8)
        figure.savefig(path)
        plt.close(figure)


def _text(row):
    if row["failure"]:
        return f"step {row['steps'] + 1}"
    factor = f"   x {row['largest_factor']:.2g}" if row.get("largest_factor") else ""
    return f"{row['error']:.2g}{factor}" if row.get("error") is not None else factor.strip() or "lives"
