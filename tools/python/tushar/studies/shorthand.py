"""Short names for the parameters that studies vary, for any component: resolution, finest, particles, cfl, dt."""
import math
import xml.etree.ElementTree as xml

from tushar.program import scene_path

CFL = ("MPM/gas_dynamics", "MPM/conserving_gas_dynamics", "Euler", "CFD", "Burgers", "Heat")


def root_of(scene):
    return xml.parse(scene_path(scene)).getroot()


def cells_of(scene):
    return [int(count) for count in root_of(scene).find("Grid/Level/Box/resolution").text.strip(" []").split(",")]


def resolution(scene, value):
    """Sets `N` cells along x, and along the other axes in the proportion of the scene; `[nx,ny,nz]` is used
    unchanged."""
    if not value.startswith("["):
        cells = cells_of(scene)
        value = "[" + ",".join(str(max(1, round(count * int(value) / cells[0]))) if count > 1 else "1"
                               for count in cells) + "]"
    return [f"Grid/Level/Box/resolution={value}"]


def finest(scene, value):
    """Sets the number of cells so that `N` of them would fill the grid along x: cells of the finest level for a scene
    with <AMR>, otherwise all cells."""
    if root_of(scene).find("AMR/Regridder") is None:
        return resolution(scene, value)
    levels = math.log2(int(value) / cells_of(scene)[0])
    if levels < 0 or not levels.is_integer():
        raise ValueError(f"{scene} has {cells_of(scene)[0]} cells along x, and the cells of each further level are "
                         "half as wide")
    return [f"AMR/Regridder/max_levels={int(levels) + 1}", f"AMR/Regridder/adaptive={'true' if levels else 'false'}"]


def particles(scene, value):
    """Sets `P` particles per cell, along each axis with more than one cell, in every body."""
    bodies = root_of(scene).findall("MaterialProperties/MPM/material/geom_object")
    each = "[" + ",".join(value if count > 1 else "1" for count in cells_of(scene)) + "]"
    return [f"MaterialProperties/MPM/material/geom_object[{number}]/res={each}" for number in range(1, len(bodies) + 1)]


def cfl(scene, value):
    """Sets a Courant number in the section of the scene's method; raises ValueError if there is no such section."""
    sections = [path for path in CFL if root_of(scene).find(path) is not None]
    if not sections:
        raise ValueError(f"{scene} has no section with a <cfl>, which would be one of {', '.join(CFL)}; "
                         "Time/timestep_multiplier scales the time steps of any scene")
    return [f"{path}/cfl={value}" for path in sections]


def dt(scene, value):
    """Sets time steps of this length [s], for a method that supports any length."""
    return [f"Time/delt_init={value}", f"Time/delt_max={value}"]


SHORT = {"resolution": resolution, "finest": finest, "particles": particles, "cfl": cfl, "dt": dt}
