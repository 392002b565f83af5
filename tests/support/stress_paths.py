#!/usr/bin/env python3
"""Draws the stress of each constitutive model along two prescribed deformations of a particle.

    SUS=build/release/sus python3 tests/support/stress_paths.py [--out PICTURE.png] [--only NAME,NAME]

Left in each pair: uniaxial strain, which compresses, releases, stretches and releases; right: simple shear, there and
back. A line of text for each model says what is left of the stress at the end, and the work that the cycle takes.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/python"))
from tushar.interpreter import ensure

ensure("h5py", "matplotlib")

import matplotlib
import numpy as np

import tushar
from sus import ROOT, SUS

STEPS = 800
# Uniaxial strain and shear at points in time, in units of the amplitude and of the duration.
CYCLE = ((0, 0), (.25, -1), (.5, 0), (.75, 1), (1, 0))
SHEAR = ((0, 0), (.5, 1), (1, 0))


class Case:
    """A model with the constants of a scene, and how far and how fast it is driven."""

    def __init__(self, tags, source, strain, shear, density, *, time=1, speed=5000, title=None, more=""):
        self.model = re.search(r'type="(\w+)"', tags)[1]
        self.tags, self.source, self.more = tags, source, more
        self.strain, self.shear, self.density, self.time, self.speed = strain, shear, density, time, speed
        self.title = title or self.model

    def path(self, kind):
        """The file of the deformation: F, and no rotation, at points in time."""
        points = CYCLE if kind == "uniaxial" else SHEAR
        def line(t, a):
            xx, xy = (1 + self.strain * a, 0) if kind == "uniaxial" else (1, self.shear * a)
            return f"{t * self.time!r} {xx!r} {xy!r} 0 0 1 0 0 0 1 0 0 0 0\n"
        return "".join(line(t, a) for t, a in (*points, (2, 0)))

    def scene(self):
        """The text of the scene. Cells are so wide that waves do not limit the time step."""
        h = self.speed * self.time / 100
        constants = "" if "<specific_heat>" in self.more else "<specific_heat>1000</specific_heat>"
        return f"""<?xml version="1.0"?>
<Uintah_specification>
  <Meta><title>{self.model}</title></Meta>
  <SimulationComponent type="mpm"/>
  <Time><maxTime>{self.time}</maxTime><delt_max>{self.time / STEPS}</delt_max>
    <timestep_multiplier>0.5</timestep_multiplier></Time>
  <MPM>
    <time_integrator>explicit</time_integrator><interpolator>linear</interpolator>
    <UsePrescribedDeformation>true</UsePrescribedDeformation>
    <PrescribedDeformationFile>path.inp</PrescribedDeformationFile>
    <minimum_subcycles_for_F>-4</minimum_subcycles_for_F>
  </MPM>
  <PhysicalConstants><gravity>[0,0,0]</gravity></PhysicalConstants>
  <MaterialProperties><MPM>
    <material name="sample">
      <density>{self.density}</density><thermal_conductivity>0</thermal_conductivity>{constants}{self.more}
      <constitutive_model {self.tags}</constitutive_model>
      <geom_object>
        <box label="sample"><min>[0,0,0]</min><max>[{h},{h},{h}]</max></box>
        <res>[1,1,1]</res><velocity>[0,0,0]</velocity><temperature>300</temperature><color>0</color>
      </geom_object>
    </material>
  </MPM></MaterialProperties>
  <Grid><BoundaryConditions/><Level><Box label="0">
    <lower>[{-2 * h},{-2 * h},{-2 * h}]</lower><upper>[{3 * h},{3 * h},{3 * h}]</upper>
    <resolution>[5,5,5]</resolution><patches>[1,1,1]</patches>
  </Box></Level></Grid>
  <DataArchiver>
    <filebase>path.uda</filebase><outputTimestepInterval>8</outputTimestepInterval>
    <save label="p.stress"/><save label="p.deformationMeasure"/>
  </DataArchiver>
