#!/usr/bin/env python3
"""Draws the traction across cohesive zones against their separation, with the law of the scene.

    python3 traction_separation.py glued_blocks.uda picture.png

The runs must have saved cz.area, cz.norm, cz.force and cz.separation.
"""
import argparse
import pathlib
import xml.etree.ElementTree as ElementTree

import numpy as np

import tushar


def along_and_across(vectors, normals):
    """The components of vectors (zones, axes) along the normals, and the lengths of the rest."""
    along = np.sum(vectors * normals, axis=1)
    return along, np.linalg.norm(vectors - along[:, None] * normals, axis=1)


def tractions(archive):
    """Jumps [m] and tractions [Pa] of all zones in all outputs: along the normal and across it, four arrays."""
    rows = []
    for output in archive[:]:
        area, normal, force, jump = (output[f"p.cz{name}"][:] for name in ("Area", "Norm", "Force", "Separation"))
        rows.append((*along_and_across(jump, normal), *along_and_across(force / area[:, None], normal)))
    return [np.concatenate(column) for column in zip(*rows)]


def law(archive):
    """The traction in modes I and II, as functions of the jump [m] (Xu & Needleman 1994)."""
    tag = ElementTree.parse(pathlib.Path(archive.folder, "input.xml")).getroot().find(".//cohesive_zone")
    sigma, tau = (float(tag.findtext(name)) for name in ("sig_max", "tau_max"))
    normal, tangential = (float(tag.findtext(name)) for name in ("delta_n", "delta_t"))
    return (lambda d: sigma * d / normal * np.exp(1 - d / normal),
            lambda d: tau * np.sqrt(2 * np.e) * d / tangential * np.exp(-(d / tangential) ** 2))


def draw(archives, file):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, 2, figsize=(7.5, 3.2), layout="constrained", sharey=True)
    for k, archive in enumerate(archives):
        jumps, stresses = tractions(archive)[:2], tractions(archive)[2:]
        for panel, jump, stress in zip(axes, jumps, stresses):
            if jump.max() > 0.1 * max(part.max() for part in jumps):
                panel.plot(1e3 * jump, stress, ".", color=f"C{k}")
    for panel, of_mode, name in zip(axes, law(archives[0]), ("opening", "sliding")):
        jumps = np.linspace(0, panel.get_xlim()[1] / 1e3, 300)
        panel.plot(1e3 * jumps, of_mode(jumps), color="0.6", zorder=0)
        panel.set(xlabel=f"{name} [mm]")
    axes[0].set(ylabel="traction [Pa]")
    figure.suptitle(archives[0].title)
    figure.savefig(file, dpi=110)


if __name__ == "__main__":
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("archives", nargs="+")
    arguments.add_argument("picture")
    given = arguments.parse_args()
    draw([tushar.open(path) for path in given.archives], given.picture)
