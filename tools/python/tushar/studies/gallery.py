"""The gallery of hard cases: the cases, their methods, and the error bounds of the default method."""
import dataclasses

from tushar.studies import scene_variants
from tushar.program import ROOT

FOLDER = ROOT / "ups/stability"
CONSERVING = "MPM/conserving_gas_dynamics"
BOTH = ("mass", "energy")


@dataclasses.dataclass(frozen=True)
class Case:
    """A scene of the gallery."""
    name: str
    most: float | None = None  # of the error, for the default method at its default settings
    error: str = "density.cell.relative"  # path of the error in the report; '' for none
    keeps: tuple = BOTH  # what must not drift
    entropy: bool = False  # whether it must not fall: shocks raise it, and nothing outside takes heat from the gas
    long: bool = False  # left out of the short gallery
    scene: str = ""  # if it is not of that name
    sets: tuple = ()
    only: tuple = ()  # the methods that can run it, if not all
    fails: str = ""  # what it says in the end, for one that cannot be run

    def path(self):
        return FOLDER / f"{self.scene or self.name}.ups"


@dataclasses.dataclass(frozen=True)
class Method:
    """A way to run a case: overrides for the scene, after `change` has rewritten it."""
    name: str
    sets: tuple = ()
    change: object = None

    def runs(self, case):
        return self.name in case.only if case.only else True


PARTICLES = ("default", "affine_flip", "paper", "paper_tracked")
METHODS = {method.name: method for method in (
    Method("default"),
    Method("affine_flip", (f"{CONSERVING}/transfer=affine_flip", f"{CONSERVING}/remap/every=4")),
    Method("paper", change=scene_variants.paper),
    Method("paper_tracked", ("MPM/gas_dynamics/volume_model=tracked",), scene_variants.paper),
    Method("volumes", change=scene_variants.finite_volumes))}


def relaxation(rate):
    limit = dict(most=0.01) if rate >= 1e6 else dict(error="")
    return Case(f"relaxation_{rate:g}", scene="relaxation", keeps=("mass",), only=PARTICLES,
                sets=(f"MaterialProperties/MPM/material/relaxation/rate={rate:g}",), **limit)


CASES = [
    Case("sod", .0055, entropy=True), Case("toro_1", .0070, entropy=True), Case("toro_2", .017, entropy=True),
    Case("toro_3", .030, entropy=True), Case("toro_4", .024, entropy=True), Case("toro_5", .062, entropy=True),
    Case("lax", .0085, entropy=True), Case("leblanc", .0082, entropy=True),
    Case("vacuum", .0047), Case("double_vacuum", .05),
    Case("pressure_1e5", .030, entropy=True), Case("pressure_1e10", .030, entropy=True),
    Case("ratio_1e6", .0044), Case("density_1e6", .01),
    Case("gamma_1_01", .0072, entropy=True), Case("gamma_5_3", .0055, entropy=True),
    Case("gamma_7", .0018, entropy=True),
    Case("water_shock", .0045, entropy=True, only=("default", "affine_flip", "volumes")),
    Case("water_air", .0040, only=("default",)), Case("air_bubble", error="", only=("default",)),
    Case("noh", .061, entropy=True), Case("noh_2d", entropy=True, long=True), Case("sedov", long=True),
    Case("blast_waves"), Case("shu_osher"), Case("box", .0068, error="density.cell.L1", entropy=True, long=True),
    Case("contact", 1e-13, error="velocity.particle.max"), Case("contact_slow", 1e-4),
    Case("sod_moving", .0052, keeps=()), Case("on_faces", error=""), Case("one_cell", 1e-14),
    Case("many_steps", long=True), Case("random", only=("paper", "paper_tracked")),
    *(relaxation(rate) for rate in (1, 1e3, 1e6, 1e9)),
    *(Case(name, error="", keeps=(), only=("default",))
      for name in ("stiff_steel", "stiff_incompressible", "stiff_contrast", "nearly_empty")),
    Case("softening", error="", keeps=(), only=("default",), fails="Newton's method did not converge"),
    Case("heat_ratio", 1e-5, error="temperature.cell.L1", keeps=(), only=("default",))]