</Uintah_specification>
"""

    def run(self, kind):
        """Strains (or shears) and stress tensors [Pa] along a path."""
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "path.inp").write_text(self.path(kind))
            scene = pathlib.Path(folder, "scene.ups")
            scene.write_text(self.scene())
            subprocess.run([SUS, scene, "--quiet", "--nthreads", "1", "--output", folder], cwd=ROOT, check=True)
            archive = tushar.open(str(next(pathlib.Path(folder).glob("*.uda.*"))))
            found = [(np.eye(3), np.zeros((3, 3)))]  # the start, of which there is no output
            for output in archive[:]:
                found.append(tuple(np.reshape(output[name][0], (3, 3))
                                   for name in ("p.deformationMeasure", "p.stress")))
        f, stress = (np.array(values) for values in zip(*found))
        return (f[:, 0, 0] - 1 if kind == "uniaxial" else f[:, 0, 1]), stress


def work(strain, stress):
    """The work of a closed cycle per volume [J/m^3], for a nominal stress [Pa]."""
    return float(np.sum(.5 * (stress[1:] + stress[:-1]) * np.diff(strain)))


ARENISCA = """<PEAKI1>612.3724</PEAKI1><FSLOPE>0.057735026919</FSLOPE><B0>10000</B0><G0>3750</G0>
<p0_crush_curve>-1837.0724</p0_crush_curve><p1_crush_curve>6.666667e-4</p1_crush_curve>
<p3_crush_curve>0.5</p3_crush_curve><fluid_B0>0</fluid_B0><fluid_pressure_initial>0</fluid_pressure_initial>"""
ARENISCA_3 = ARENISCA + """<STREN>0</STREN><YSLOPE>0</YSLOPE><BETA_nonassociativity>1</BETA_nonassociativity>
<B1>0</B1><B2>0</B2><B3>0</B3><B4>0</B4><G1>0</G1><G2>0</G2><CR>0.5</CR>"""
COPPER = """<shear_modulus>46e9</shear_modulus><bulk_modulus>129e9</bulk_modulus>
<initial_material_temperature>300</initial_material_temperature>
<equation_of_state type="mie_gruneisen"><C_0>3940</C_0><Gamma_0>2.02</Gamma_0><S_alpha>1.489</S_alpha>
</equation_of_state>"""
COPPER_CONSTANTS = "<specific_heat>414</specific_heat><melt_temp>1356</melt_temp><room_temp>294</room_temp>"
STEEL = "<specific_heat>477</specific_heat><melt_temp>1793</melt_temp><room_temp>298</room_temp>"
ALUMINIUM = """<specific_heat>896</specific_heat><melt_temp>925</melt_temp><room_temp>294</room_temp>
<erosion algorithm="ZeroStress"/><damage_model type="johnson_cook"><D1>-0.77</D1><D2>1.45</D2><D3>-0.47</D3>
<D4>0</D4><D5>1.6</D5></damage_model>"""
LIGAMENT = """<bulk_modulus>467</bulk_modulus><c1>1.44</c1><c2>1</c2><c3>0.57</c3><c4>48</c4><c5>467</c5>
<fiber_stretch>1.062</fiber_stretch><direction_of_symm>[1,0,0]</direction_of_symm>"""
RELAXING = """<bulk_modulus>1e4</bulk_modulus><c1>10</c1><c2>10</c2><c3>0.7</c3><c4>10</c4><c5>1900</c5>
<fiber_stretch>1.6</fiber_stretch><direction_of_symm>[1,0,0]</direction_of_symm>
<y1>1</y1><y2>1</y2><y3>1</y3><y4>1</y4><y5>1</y5><y6>0</y6>
<t1>0.01</t1><t2>0.1</t2><t3>1</t3><t4>10</t4><t5>100</t5><t6>0</t6>"""
SCRAM = """<PR>0.3</PR><CrackParameterA>1e-3</CrackParameterA><CrackPowerValue>10</CrackPowerValue>
<CrackMaxGrowthRate>300</CrackMaxGrowthRate><StressIntensityF>500</StressIntensityF><CrackFriction>0.35</CrackFriction>
<InitialCrackRadius>3e-5</InitialCrackRadius><CrackGrowthRate>12</CrackGrowthRate>
<G1>3.5e8</G1><G2>1.739e8</G2><G3>5.212e8</G3><G4>9.085e8</G4><G5>6.875e8</G5>
<RTau1>0</RTau1><RTau2>7.32e3</RTau2><RTau3>7.32e4</RTau3><RTau4>7.32e5</RTau4><RTau5>2e6</RTau5><Gamma>1</Gamma>"""
TABLE = """<variable_properties><entry><color>0</color><bulk_modulus>3.2e6</bulk_modulus>
<shear_modulus>1.2e6</shear_modulus><yield_stress>1e3</yield_stress><hardening_modulus>1e3</hardening_modulus></entry>
</variable_properties>"""
THRESHOLDS = """<erosion algorithm="ZeroStress"/><damage_model type="ThresholdVar"><variable_properties>
<entry><color>0</color><mean>7e4</mean><std>7e3</std></entry></variable_properties>
<failure_distrib>constant</failure_distrib><failure_criteria>MaximumPrincipalStress</failure_criteria></damage_model>"""
BRITTLE = """<damage_model type="Brittle"><brittle_damage_initial_threshold>57</brittle_damage_initial_threshold>
<brittle_damage_fracture_energy>11.2</brittle_damage_fracture_energy>
<brittle_damage_constant_D>0.1</brittle_damage_constant_D>
<brittle_damage_max_damage_increment>0.1</brittle_damage_max_damage_increment></damage_model>"""
WET = """<Usetransition>1</Usetransition><A1>0.15</A1><B1>1</B1><W>1</W><strain_ref>1</strain_ref><St>1</St>
<UseWaterRetention>1</UseWaterRetention><WR_Param1>0.019434</WR_Param1><WR_Param2>201.8975</WR_Param2>
<WR_Param3>0.000363389</WR_Param3><PhiB>12</PhiB><suction>3500</suction><SpecVol>1.917</SpecVol>"""

# The names of scenes are those of Uintah, unless a folder of this repository stands before them.
CASES = (
    Case('type="comp_neo_hook"><bulk_modulus>2000</bulk_modulus><shear_modulus>1500</shear_modulus>',
         "const_test_nh", .3, .5, 1000, speed=2),
    Case('type="cnh_mms"><bulk_modulus>8333</bulk_modulus><shear_modulus>3846</shear_modulus>',
         "AA", .3, .5, 1, speed=120),
    Case('type="comp_mooney_rivlin"><he_constant_1>1e5</he_constant_1><he_constant_2>2e4</he_constant_2>'
         '<he_PR>0.49</he_PR>', "const_test_cmr", .2, .5, 1000, speed=120),
    Case('type="ArrudaBoyce8"><bulk_modulus>35000</bulk_modulus><shear_modulus>7.5</shear_modulus><beta>1.67</beta>',
         "dwInclude20x20AB", .1, 2, 1.13e6, speed=1),
    Case('type="hypo_elastic"><G>12e6</G><K>32e6</K>', "const_test_hypo", .3, .5, 1e9, speed=1),
    Case(f'type="trans_iso_hyper">{LIGAMENT}', "const_test_tih, fibres along x", .1, .5, 1000, speed=2),
    Case(f'type="trans_iso_hyper">{LIGAMENT}<failure_option>1</failure_option><max_fiber_strain>1.08'
         '</max_fiber_strain><max_matrix_strain>0.2</max_matrix_strain>',
         "const_test_tih, limits of strain added", .1, .5, 1000, speed=2, title="trans_iso_hyper, failing"),
    Case(f'type="visco_trans_iso_hyper">{RELAXING}', "exp_vtih_biaxial, fibres along x", .1, .5, 1000, time=4,
         speed=10),
    Case('type="mw_visco_elastic"><e_shear_modulus>6e3</e_shear_modulus><e_bulk_modulus>16e3</e_bulk_modulus>'
         '<ve_shear_modulus>1e7</ve_shear_modulus><ve_bulk_modulus>1e7</ve_bulk_modulus>'
         '<ve_volumetric_viscosity>1e15</ve_volumetric_viscosity><ve_deviatoric_viscosity>1e6'
         '</ve_deviatoric_viscosity>', "const_test_mwve", .05, .2, 1000, time=.5, speed=200),
    Case(f'type="visco_scram">{SCRAM}', "const_test_vs", .004, .02, 1828, time=1e-4),
    Case('type="visco_plastic"><equation_of_state type="default_hypo"/><shear_modulus>3.52e9</shear_modulus>'
         '<bulk_modulus>8.9e9</bulk_modulus><visco_plasticity_model type="suvic_i"/>', "suvic_10minus4",
         .004, .02, 917, time=160),
    Case('type="UCNH"><bulk_modulus>6e6</bulk_modulus><shear_modulus>6e5</shear_modulus>', "FTRMTest", .3, .5, 1000,
         speed=100),
    Case('type="comp_neo_hook_plastic"><bulk_modulus>136.35e9</bulk_modulus><shear_modulus>45.45e9</shear_modulus>'
         '<yield_stress>400e6</yield_stress><hardening_modulus>100e6</hardening_modulus>', "cylinderImpact_CNHP",
         .02, .1, 8930),
    Case(f'type="UCNHVar"><usePlasticity>true</usePlasticity>{TABLE}', "disk_UCNHVar", .03, .1, 1000, speed=100),
    Case(f'type="UCNHVar"><usePlasticity>true</usePlasticity>{TABLE}', "disk_UCNHVar", .03, .1, 1000, speed=100,
         title="UCNHVar, ThresholdVar", more=THRESHOLDS),
    Case(f'type="elastic_plastic">{COPPER}<flow_model type="johnson_cook"><A>90e6</A><B>292e6</B><C>0.025</C>'
         '<n>0.31</n><m>1.09</m></flow_model>', "adiCuJC4000s696K", .02, .2, 8930, time=1e-3, more=COPPER_CONSTANTS,
         title="elastic_plastic, johnson_cook"),
    Case('type="elastic_plastic_hp"><shear_modulus>80e9</shear_modulus><bulk_modulus>173.33e9</bulk_modulus>'
         '<flow_model type="zerilli_armstrong"><c_0>50e6</c_0><B>1800e6</B><beta_0>0.0015</beta_0>'
         '<beta_1>0.000045</beta_1><B_0>0</B_0><alpha_0>0</alpha_0><alpha_1>0</alpha_1><K>1200e6</K><n>0.62</n>'
         '</flow_model><equation_of_state type="mie_gruneisen"><C_0>4610</C_0><Gamma_0>1.67</Gamma_0>'
         '<S_alpha>1.73</S_alpha></equation_of_state>', "Charpy, in SI units", .05, .5, 7850, time=1e-3, more=STEEL,
         title="elastic_plastic_hp, zerilli_armstrong"),
    Case('type="elastic_plastic_hp"><shear_modulus>26e9</shear_modulus><bulk_modulus>66.4e9</bulk_modulus>'
         '<flow_model type="johnson_cook"><A>324e6</A><B>114e6</B><C>0.002</C><n>0.42</n><m>1.34</m></flow_model>'
         '<equation_of_state type="mie_gruneisen"><C_0>5386</C_0><Gamma_0>1.99</Gamma_0><S_alpha>1.339</S_alpha>'
         '</equation_of_state>', "MaterialData/*6061T6Al.xml", .05, 2, 2700, time=1e-3, more=ALUMINIUM,
         title="elastic_plastic_hp, johnson_cook damage"),
    Case('type="elastic_plastic_hp"><shear_modulus>69e9</shear_modulus><bulk_modulus>150e9</bulk_modulus>'
         '<flow_model type="isotropic_hardening"><sigma_Y>700e6</sigma_Y><K>500e6</K></flow_model>'
         '<equation_of_state type="default_hypo"/>'
         '<yield_condition type="gurson"><q1>1.5</q1><q2>1</q2><q3>2.25</q3><k>4</k><f_c>0.05</f_c></yield_condition>',
         "test_gurson_beckerdrucker_mts, without its mts_model", .08, .3, 7860, more=STEEL,
         title="elastic_plastic_hp, gurson"),
    Case('type="elastic_plastic_hp"><shear_modulus>3750</shear_modulus><bulk_modulus>10000</bulk_modulus>'
         '<deviatoric_stress_model type="hypoViscoElastic"><mu>[3750]</mu><tau>[0.1]</tau></deviatoric_stress_model>'
         '<equation_of_state type="default_hypo"/><flow_model type="isotropic_hardening"><K>10</K>'
         '<sigma_Y>250</sigma_Y></flow_model>', "test_hypoviscoelastic_rad_ret", .1, .3, 1, speed=200,
         title="elastic_plastic_hp, hypoViscoElastic"),
    Case('type="comp_neo_hook"><shear_modulus>3.52e9</shear_modulus><bulk_modulus>8.9e9</bulk_modulus>',
         "const_test_brittle_damage", .003, .01, 917, time=1e-4, more=BRITTLE, title="comp_neo_hook, Brittle"),
    Case(f'type="Arenisca">{ARENISCA}<CR>1</CR><subcycling_characteristic_number>100'
         '</subcycling_characteristic_number>', "Arenisca2/AreniscaTest_06", .09, .3, 1050, speed=10),
    Case(f'type="Arenisca3">{ARENISCA_3}', "Arenisca3/AreniscaTest_06", .09, .3, 1050, speed=10),
    Case(f'type="Arenisca4">{ARENISCA_3}<J3_type>1</J3_type><J3_psi>0.8</J3_psi>',
         "Arenisca4/AreniscaTest_06, Lode angle added", .09, .3, 1050, speed=10),
    Case('type="MohrCoulomb"><K>8.33e6</K><G>3.85e6</G><c>1000</c><Phi>30</Phi><Psi>0</Psi>', "Permeability1",
         .005, .005, 2000, speed=100),
    Case(f'type="MohrCoulomb"><K>1.667e7</K><G>7.692e6</G><c>1</c><Phi>31</Phi><Psi>0</Psi>{WET}',
         "Silo_empty03_ConialHopper03", .002, .002, 1379, speed=200, title="MohrCoulomb, wet"),
    Case('type="nonlocal_drucker_prager"><bulk_modulus>76e9</bulk_modulus><shear_modulus>26e9</shear_modulus>'
         '<alpha>0</alpha><k_o>400e6</k_o><h_local>0</h_local><h_nonlocal>-1e9</h_nonlocal><alpha_p>0</alpha_p>'
         '<l_nonlocal>0.25</l_nonlocal><minimum_yield_stress>100</minimum_yield_stress>', "2D_compression_nonlocal",
         .05, .2, 1000),
    Case('type="p_alpha"><Ps>6e9</Ps><Pe>.46e9</Pe><rhoS>16281</rhoS><K0>35.2e9</K0><Ks>241.25e9</Ks><T_0>300</T_0>'
         '<C_0>2000</C_0><Gamma_0>1.2</Gamma_0><S_alpha>1.1</S_alpha><shear_modulus>10e9</shear_modulus>'
         '<yield_stress>0.5e9</yield_stress>', "const_test_p_alpha, deviatoric stress added", .1, .1, 14100),
    Case('type="program_burn"><n>7.4</n><K>39e-12</K><A>4.96376e11</A><B>3.944e9</B><C>1.288e9</C><R1>4.06244</R1>'
         '<R2>0.94846</R2><om>0.35</om><rho0>1717</rho0><D>7980</D><T0>0.25</T0>'
         '<starting_location>[0,0,0]</starting_location><direction_if_plane>[1,0,0]</direction_if_plane>',
         "oneDGurneyCylinder4340CompB, in SI units", .1, .3, 1717),
    Case('type="jwlpp_mpm"><ignition_pressure>2e8</ignition_pressure><murnaghan_K>1.9342e-10</murnaghan_K>'
         '<murnaghan_n>15.2</murnaghan_n><jwl_A>7.73037e11</jwl_A><jwl_B>21.629e9</jwl_B><jwl_C>1.339e9</jwl_C>'
         '<jwl_R1>4.5</jwl_R1><jwl_R2>1.5</jwl_R2><jwl_om>0.33</jwl_om><reaction_G>1</reaction_G>'
         '<reaction_b>1.05</reaction_b>', "halfSpaceUCNH_JWLMPM", .1, .3, 2000, time=2e-8, speed=1e5),
    Case('type="water"><bulk_modulus>15000</bulk_modulus><viscosity>.5</viscosity><gamma>7</gamma>', "drop", .1, .3,
         1000, speed=10, time=.01),
    Case('type="TH_water"><a>2e-7</a><b>2.6</b><co>4205.7</co><ko>5e-10</ko><To>277</To><L>8e-6</L><vo>1.00008e-3</vo>'
         '<Pref>101325</Pref>', "drop.TH", .01, .3, 995.7490146145051,
         more="<specific_heat>4145.37627765</specific_heat>"),
    Case('type="ideal_gas"><specific_heat>717.5</specific_heat><gamma>1.4</gamma>', "riemannMPM", .3, .3,
         1.1768292682926831, speed=400, more="<specific_heat>717.5</specific_heat>"),
)


def unit_of(stress):
    """A factor and its unit for stresses of this size [Pa]."""
    largest = np.abs(stress).max()
    return next((factor, unit) for factor, unit in ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa"), (1, "Pa"))
                if largest >= factor or factor == 1)


def draw_pair(axes, case, found):
    """Draws both paths of a model side by side."""
    for plot, kind in zip(axes, ("uniaxial", "shear")):
        strain, stress = found[kind]
        curves = [stress[:, 0, 0], stress[:, 1, 1]] if kind == "uniaxial" else [stress[:, 0, 1]]
        factor, unit = unit_of(np.array(curves))
        for curve, colour, width in zip(curves, ("C0" if kind == "uniaxial" else "C3", "0.6"), (1.3, 1)):
            plot.plot(strain, curve / factor, color=colour, linewidth=width)
        plot.axhline(0, color="0.85", linewidth=.6, zorder=0)
        plot.axvline(0, color="0.85", linewidth=.6, zorder=0)
        plot.tick_params(labelsize=7, length=2, pad=1.5)
        plot.locator_params(axis="y", nbins=4)
        plot.locator_params(axis="x", nbins=3)
        plot.plot(strain[-1], curves[0][-1] / factor, "k.", markersize=4)
        plot.set_ylabel(unit, fontsize=7, labelpad=1)
        plot.margins(.06, .1)
        if not np.any(curves):
            plot.set_ylim(-1, 1)
    axes[0].set_title(case.title, fontsize=8, loc="left", pad=3)


def draw(cases, results, file):
    """Draws three models in each row."""
    matplotlib.use("Agg")
    from matplotlib import pyplot

    across = min(3, len(cases))
    rows = -(-len(cases) // across)
    figure, plots = pyplot.subplots(rows, 2 * across, figsize=(3.9 * across, 1.35 * rows + .5), squeeze=False,
                                    layout="constrained")
    for plot in plots.flat[2 * len(cases):]:
        plot.axis("off")
    for k, (case, found) in enumerate(zip(cases, results)):
        draw_pair(plots.flat[2 * k:2 * k + 2], case, found)
    figure.suptitle("Left of each pair: axial (blue) and lateral (grey) stress against the axial strain F_xx - 1; "
                    "right: shear stress (red) against the shear F_xy; dots: end", fontsize=8)
    figure.savefig(file, dpi=105)


def summary(case, found):
    """A line on what a cycle leaves and takes."""
    (strain, stress), (shear, sheared) = found["uniaxial"], found["shear"]
    largest = np.abs(stress).max()
    most = np.abs(sheared[:, 0, 1]).max()
    scale = most or 1  # fluids without viscosity have no shear stress
    # In uniaxial strain, the axial nominal stress is the Cauchy stress; in simple shear, so is P_xy.
    return (f"{case.title:38} at most {largest:9.3e}, {most:9.3e} Pa; left {np.abs(stress[-1]).max() / largest:8.1e}, "
            f"{abs(sheared[-1, 0, 1]) / scale:8.1e}; "
            f"work {work(strain, stress[:, 0, 0]) / (largest * case.strain):8.1e}, "
            f"{work(shear, sheared[:, 0, 1]) / (scale * case.shear):8.1e}; {case.source}")


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--out", default=ROOT / "components/mpm/solid/constitutive/stress_paths.png")
    words.add_argument("--only", default="", help="titles, or parts of them, separated by commas")
    given = words.parse_args()
    cases = [case for case in CASES if any(part in case.title for part in given.only.split(","))]
    results = []
    for case in cases:
        results.append({kind: case.run(kind) for kind in ("uniaxial", "shear")})
        print(summary(case, results[-1]), flush=True)
    draw(cases, results, given.out)


if __name__ == "__main__":
    main()
