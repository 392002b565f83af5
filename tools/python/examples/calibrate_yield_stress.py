#!/usr/bin/env python3
"""Finds the yield stress with which the final length of a Taylor bar equals the measured one.

    python3 calibrate_yield_stress.py                       the bar of ups/solid/taylor_bar.ups, 21.43 mm at the end
    python3 calibrate_yield_stress.py --length 23e-3        one that was measured longer
    python3 calibrate_yield_stress.py --cells 24,84         the scene's own resolution

Bars are longer at the end on coarse grids, so the fitted yield stress depends on the resolution: calibrate with the
resolution that you use.
"""
import argparse

from scipy.optimize import brentq

import tushar

SCENE = "ups/solid/taylor_bar.ups"
YIELD_STRESS = "MaterialProperties/MPM/material/constitutive_model/flow_model/sigma_Y"


def final_length(yield_stress, cells):
    """Length of the bar at the end of the run [m]: to its topmost particles, plus half of their spacing."""
    run = tushar.run(SCENE, {YIELD_STRESS: yield_stress, "Grid/Level/Box/resolution": [*cells, 1],
                             "DataArchiver/outputInterval": 1})
    last = run.archive[-1]
    return last["p.x"][:, 1].max() + last.grid.spacing[1] / 4  # two particles per cell


def calibrate(length, cells, lowest=200e6, highest=800e6, accuracy=1e6):
    """Finds the yield stress [Pa] between two bounds; prints each attempt. Raises ValueError if none of them gives that
    length [m]."""
    def excess(yield_stress):
        found = final_length(yield_stress, cells)
        print(f"{yield_stress / 1e6:7.1f} MPa: {found * 1e3:6.2f} mm", flush=True)
        return found - length

    return brentq(excess, lowest, highest, xtol=accuracy)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--length", type=float, default=21.43e-3, metavar="L", help="measured final length [m]")
    parser.add_argument("--cells", default="12,42", metavar="NX,NY", help="of the grid (12,42)")
    options = parser.parse_args()
    cells = [int(count) for count in options.cells.split(",")]
    print(f"yield stress: {calibrate(options.length, cells) / 1e6:.0f} MPa")


if __name__ == "__main__":
    main()
