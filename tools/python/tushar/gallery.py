"""The gallery of hard cases: what is run, by which methods, and when a case counts as passed."""
import dataclasses

from tushar import scene_variants

FOLDER = "ups/stability"
DRIFT = 1e-11  # relative, of mass and energy, where a case keeps them


@dataclasses.dataclass(frozen=True)
class Case:
    """A scene of the gallery, and what the default method promises there."""
    name: str
    error: str = "density.cell.relative"  # path of the error in the report; '' for none
    most: float | None = None  # of that error
    keeps: tuple = ("mass", "energy")
    entropy: bool = False  # whether it must not fall: no wall, no open face does work on the gas
    long: bool = False  # left out unless asked for

    @property
    def scene(self):
        return f"{FOLDER}/{self.name}.ups"


@dataclasses.dataclass(frozen=True)
class Method:
    """A way to run a case: overrides for the scene, after `change` has rewritten it."""
    name: str
    sets: tuple = ()
    change: object = None
    isOurs: bool = False  # whether it promises anything


CONSERVING = "MPM/conserving_gas_dynamics"
METHODS = {method.name: method for method in (
    Method("default", isOurs=True),
    Method("affine_flip", (f"{CONSERVING}/transfer=affine_flip", f"{CONSERVING}/remap/every=4")),
    Method("paper", change=scene_variants.paper),
    Method("paper_tracked", ("MPM/gas_dynamics/volume_model=tracked",), scene_variants.paper),
    Method("volumes", change=scene_variants.finite_volumes))}
