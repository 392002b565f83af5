#!/usr/bin/env python3
"""Draws the stress path of a particle during a run: von Mises stress against pressure.

    python3 stress_path.py crushed_sandstone.uda path.png       of a run that saved p.stress
"""
import argparse

import numpy as np

import tushar


def invariants(stress):
    """Pressure and von Mises stress [Pa] of a stress tensor (3, 3) [Pa]."""
    pressure = -np.trace(stress) / 3
    deviator = stress + pressure * np.eye(3)
    return pressure, np.sqrt(1.5 * np.sum(deviator**2))


def stress_path(archive, particle=0):
    """Times [s], pressures and von Mises stresses [Pa] of a particle given by its index in the first output."""
    path = [invariants(np.reshape(output["p.stress"][particle], (3, 3))) for output in archive[:]]
    return np.array(archive.times), *np.transpose(path)


def draw(archive, file):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    times, pressure, mises = stress_path(archive)
    figure, axes = pyplot.subplots(figsize=(5.5, 3.6), layout="constrained")
    axes.plot(pressure / 1e6, mises / 1e6, color="0.7", zorder=1)
    points = axes.scatter(pressure / 1e6, mises / 1e6, c=times * 1e3, s=10, zorder=2)
    figure.colorbar(points, label="time [ms]")
    axes.set(xlabel="pressure [MPa]", ylabel="von Mises' stress [MPa]", title=archive.title)
    figure.savefig(file, dpi=110)


if __name__ == "__main__":
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("archive")
    arguments.add_argument("picture")
    given = arguments.parse_args()
    draw(tushar.open(given.archive), given.picture)
