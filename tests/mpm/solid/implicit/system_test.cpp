#include <random>

#include "tests/mpm/solid/implicit/block.hpp"

// The equations of an implicit step, and their solutions.

namespace tushar::mpm::solid::implicit {

using namespace testing;

namespace {

/// A metal that yields at a strain of about .01.
CompNeoHookPlastic softMetal() {
  auto model = withModuli<CompNeoHookPlastic>(8e5, 2e5);
  model.yieldStress = 5e3;
  model.hardeningModulus = 1e4;
  return model;
}

/// A material with fibres across the block.
TransIsoHyper fibres() {
  TransIsoHyper model = ligament();
  for (double* modulus : {&model.bulkModulus, &model.c1, &model.c2, &model.c3, &model.c5}) *modulus *= 1e5;
  return model;
}

/// A metal that yields at a strain of about .01 and hardens by the Johnson-Cook law.
ElasticPlasticModel hardeningMetal() {
  auto model = withModuli<ElasticPlasticModel>(8e5, 2e5);
  model.flow = JohnsonCook{5e3, 1e4, 0.025, 0.31, 1.09, 1, 298, 1356};
  model.material = {1000, 500, 2000, 294};
  return model;
}

/// A dense matrix: every entry is stored.
class Dense : public solvers::Matrix {
 public:
  Dense(int nodes, int block) : values(Eigen::MatrixXd::Zero(nodes * block, nodes * block)), block_(block) {}
  void add(std::span<const int> rows, std::span<const int> columns, std::span<const double> numbers) override {
    const auto width = columns.size() * block_;
    for (std::size_t r = 0; r < rows.size() * block_; ++r)
      for (std::size_t c = 0; c < width; ++c) {
        const int row = rows[r / static_cast<std::size_t>(block_)],
                  column = columns[c / static_cast<std::size_t>(block_)];
        if (row < 0 || column < 0) continue;
        values(row * block_ + static_cast<int>(r) % block_, column * block_ + static_cast<int>(c) % block_) +=
            numbers[r * width + c];
      }
  }
  Eigen::MatrixXd values;

 private:
  int block_;
};

/// Returns the largest difference between the assembled tangent and central differences, over the largest entry.
template <int D>
double errorOfTangent(ImplicitSystem<D> system, double size) {
  const int nodes = system.nodes().size();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> drawn(-size, size);
  std::vector<double> u(nodes * D), above(u.size()), below(u.size()), r(u.size());
  for (double& value : u) value = drawn(random);
  EXPECT_TRUE(system.residual(u, r));
  Dense matrix(nodes, D);
  system.tangent(matrix);
  // The error of central differences, h², and their rounding, 1e-16/h, are both below 1e-9.
  const double step = 1e-6;
  double error = 0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    const double before = u[k];
    u[k] = before + step;
    EXPECT_TRUE(system.residual(u, above));
    u[k] = before - step;
    EXPECT_TRUE(system.residual(u, below));
    u[k] = before;
    for (std::size_t i = 0; i < u.size(); ++i)
      error = std::max(error, std::abs((above[i] - below[i]) / (2 * step) - matrix.values(int(i), int(k))));
  }
  return error / matrix.values.cwiseAbs().maxCoeff();
}

}  // namespace

TEST(ImplicitSystem, HasTheTangentOfItsResidual) {
  EXPECT_LT(errorOfTangent(Block<LinearShape<1>>(modelOf(rubber()), {{3, 1, 1}}).system(true), 0.1), 1e-6);
  EXPECT_LT(errorOfTangent(Block<LinearShape<2>>(modelOf(rubber()), {{2, 2, 1}}).system(true), 0.1), 1e-6);
  EXPECT_LT(errorOfTangent(Block<GimpShape<2>>(modelOf(rubber()), {{2, 2, 1}}).system(false), 0.1), 1e-6);
  EXPECT_LT(errorOfTangent(Block<LinearShape<3>>(modelOf(rubber()), {{2, 1, 1}}).system(false), 0.1), 1e-6);
}

