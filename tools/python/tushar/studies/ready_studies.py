"""The predefined studies, selected by name."""
from tushar.studies.study import Method

CONSERVING = "MPM/conserving_gas_dynamics"
SECOND_ORDER = (f"{CONSERVING}/transfer=affine_flip",)


def remapped(every):
    return (f"{CONSERVING}/remap/every={every}",)


def limited(scene, *limiters):
    """One line of the figures for each limiter of the finite volumes."""
    names = {"minmod": "minmod", "van_leer": "van Leer", "mc": "MC"}
    return [Method(f"MUSCL {names[limiter]}", scene, (f"Euler/limiter={limiter}",)) for limiter in limiters]


SOD = [Method("paper", "ups/mpm/sod.ups"),
       Method("paper, tracked volume", "ups/mpm/sod.ups", ("MPM/gas_dynamics/volume_model=tracked",)),
       Method("conserving apic", "ups/mpm/sod_conserving.ups"),
       Method("conserving apic, remapped every 5", "ups/mpm/sod_conserving.ups", remapped(5)),
       Method("conserving affine_flip", "ups/mpm/sod_conserving.ups", SECOND_ORDER),
       Method("conserving affine_flip, remapped every 4", "ups/mpm/sod_conserving.ups", SECOND_ORDER + remapped(4)),
       Method("Godunov HLLC", "ups/euler/sod.ups", ("Euler/reconstruction=first_order",)),
       *limited("ups/euler/sod.ups", "minmod", "van_leer", "mc")]

SMOOTH = [*(Method(f"paper, {n} particles per cell", "ups/mpm/smooth_wave.ups",
                   (f"MaterialProperties/MPM/material/geom_object/res=[{n},1,1]",)) for n in (4, 8)),
          Method("conserving apic, remapped every 4", "ups/mpm/smooth_wave_conserving.ups",
                 (f"{CONSERVING}/transfer=apic",)),
          Method("conserving affine_flip, remapped every 4", "ups/mpm/smooth_wave_conserving.ups"),
          Method("conserving affine_flip, remapped every step", "ups/mpm/smooth_wave_conserving.ups", remapped(1)),
          *limited("ups/euler/smooth_wave.ups", "minmod", "van_leer", "mc")]


def both(name):
    """Methods for a scene that both the conserving method and finite volumes support."""
    return [Method("conserving apic, remapped every 5", f"ups/mpm/{name}.ups",
                   (f"{CONSERVING}/transfer=apic", *remapped(5))),
            *(Method(f"conserving affine_flip, remapped every {'step' if n == 1 else n}", f"ups/mpm/{name}.ups",
                     SECOND_ORDER + remapped(n)) for n in (4, 1)),
            *limited(f"ups/euler/{name}.ups", "minmod", "van_leer", "mc")]


def shapes(scene):
    """One line for each shape function of solids, and for the transfers with GIMP."""
    by_shape = {"linear": "linear", "gimp": "GIMP", "cpdi": "CPDI", "3rdorderBS": "quadratic B-splines",
                "4thorderBS": "cubic B-splines"}
    lines = [Method(name, scene, (f"MPM/interpolator={word}",)) for word, name in by_shape.items()]
    transfers = {"GIMP, XPIC2": "MPM/XPIC2=true", "GIMP, APIC": "MPM/apic=true", "GIMP, MUSL": "MPM/stress_update=musl",
                 "GIMP, USF": "MPM/stress_update=usf"}
    return lines + [Method(name, scene, (setting,)) for name, setting in transfers.items()]


IMPLICIT_HEAT = ("SimulationComponent/@type=implicit_heat",)
STATIC = ("MPM/time_integrator=implicit", "MPM/dynamic=false", "Time/timestep_multiplier=1")
SPARSE = ("MPM/Solver/solver=direct", "MPM/Solver/preconditioner=lu")


def at_rest(scene, *sets):
    """Explicit steps, which are the reference, and implicit steps without inertia."""
    return [Method("explicit", scene, sets, is_varied=False),
            Method("implicit, LU", scene, (*sets, *STATIC, *SPARSE)),
            Method("implicit, GMRES with GAMG", scene, (*sets, *STATIC))]


def refined(name, *blocks):
    """A uniform grid, and several levels with blocks of a given size."""
    return [Method("uniform", f"ups/euler/{name}.ups"),
            *(Method(f"levels, blocks of {n} x {n}", f"ups/euler/{name}_levels.ups",
                     (f"AMR/Regridder/min_patch_size=[[{n},{n},1]]",)) for n in blocks)]


