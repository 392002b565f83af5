#include <gtest/gtest.h>

#include "tests/mpm/solid/constitutive/example_models.hpp"
#include "tests/mpm/solid/constitutive/material_point.hpp"

namespace tushar::mpm::solid::testing {
namespace {

constexpr double roundOff = 1e-12;  ///< some hundred operations, each exact to 1e-16

double equivalent(const Matrix3& stress) { return std::sqrt(1.5) * deviator(stress).norm(); }

/// The same step seen from a frame that is rotated by `before`, and then further: the stress must follow the second
/// rotation.
template <class M>
void expectObjective(MaterialPoint<M> point, const Matrix3& f, void (*turnState)(typename M::State&, const Matrix3&)) {
  const Matrix3 before = rotation(0.7), after = rotation(-1.9);
  Matrix3 spin;
  spin << 0, 3, -1, -3, 0, 2, 1, -2, 0;
  Deformation d = point.step(f);
  typename M::State state = point.oldState, turnedState = point.oldState;
  const Matrix3 stress = point.model.updateStress(d, point.oldStress, state);
  turnState(turnedState, before);
  d.deformationGradient = after * f;
  d.oldDeformationGradient = before * point.oldDeformation;
  d.velocityGradient = before * d.velocityGradient * before.transpose() + spin;
  const Matrix3 oldStress = before * point.oldStress * before.transpose();
  const Matrix3 turned = point.model.updateStress(d, oldStress, turnedState);
  EXPECT_LT((turned - after * stress * after.transpose()).norm(), 1e-10 * stress.norm());
}
template <class State>
void keep(State&, const Matrix3&) {}

template <class M>
void expectStressFromEnergy(const M& model) {
  const MaterialPoint<M> point{model};
  const Matrix3 f = generalDeformation(0.3);
  const auto energy = [&](const Matrix3& at) { return point.energy(at); };
  const Eigen::Matrix<double, 1, 9> expected = derivative(energy, f);
  const Matrix3 stress = point.nominalStress(f);
  // Differences of fourth order with steps of 1e-3: see the tangents.
  EXPECT_LT((Eigen::Map<const Eigen::Matrix<double, 1, 9>>(stress.data()) - expected).norm(), 1e-8 * stress.norm());
}

TEST(Hyperelasticity, StressIsTheDerivativeOfTheEnergy) {
  expectStressFromEnergy(withModuli<CompNeoHook>());
  expectStressFromEnergy(compMooneyRivlin());
  expectStressFromEnergy(lockingRubber());
  expectStressFromEnergy(withModuli<Ucnh>());
  TransIsoHyper fibres = ligament<>();
  for (const double straight : {1.0, 1.05, 2.0}) {  // fibres that are straight, have become so, are still crimped
    fibres.straight = straight;
    expectStressFromEnergy(fibres);
  }
  auto exponential = ligament<ViscoTransIsoHyper>();
  exponential.rubber = FibreElasticity::Rubber::verondaWestmann;
  expectStressFromEnergy(exponential);
}

/// Returns the argument at which Langevin's function coth z - 1/z is y, found by bisection.
double inverseLangevin(double y) {
  double low = 0, high = 100;
  for (int k = 0; k < 200; ++k) {
    const double z = 0.5 * (low + high);
    (1 / std::tanh(z) - 1 / z < y ? low : high) = z;
  }
  return 0.5 * (low + high);
}

/// In a bar that keeps its volume, sigma_x - sigma_y = G/3 l/c L^-1(c/l) (s² - 1/s) with the stretch of chains c² = I/3
/// and their locking stretch l: Arruda & Boyce (1993), eq. 22. The series leaves out a part (c/l)^10 and smaller.
TEST(Hyperelasticity, LocksAsChainsDo) {
  const double locking = 4;
  const MaterialPoint<ArrudaBoyce8> point{lockingRubber(locking)};
  for (const double s : {0.6, 1.3, 2.0, 2.5}) {
    const Matrix3 stress = point.stress(Eigen::Vector3d(s, 1 / std::sqrt(s), 1 / std::sqrt(s)).asDiagonal());
    const double chain = std::sqrt((s * s + 2 / s) / 3), share = chain / locking;
    const double expected = 3.0 / 3 / share * inverseLangevin(share) * (s * s - 1 / s);
    EXPECT_NEAR((stress(0, 0) - stress(1, 1)) / expected, 1, std::pow(share, 10) + 1e-9) << s;
    EXPECT_NEAR(stress.trace(), 0, 1e-10) << s;
  }
}

/// W of a strain of 1e-7 is that of the linear theory, e:e G + (K/2 - G/3) tr² e, in a body that has turned.
template <class M>
void expectEnergyOfSmallStrain(const M& model, double bulkModulus, double shearModulus) {
  constexpr double size = 1e-7;
  Matrix3 strain;
  strain << 1.0, 0.35, -0.45, 0.35, -0.8, 0.25, -0.45, 0.25, 0.7;
  const double linear =
      size * size *
      (shearModulus * strain.squaredNorm() + (bulkModulus / 2 - shearModulus / 3) * strain.trace() * strain.trace());
  for (const double angle : {0.0, 0.7}) {
    const MaterialPoint<M> point{model};
    // The next order of the strain, 1e-7, and the rounding of F divided by the strain, 1e-9, times factors of the order
    // of 10.
    EXPECT_NEAR(point.energy(rotation(angle) * (Matrix3::Identity() + size * strain)) / linear, 1, 1e-5) << angle;
  }
}

TEST(Hyperelasticity, KeepsTheEnergyOfStrainsThatAreHardlyThere) {
  expectEnergyOfSmallStrain(withModuli<CompNeoHook>(8e9, 5e8), 8e9, 5e8);
  expectEnergyOfSmallStrain(withModuli<Ucnh>(8e9, 5e8), 8e9, 5e8);
  const double x = 3 / (1.7 * 1.7);
  const double stiffer = 1 + x * (0.2 + x * (33.0 / 525 + x * (76.0 / 3500 + x * 2595 / 336875)));
  expectEnergyOfSmallStrain(lockingRubber(), 7, 3 * stiffer);
  const CompMooneyRivlin rubber = compMooneyRivlin();
  const double shear = 2 * (rubber.c1 + rubber.c2), nu = rubber.poissonRatio;
  expectEnergyOfSmallStrain(rubber, 2 * shear * (1 + nu) / (3 * (1 - 2 * nu)), shear);
  TransIsoHyper fibres = ligament<>();
  fibres.c3 = fibres.c5 = 0;
  expectEnergyOfSmallStrain(fibres, fibres.bulkModulus, 2 * (fibres.c1 + fibres.c2));
}

namespace {

/// The results of a model for particles without stored stresses: J sigma, wave speeds and energies.
struct Found {
  std::vector<Matrix3> stress;
  std::vector<double> waveSpeed, energy;