TEST(ImplicitSystem, HasTheTangentOfEveryMaterialFromADeformedStart) {
  for (const auto& model : {modelOf(rubber()), modelOf(mooneyRivlin()), modelOf(withModuli<HypoElastic>(8e5, 2e5)),
                            modelOf(softMetal()), modelOf(fibres()), modelOf(hardeningMetal())}) {
    Block<LinearShape<2>> block(model, {{2, 2, 1}}, 1.2);
    EXPECT_LT(errorOfTangent(block.system(false), 0.1), 1e-6) << model->name();
  }
}

TEST(ImplicitSystem, HasTheTangentOfItsResidualWhereTheGridGoesAlong) {
  Block<GimpShape<2>> plane(modelOf(softMetal()), {{2, 2, 1}}, 1.3);
  Block<LinearShape<3>> solid(modelOf(rubber()), {{1, 1, 1}}, 1.3);
  plane.resetsGrid = solid.resetsGrid = false;
  EXPECT_LT(errorOfTangent(plane.system(true), 0.1), 1e-6);
  EXPECT_LT(errorOfTangent(solid.system(false), 0.1), 1e-6);
}

TEST(ImplicitSystem, StretchesWithTheGridByTheDisplacementOfTheNodes) {
  // If the grid has followed a stretch of 1.3, u = 0.2 X adds 0.2 to it: P is that of a stretch of 1.5.
  Block<LinearShape<1>> block(modelOf(rubber()), {{1, 1, 1}}, 1.3);
  block.resetsGrid = false;
  ImplicitSystem<1> system = block.system(false);
  std::vector<double> u{0, 0.2}, r(2);

  ASSERT_TRUE(system.residual(u, r));

  const Matrix3 kirchhoff = rubber().kirchhoffStress(Matrix3(Vec3(1.5, 1, 1).asDiagonal()));
  EXPECT_NEAR(r[1], kirchhoff(0, 0) / 1.5, 1e-12 * 8e5);  // rounding of the modulus
}

TEST(ImplicitSystem, HasTheTangentOfItsResidualWhereParticlesAreCompressedAsOne) {
  for (const auto& model : {modelOf(rubber()), modelOf(mooneyRivlin()), modelOf(softMetal())}) {
    Block<LinearShape<2>> narrow(model, {{2, 2, 1}}, 1.2);
    Block<GimpShape<2>> wide(model, {{2, 1, 1}}, 1.2);
    Block<LinearShape<3>> solid(model, {{1, 1, 1}}, 0.9);
    narrow.sharesVolume = wide.sharesVolume = solid.sharesVolume = true;
    EXPECT_LT(errorOfTangent(narrow.system(false), 0.1), 1e-6) << model->name();
    EXPECT_LT(errorOfTangent(wide.system(false), 0.1), 1e-6) << model->name();
    EXPECT_LT(errorOfTangent(solid.system(false), 0.1), 1e-6) << model->name();
  }
}

/// sum_i r_i S_i/r, the hoop strain of u_r = r, at points throughout a cell that does not touch the axis.
template <class Shape>
void expectHoopStrainOfExpansion() {
  const Level level(domainAround(Index3{{4, 4, 0}}));
  for (const double along : {0.1, 0.3, 0.7, 0.95}) {
    const Vec<2> x(2.15, 1 + along);
    const typename Shape::Stencil stencil(level, {{2, 1}}, x, Extent<2>{Vec<2>(0.5, 0.5), {}});
    double strain = 0;
    stencil.forEachNode([&](const Index<2>& node, double, const Vec<2>&) {
      strain += level.nodePosition(0, node[0]) * hoopOf(stencil, node);
    });
    EXPECT_NEAR(strain, 1, 1e-13);  // round-off of sums of order 1
  }
}

TEST(HoopOf, GivesTheStrainOfAnExpansionWhereverTheParticleIsAlongTheAxis) {
  expectHoopStrainOfExpansion<AxisymmetricLinearShape<2>>();
  expectHoopStrainOfExpansion<AxisymmetricGimpShape<2>>();
}