def pushed(name):
    """A body that gas pushes, with gas of second and of first order, and with explicit steps of half the length."""
    scene = f"ups/fsi/{name}.ups"
    return [Method("second order", scene), Method("second order, cfl .2", scene, ("CFD/cfl=0.2",)),
            Method("first order", scene, ("CFD/ICE/advection/@type=FirstOrder",))]


# name -> (methods, what is varied, the error)
READY = {
    "sod": (SOD, {"resolution": ["100", "200", "400", "800"]}, "density.cell.L1"),
    "smooth": (SMOOTH, {"resolution": ["50", "100", "200", "400", "800"]}, "density.cell.L1"),
    "vortex": (both("vortex"), {"resolution": ["32", "64", "128"]}, "density.cell.L1"),
    "vortex_3d": (both("vortex_3d"), {"resolution": ["16", "32", "64"]}, "density.cell.L1"),
    "gresho": (both("gresho"), {"resolution": ["40", "80", "160"]}, "velocity.cell.L1"),
    "noh": (both("noh"), {"resolution": ["50", "100", "200"]}, "density.cell.L1"),
    "solid_vortex": (shapes("ups/solid/generalized_vortex.ups"), {"resolution": ["24", "48", "96", "192"]},
                     "displacement.particle.L1"),
    "solid_ring": (shapes("ups/solid/expanding_ring.ups"), {"resolution": ["16", "32", "64", "128"]},
                   "displacement.particle.L1"),
    "solid_cube": (shapes("ups/solid/axis_aligned.ups"), {"resolution": ["4", "8", "16", "32"]},
                   "displacement.particle.L1"),
    "heat_implicit": ([Method("backward Euler", "ups/heat/sine.ups", IMPLICIT_HEAT),
                       Method("Crank-Nicolson", "ups/heat/sine.ups",
                              (*IMPLICIT_HEAT, "Heat/time_integrator=crank_nicolson")),
                       Method("explicit", "ups/heat/sine.ups")],
                      {"dt": ["1e-1", "1e-2", "1e-3", "1e-4", "1e-5"]}, "temperature.cell.L1"),
    "rest_cylinder": (at_rest("ups/solid/thick_cylinder.ups", "MPM/artificial_damping_coeff=6000"),
                      {"dt": ["1e-2", "1e-3", "1e-4", "1e-5"]}, "change.StrainEnergy"),
    "rest_cantilever": (at_rest("ups/solid/cantilever.ups", "MPM/interpolator=gimp",
                                "PhysicalConstants/gravity=[0,-0.1,0]",
                                "Time/maxTime=30"),
                        {"dt": ["10", "1", "1e-1", "1e-2"]}, "change.CenterOfMassPosition[1]"),
    "rest_billet": (at_rest("ups/solid/billet.ups", "MPM/artificial_viscosity=false",
                            "DataArchiver/save[3]/@label=TotalMass", "Time/maxTime=2.5e-5"),
                    {"dt": ["1e-5", "1e-6", "1e-7", "1e-8"]},
                    "change.CenterOfMassPosition"),
    "levels": (refined("lax_liu_3", 8, 16), {"finest": ["64", "128", "256", "512"]}, "density.cell.L1"),
    # The change of the sum of mass times position of the body [kg m], against its exact value.
    "gun": (pushed("gun"), {"resolution": ["75", "150", "300", "600"]}, "last.CenterOfMassPosition[0]=0.70748862"),
    "plug": (pushed("plug"), {"resolution": ["50", "100", "200", "400"]}, "last.CenterOfMassPosition[0]=0.06685995"),
    "plug_of_gases": (pushed("plug_of_gases"), {"resolution": ["50", "100", "200", "400"]},
                      "last.CenterOfMassPosition[0]=0.04724319"),
    "sod_plate": (pushed("sod_plate"), {"resolution": ["103", "206", "412"]},
                  "last.CenterOfMassPosition[0]=0.0045543"),
    # The force of the gas on a piston [N]: the difference of the pressures behind a shock or a slow change and ahead.
    "moving_piston": (pushed("moving_piston"), {"resolution": ["75", "150", "300", "600"]},
                      "end.GasForceOnBodies[0]=-3.26295133"),
    "slow_piston": ([Method("implicit", "ups/fsi/slow_piston.ups")], {"resolution": ["55", "110", "220"]},
                    "end.GasForceOnBodies[0]=-1.42016593"),
    "burning_slab": (pushed("burning_slab"), {"resolution": ["25", "50", "100"]}, "last.BurntMass=2"),
    "heat": ([Method("explicit", "ups/heat/sine.ups")], {"resolution": ["16", "32", "64", "128"]},
             "temperature.cell.L1"),
}