  Found(const Model& model, const Matrix3* f, int count) : stress(count), waveSpeed(count), energy(count) {
    model.kirchhoffStress(f, count, stress.data());
    StressPoints points;
    points.count = count;
    points.deformationGradient = points.oldDeformationGradient = points.velocityGradient = f;
    points.waveSpeed = waveSpeed.data();
    points.strainEnergyDensity = energy.data();
    model.updateStress(1000, points);
  }
};

template <class M>
void expectSameTogether(const M& of) {
  const ModelOf<M> model(of);
  std::vector<Matrix3> f;
  for (int k = 0; k < 9; ++k) f.push_back(generalDeformation(0.05 * k));
  for (int count = 1; count <= 9; ++count) {
    const Found together(model, f.data(), count);
    for (int k = 0; k < count; ++k) {
      const Found alone(model, &f[k], 1);
      EXPECT_EQ(together.stress[k], alone.stress[0]) << k << " of " << count;
      EXPECT_EQ(together.waveSpeed[k], alone.waveSpeed[0]) << k << " of " << count;
      EXPECT_EQ(together.energy[k], alone.energy[0]) << k << " of " << count;
      EXPECT_EQ(together.energy[k], of.template strainEnergyDensity<double>(f[k]));
      EXPECT_EQ(together.waveSpeed[k], of.template waveSpeed<double>(1000, f[k]));
    }
  }
  const Matrix3 stress = Found(model, &f[8], 1).stress[0];
  EXPECT_LT((stress - of.template kirchhoffStress<double>(f[8])).norm(), 1e-14 * stress.norm());
}

}  // namespace

TEST(Model, WorksOnSeveralParticlesAsOnEachAlone) {
  expectSameTogether(CompNeoHook{8e5, 4e5});
  expectSameTogether(compMooneyRivlin());
}

TEST(Objectivity, StressTurnsWithTheBody) {
  const Matrix3 f = generalDeformation(0.2);
  expectObjective(MaterialPoint<CompNeoHook>{withModuli<CompNeoHook>()}, f, keep);
  expectObjective(MaterialPoint<CompMooneyRivlin>{compMooneyRivlin()}, f, keep);
  expectObjective(MaterialPoint<CnhMms>{withModuli<CnhMms>()}, f, keep);
  expectObjective(MaterialPoint<Ucnh>{withModuli<Ucnh>()}, f, keep);
}

TEST(Objectivity, StressOfYieldingBodiesTurnsWithThem) {
  MaterialPoint<CompNeoHookPlastic> neoHook{compNeoHookPlastic(0.5)};
  MaterialPoint<ElasticPlasticHp> metal{elasticPlastic(IsotropicHardening{0.2, 0.5})};
  MaterialPoint<MohrCoulomb> soil{mohrCoulomb(30, 10)};
  for (const double strain : {0.1, 0.15}) {
    neoHook.advance(generalDeformation(strain));
    metal.advance(generalDeformation(strain));
    soil.advance(generalDeformation(strain));
  }
  ASSERT_GT(neoHook.oldState.plasticStrain, 0);
  ASSERT_GT(metal.oldState.plasticStrain, 0);
  const Matrix3 f = generalDeformation(0.2);
  expectObjective(neoHook, f, [](CompNeoHookPlastic::State& state, const Matrix3& q) {
    state.bElBar = tensorOf(q * matrixOf(state.bElBar) * q.transpose());
  });
  expectObjective(metal, f, keep);
  expectObjective(soil, f, keep);
}

/// Turns tensors of a State.
void turn(const Matrix3& q, auto&... tensors) { ((tensors = tensorOf(q * matrixOf(tensors) * q.transpose())), ...); }

TEST(Objectivity, StressOfRelaxingBodiesTurnsWithThem) {
  MaterialPoint<ViscoTransIsoHyper> fibres{relaxingLigament()};
  MaterialPoint<MwViscoElastic> maxwell{springBesideMaxwell()};
  MaterialPoint<ElasticPlasticHp> metal{relaxingMetal(IsotropicHardening{0.2, 0.5})};
  MaterialPoint<ViscoScram> cracked{explosive()};
  MaterialPoint<ViscoPlastic> creeping{ice()};
  for (const double strain : {0.1, 0.15}) {
    fibres.advance(generalDeformation(strain));
    maxwell.advance(generalDeformation(strain));
    metal.advance(generalDeformation(strain));
    cracked.advance(generalDeformation(strain));
    creeping.advance(generalDeformation(strain));
  }
  const Matrix3 f = generalDeformation(0.2);
  expectObjective(fibres, f, [](ViscoTransIsoHyper::State& state, const Matrix3& q) {
    turn(q, state.elasticStress, state.histories[0], state.histories[3]);
  });
  expectObjective(maxwell, f, [](MwViscoElastic::State& state, const Matrix3& q) { turn(q, state.deviator); });
  expectObjective(
      metal, f, [](ElasticPlasticHp::State& state, const Matrix3& q) { turn(q, state.maxwell[0], state.maxwell[1]); });
  expectObjective(cracked, f,
                  [](ViscoScram::State& state, const Matrix3& q) { turn(q, state.deviators[0], state.deviators[2]); });
  expectObjective(creeping, f, [](ViscoPlastic::State& state, const Matrix3& q) { turn(q, state.backStress); });
}

TEST(CompNeoHookPlastic, ReturnsToTheYieldSurface) {
  for (const double hardening : {0.0, 0.5}) {
    MaterialPoint<CompNeoHookPlastic> point{compNeoHookPlastic(hardening)};
    for (const double strain : {0.02, 0.1, 0.3}) {
      const Matrix3 f = generalDeformation(strain);
      point.advance(f);
      const double radius = 0.2 + hardening * point.oldState.plasticStrain;
      EXPECT_NEAR(f.determinant() * equivalent(point.oldStress), radius, roundOff);
    }
  }
}

TEST(ElasticPlastic, ReturnsToTheYieldSurfaceOfEachFlowModel) {
  for (const FlowModel& flow : flowModels()) {
    MaterialPoint<ElasticPlasticHp> point{elasticPlastic(flow)};
    for (const double strain : {0.05, 0.1, 0.3}) {
      point.advance(generalDeformation(strain));
      const double density = 2 / point.oldDeformation.determinant(), plasticRate = point.oldState.plasticStrainRate;
      const FlowState state{
          point.oldState.plasticStrain, point.oldState.strainRate, 300, 3, density, 2000, plasticRate};
      const double yieldStress = std::visit([&](const auto& model) { return model.flowStress(state); }, flow);
      EXPECT_NEAR(equivalent(point.oldStress), yieldStress, roundOff);
    }
  }
}

TEST(ElasticPlastic, FollowsTheUniaxialStrainPathBeyondTheElasticLimit) {
  const double yieldStress = 0.02;
  MaterialPoint<ElasticPlasticHp> point{elasticPlastic(IsotropicHardening{yieldStress, 0})};
  point.model.equationOfState = HypoelasticVolume{};
  const double k = point.model.bulkModulus, g = point.model.shearModulus, elasticLimit = yieldStress / (2 * g);
  double dilatation = 0;
  for (int step = 1; step <= 100; ++step) {
    Matrix3 f = Matrix3::Identity();
    f(0, 0) = 1 - 1e-4 * step;
    dilatation += f(0, 0) / point.oldDeformation(0, 0) - 1;
    point.advance(f);
    const double difference = point.oldStress(0, 0) - point.oldStress(1, 1);
    EXPECT_NEAR(difference, -dilatation > elasticLimit ? -yieldStress : 2 * g * dilatation, roundOff);
    EXPECT_NEAR(point.oldStress.trace() / 3, k * dilatation, roundOff);
  }
  EXPECT_GT(-dilatation, 2 * elasticLimit);
}

TEST(ElasticPlastic, HeatsByTheShareOfThePlasticWorkThatTaylorAndQuinneyFound) {
  MaterialPoint<ElasticPlasticHp> point{elasticPlastic(IsotropicHardening{0.2, 0})};
  Matrix3 f = Matrix3::Identity();
  f(0, 1) = 0.3;
  const ElasticPlasticHp::State state = point.state(f);
  const double work = 0.2 * state.plasticStrain;
  const double change = point.model.temperatureChange(point.step(f), point.stress(f), state);
  EXPECT_NEAR(change, 0.9 * work / (2 * 0.5), roundOff);
}

TEST(ElasticPlastic, HasNoShearStressAboveItsMeltingTemperature) {
  MaterialPoint<ElasticPlasticHp> point{elasticPlastic(IsotropicHardening{0.2, 0})};
  point.temperature = 2001;
  EXPECT_LT(equivalent(point.stress(generalDeformation(0.1))), roundOff);
}

TEST(MohrCoulomb, ReturnsToFacesEdgesAndApex) {
  for (const double friction : {0.0, 30.0})
    for (const double dilation : {0.0, 30.0}) {
      if (dilation > friction) continue;
      const MohrCoulomb model = mohrCoulomb(friction, dilation);
      const std::vector<Vec3> trials{{1, 0.3, -1},     {1, 0.95, -1},    {1, -0.95, -1},     {-3, -3.1, -12},
                                     {-3, -11.9, -12}, {0.2, 0.1, -0.5}, {0.05, -0.2, -0.21}};
      for (const Vec3& principal : trials) {
        const Matrix3 q = rotation(0.8), trial = q * principal.asDiagonal() * q.transpose();
        typename MohrCoulomb::State none;
        const Deformation still{Matrix3::Identity(), Matrix3::Identity(), Matrix3::Zero(), 1, 300};
        EXPECT_NEAR(model.excess(model.updateStress(still, trial, none)), 0, 1e-11);
      }
    }
}

TEST(MohrCoulomb, ReturnsToTheApexFromStrongTension) {
  const MohrCoulomb model = mohrCoulomb(30, 10);
  typename MohrCoulomb::State none;
  const Deformation still{Matrix3::Identity(), Matrix3::Identity(), Matrix3::Zero(), 1, 300};
  const Matrix3 stress = model.updateStress(still, 5 * Matrix3::Identity(), none);
  EXPECT_LT((stress - 0.1 * std::sqrt(3.0) * Matrix3::Identity()).norm(), roundOff);
}

/// Under a lateral pressure s3 the axial pressure is at most s3 N + 2 c N^(1/2), N = (1 + sin phi) / (1 - sin phi).
TEST(MohrCoulomb, FailsAtTheStrengthOfTheTriaxialTest) {
  const MohrCoulomb model = mohrCoulomb(30, 0);
  const double lateral = 0.4, axial = lateral * 3 + 2 * 0.1 * std::sqrt(3.0);
  EXPECT_NEAR(model.excess(Vec3(-lateral, -axial, -lateral).asDiagonal().toDenseMatrix()), 0, roundOff);
  EXPECT_LT(model.excess(Vec3(-lateral, -0.99 * axial, -lateral).asDiagonal().toDenseMatrix()), -1e-3);
}

TEST(MohrCoulomb, KeepsAStressThatIsPossible) {
  const MohrCoulomb model = mohrCoulomb(30, 0);
  typename MohrCoulomb::State none;
  const Deformation still{Matrix3::Identity(), Matrix3::Identity(), Matrix3::Zero(), 1, 300};
  const Matrix3 stress = Vec3(-1, -1.2, -1.1).asDiagonal().toDenseMatrix();
  EXPECT_LT((model.updateStress(still, stress, none) - stress).norm(), roundOff);
}

TEST(IdealGas, ExpandsAlongItsAdiabat) {
  IdealGas gas;
  gas.ratio = 1.4;
  gas.specificHeat = 717.5;
  gas.material.density = 1.2;
  const int steps = 10000;
  double temperature = 300;
  Matrix3 f = Matrix3::Identity();
  for (int step = 1; step <= steps; ++step) {
    Matrix3 next = f;
    next(0, 0) = 1 + double(step) / steps;
    temperature += gas.temperatureChange({next, f, Matrix3::Zero(), 1, temperature}, Matrix3::Zero(), {});
    f = next;
  }
  // The error of steps of first order: 0.4 1.4 / 2 times the sum of the squared growths, 0.5/steps.
  const double expected = 300 * std::pow(2.0, -0.4);
  EXPECT_NEAR(temperature, expected, 0.28 * 0.6 / steps * expected);
}

TEST(IdealGas, HasNoStressAtItsReferencePressure) {
  IdealGas gas;
  gas.ratio = 1.4;
  gas.specificHeat = 717.5;
  gas.material.density = 1.2;
  gas.referencePressure = 0.4 * 1.2 * 717.5 * 300;
  const MaterialPoint<IdealGas> point{gas};
  EXPECT_LT(point.stress(Matrix3::Identity()).norm(), roundOff * gas.referencePressure);
}

TEST(WaveSpeed, OfFluidsIsThatOfTheirPressure) {
  Water water;
  water.bulkModulus = 2;
  water.exponent = 7;
  const double density = 1.5, h = 1e-4;
  const auto pressure = [&](double volume) {
    Water::State none;
    const Matrix3 f = std::cbrt(volume) * Matrix3::Identity();
    return -water.updateStress({f, f, Matrix3::Zero(), 1, 300}, Matrix3::Zero(), none).trace() / 3;
  };
  const auto volumeAt = [&](double rho) { return density / rho; };
  const double rho = density / 0.9, slope = (pressure(volumeAt(rho + h)) - pressure(volumeAt(rho - h))) / (2 * h);
  const Matrix3 f = std::cbrt(0.9) * Matrix3::Identity();
  EXPECT_NEAR(water.waveSpeed(density, {f, f, f, 1, 300}, f, {}), std::sqrt(slope), 1e-6);
}

TEST(ElasticPlastic, MeltsWhereItsMeltingModelSays) {
  ElasticPlasticHp model;
  model.melting = ScgMelting{1790, 2.02, 1.5};
  model.material.meltTemperature = 295;
  const Matrix3 still = Matrix3::Identity(), free = Matrix3::Zero();
  EXPECT_FALSE(ModelOf<ElasticPlasticHp>(model).isMolten(still, free, 1789));
  EXPECT_TRUE(ModelOf<ElasticPlasticHp>(model).isMolten(still, free, 1791));
  EXPECT_FALSE(ModelOf<CompNeoHook>(CompNeoHook()).isMolten(still, free, 1e6));
}

}  // namespace
}  // namespace tushar::mpm::solid::testing