TEST(ImplicitSystem, HasNoForceWhereNothingIsDeformed) {
  Block<GimpShape<2>> block(modelOf(rubber()), {{2, 2, 1}});
  ImplicitSystem<2> system = block.system(false);
  std::vector<double> u(2 * system.nodes().size(), 0.0), r(u.size());
  EXPECT_TRUE(system.residual(u, r));
  for (const double value : r) EXPECT_NEAR(value, 0, 1e-9);  // rounding of 8e5 Pa m
}

TEST(ImplicitSystem, RefusesToTurnAPointInsideOut) {
  Block<LinearShape<1>> block(modelOf(rubber()), {{1, 1, 1}});
  ImplicitSystem<1> system = block.system(false);
  std::vector<double> u{0, -1.5}, r(2);
  EXPECT_FALSE(system.residual(u, r));
}

TEST(ImplicitSystem, MovesFreelyUnderGravityByNewmark) {
  Block<LinearShape<2>> block(modelOf(rubber()), {{2, 2, 1}});
  block.method.gravity = {0, -10, 0};
  for (Vec<2>& v : block.velocity()) v = {3, 0};
  ImplicitSystem<2> system = block.system(true, 0.1);
  std::vector<double> u = system.guess();

  ASSERT_TRUE(solvers::solver().solve(system.unknowns(), system, direct(), u).converged);

  // From a = 0 at the start: u = v dt + g dt²/4, a = g.
  for (int k = 0; k < system.nodes().size(); ++k) {
    EXPECT_NEAR(system.displacement(k, u)[0], 0.3, 1e-9);
    EXPECT_NEAR(system.displacement(k, u)[1], -10 * 0.01 / 4, 1e-9);
    EXPECT_NEAR(system.acceleration(k, u)[1], -10, 1e-6);
  }
}

TEST(ImplicitSystem, BringsABarIntoEquilibriumWithItsLoad) {
  // One axis: P = dW/dF, where W is that of uniaxial strain; the load is shared by the last particles.
  Block<LinearShape<1>> block(modelOf(rubber()), {{1, 1, 1}});
  const double load = 3e5;
  block.force().back()[0] = load;
  ImplicitSystem<1> system = block.system(false);
  clamp(system);
  std::vector<double> u = system.guess();

  ASSERT_TRUE(solvers::solver().solve(system.unknowns(), system, direct(), u).converged);

  const double f = 1 + system.displacement(1, u)[0];
  const Matrix3 kirchhoff = rubber().kirchhoffStress(Matrix3(Vec3(f, 1, 1).asDiagonal()));
  // The particle at 3/4 gives 3/4 of its load to the free node.
  EXPECT_NEAR(kirchhoff(0, 0) / f, 0.75 * load, 1e-6 * load);
}

TEST(ImplicitSystem, KnowsTheForcesThatHoldWhatIsPrescribed) {
  Block<LinearShape<2>> block(modelOf(rubber()), {{2, 1, 1}});
  block.method.gravity = {-3, 0, 0};
  ImplicitSystem<2> system = block.system(false);
  clamp(system);
  std::vector<double> u = system.guess();

  ASSERT_TRUE(solvers::solver().solve(system.unknowns(), system, direct(), u).converged);

  // The clamped end bears the weight of two cells of 1000 kg.
  double along = 0;
  const std::vector<double> forces = system.reactions();
  for (std::size_t k = 0; k < forces.size(); k += 2) along += forces[k];
  EXPECT_NEAR(along, 2 * 1000 * 3, 1e-6);  // the residual's rounding of 8e5 Pa m, and of Newton's method
}

TEST(ImplicitMethod, ChangesTheTimeStepByNewtonsIterations) {
  const ImplicitMethod method;
  EXPECT_EQ(method.nextTimeStep(1, 12), 0.6);
  EXPECT_EQ(method.nextTimeStep(1, 11), 1);
  EXPECT_EQ(method.nextTimeStep(1, 5), 1);
  EXPECT_EQ(method.nextTimeStep(1, 4), 2);
}

}  // namespace tushar::mpm::solid::implicit
