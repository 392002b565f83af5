#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "components/mpm/solid/implicit/conduct_heat.hpp"
#include "components/mpm/solid/materials/all.hpp"
#include "tests/support/levels.hpp"

// The equations of an implicit step on plain particles, and Newton's method on them.

namespace tushar::mpm::solid {

namespace {

CompNeoHook rubber() {
  CompNeoHook model;
  model.bulkModulus = 8e5;
  model.shearModulus = 2e5;
  return model;
}

/// A block of particles, two along each axis of a cell, on a grid of unit cells between symmetry planes.
template <class Shape>
class Block {
 public:
  static constexpr int D = Shape::dimension;

  /// Fills the `filled` cells next to the lower corner. `stretched` > 1 pulls the block apart before the step.
  Block(std::shared_ptr<const Model> model, const Index3& filled, double stretched = 1)
      : level_(domainAround(filled)), state_size_(std::max(1, model->stateSize())) {
    material_.density = 1000;
    material_.model = std::move(model);
    const Patch& patch = level_.patches().front();
    set_.reset(patch, 0);
    forEach<D>(patch.cells(), [&](const Index<D>& cell) {
      const int first = static_cast<int>(x_.size());
      Box places{{}, Index3::filled(1)};
      for (int d = 0; d < D; ++d) {
        if (cell[d] >= filled[d]) return;
        places.upper[d] = 2;
      }
      forEach<D>(places, [&](const Index<D>& k) {
        Vec<D> at;
        for (int d = 0; d < D; ++d) at[d] = cell[d] + 0.25 + 0.5 * k[d];
        add(at, stretched);
      });
      set_.at(cell) = {first, static_cast<int>(x_.size())};
    });
    set_.setOwned(static_cast<int>(x_.size()));
  }

  Method method;
  bool sharesVolume = false;
  std::vector<Vec<D>>& x() { return x_; }
  std::vector<Vec<D>>& force() { return force_; }
  std::vector<Vec<D>>& velocity() { return velocity_; }
  const Level& level() const { return level_; }
  /// Takes out the last particles, of one cell.
  void removeLast(int count) {
    x_.resize(x_.size() - static_cast<std::size_t>(count));
    const Index<D> cell = level_.template cellOf<D>(x_.back());
    set_.at(cell).last -= count;
    set_.setOwned(static_cast<int>(x_.size()));
  }

  std::vector<double>& temperature() { return temperature_; }
  /// Of the grid where the particle at x is, after a step of heat conduction: k = 1 W/(m K), c = 1 J/(kg K).
  double temperatureAfter(double dt, const Vec<D>& x) {
    std::vector<Material> materials{material_};
    materials[0].thermalConductivity = materials[0].specificHeat = 1;
    const Patch& patch = level_.patches().front();
    const auto view = [&](auto& values) {
      using T = std::decay_t<decltype(values[0])>;
      return ParticleViews<const T>{{ParticleView<const T>(values.data(), set_, patch.cells())}};
    };
    const auto places = view(x_), velocities = view(velocity_);
    const auto masses = view(mass_), temperatures = view(temperature_);
    const auto deformations = view(deformation_);
    const SolidViews<D> views{places,       velocities,  velocities, velocities, velocities, masses,
                              temperatures, masses,      deformations, deformations};
    const RankPatches patches{&patch};
    NodalHeat<Shape> heat(patches, materials, mpi::Communicator::alone(), Vec3(0.5, 0.5, 0.5), views);
    EXPECT_TRUE(heat.solve(dt, {"preonly", "lu", 1e-12, 1, ""}).converged);
    for (std::size_t p = 0; p < x_.size(); ++p) {
      if (x_[p] != x) continue;
      const typename Shape::Stencil stencil(level_, level_.template cellOf<D>(x), x, Extent<D>{});
      double after = 0;
      stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>&) { after += s * heat.temperature(node); });
      return after;
    }
    return 0;
  }

  ImplicitSystem<Shape> system(bool dynamic, double dt = 0.01) {
    PointGroup group;
    group.material = &material_;
    group.count = static_cast<int>(x_.size());
    group.mass = mass_.data();
    group.temperature = temperature_.data();
    group.oldDeformation = deformation_.data();
    group.oldStress = stress_.data();
    group.oldState = state_.data();
    const Patch& patch = level_.patches().front();
    const ParticleView<const Vec<D>> places(x_.data(), set_, patch.cells());
    const Extents<Shape> extents(level_, Vec3(0.5, 0.5, 0.5), std::nullopt, std::nullopt);
    ImplicitMethod how;
    how.dynamic = dynamic;
    how.sharesVolume = sharesVolume;
    return ImplicitSystem<Shape>({&patch}, mpi::Communicator::alone(), method, how, dt, state_size_,
                                 {{group, &patch, extents, places, velocity_.data(), acceleration_.data(), force_.data()}});
  }

 private:
  static grid::Domain domainAround(const Index3& filled) {
    grid::Domain domain;
    domain.upper = Vec3::Zero();
    for (int d = 0; d < D; ++d) {
      domain.resolution[d] = filled[d] + 2;
      domain.upper[d] = filled[d] + 2;
      for (const int side : {0, 1}) domain.boundaries.face(d, side).push_back({"Symmetric", "symmetry", Vec3::Zero()});
    }
    domain.nodesBeyond = Shape::ghostNodes;
    return domain;
  }
  void add(const Vec<D>& at, double stretched) {
    x_.push_back(at);
    velocity_.push_back(Vec<D>::Zero());
    acceleration_.push_back(Vec<D>::Zero());
    force_.push_back(Vec<D>::Zero());
    mass_.push_back(material_.density * std::pow(0.5, D));
    temperature_.push_back(300);
    deformation_.push_back(Matrix3::Identity());
    deformation_.back()(0, 0) = stretched;
    stress_.push_back(Matrix3::Zero());
    state_.resize(state_.size() + static_cast<std::size_t>(state_size_));
    material_.model->initialize(&state_[state_.size() - static_cast<std::size_t>(state_size_)]);
  }

  Level level_;
  int state_size_;
  Material material_;
  data::ParticleSet set_;
  std::vector<Vec<D>> x_, velocity_, acceleration_, force_;
  std::vector<double> mass_, temperature_, state_;
  std::vector<Matrix3> deformation_, stress_;
};

/// A matrix as it is: every number.
class Dense : public solvers::Matrix {
 public:
  Dense(int nodes, int block) : values(Eigen::MatrixXd::Zero(nodes * block, nodes * block)), block_(block) {}
  void add(std::span<const int> rows, std::span<const int> columns, std::span<const double> numbers) override {
    const auto width = columns.size() * static_cast<std::size_t>(block_);
    for (std::size_t r = 0; r < rows.size() * static_cast<std::size_t>(block_); ++r)
      for (std::size_t c = 0; c < width; ++c) {
        const int row = rows[r / static_cast<std::size_t>(block_)], column = columns[c / static_cast<std::size_t>(block_)];
        if (row < 0 || column < 0) continue;
        values(row * block_ + static_cast<int>(r) % block_, column * block_ + static_cast<int>(c) % block_) +=
            numbers[r * width + c];
      }
  }
  Eigen::MatrixXd values;

 private:
  int block_;
};

/// Greatest difference between the assembled tangent and central differences of the residual, over the greatest entry.
template <class Shape>
double errorOfTangent(ImplicitSystem<Shape> system, double size) {
  constexpr int D = Shape::dimension;
  const int nodes = system.nodes().size();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> drawn(-size, size);
  std::vector<double> u(static_cast<std::size_t>(nodes * D)), above(u.size()), below(u.size()), r(u.size());
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

template <class M>
std::shared_ptr<const Model> modelOf(const M& model) {
  return std::make_shared<ModelOf<M>>(model);
}

CompMooneyRivlin mooneyRivlin() {
  CompMooneyRivlin model;
  model.c1 = 1e5;
  model.c2 = 2e4;
  model.poissonRatio = 0.4;
  return model;
}
HypoElastic hypoElastic() {
  HypoElastic model;
  model.bulkModulus = 8e5;
  model.shearModulus = 2e5;
  return model;
}

solvers::NewtonSettings direct() {
  solvers::NewtonSettings settings;
  settings.linear = {"preonly", "lu", 1e-12, 1, ""};
  return settings;
}

/// The order of the last step of Newton's method whose residual is well above rounding.
double lastOrder(const std::vector<double>& r) {
  double order = 0;
  for (std::size_t k = 2; k < r.size() && r[k] > 1e-11 * r[0]; ++k)
    if (r[k - 1] < 0.1 * r[k - 2]) order = std::log(r[k] / r[k - 1]) / std::log(r[k - 1] / r[k - 2]);
  return order;
}

std::string textOf(const std::vector<double>& residuals) {
  std::string text = "residuals";
  for (const double r : residuals) text += fmt::format(" {:.3e}", r);
  return text;
}

/// The nodes of the block's lower end do not move.
template <class Shape>
void clamp(ImplicitSystem<Shape>& system) {
  for (int k = 0; k < system.nodes().size(); ++k)
    if (system.nodes().node(k)[0] <= 0)
      for (int d = 0; d < Shape::dimension; ++d) system.prescribe(k, d, 0);
}

/// How far the free end of a cantilever with Poisson's ratio .4999 sinks under its weight, m.
double sinking(const Index3& cells, double gravity, bool sharesVolume) {
  CompNeoHook model = rubber();
  model.bulkModulus = 2 * model.shearModulus * (1 + 0.4999) / (3 * (1 - 2 * 0.4999));
  Block<LinearShape<2>> block(modelOf(model), cells);
  block.method.gravity = {0, gravity, 0};
  block.sharesVolume = sharesVolume;
  ImplicitSystem<LinearShape<2>> system = block.system(false);
  clamp(system);
  std::vector<double> u = system.guess();
  EXPECT_TRUE(solvers::solver().solve(system.unknowns(), system, direct(), u).converged);
  double lowest = 0;
  for (int k = 0; k < system.nodes().size(); ++k) lowest = std::min(lowest, system.displacement(k, u)[1]);
  return -lowest;
}

}  // namespace

TEST(ImplicitSystem, HasTheTangentOfItsResidual) {
  EXPECT_LT(errorOfTangent(Block<LinearShape<1>>(modelOf(rubber()), {{3, 1, 1}}).system(true), 0.1), 1e-6);
  EXPECT_LT(errorOfTangent(Block<LinearShape<2>>(modelOf(rubber()), {{2, 2, 1}}).system(true), 0.1), 1e-6);
  EXPECT_LT(errorOfTangent(Block<GimpShape<2>>(modelOf(rubber()), {{2, 2, 1}}).system(false), 0.1), 1e-6);
  EXPECT_LT(errorOfTangent(Block<LinearShape<3>>(modelOf(rubber()), {{2, 1, 1}}).system(false), 0.1), 1e-6);
}

TEST(ImplicitSystem, HasTheTangentOfEveryMaterialFromADeformedStart) {
  for (const auto& model : {modelOf(rubber()), modelOf(mooneyRivlin()), modelOf(hypoElastic())}) {
    Block<LinearShape<2>> block(model, {{2, 2, 1}}, 1.2);
    EXPECT_LT(errorOfTangent(block.system(false), 0.1), 1e-6) << model->name();
  }
}

TEST(ImplicitSystem, HasTheTangentOfItsResidualWhereParticlesAreCompressedAsOne) {
  for (const auto& model : {modelOf(rubber()), modelOf(mooneyRivlin())}) {
    Block<LinearShape<2>> narrow(model, {{2, 2, 1}}, 1.2);
    Block<GimpShape<2>> wide(model, {{2, 1, 1}}, 1.2);
    Block<LinearShape<3>> solid(model, {{1, 1, 1}}, 0.9);
    narrow.sharesVolume = wide.sharesVolume = solid.sharesVolume = true;
    EXPECT_LT(errorOfTangent(narrow.system(false), 0.1), 1e-6) << model->name();
    EXPECT_LT(errorOfTangent(wide.system(false), 0.1), 1e-6) << model->name();
    EXPECT_LT(errorOfTangent(solid.system(false), 0.1), 1e-6) << model->name();
  }
}

TEST(ImplicitSystem, HasNoForceWhereNothingIsDeformed) {
  Block<GimpShape<2>> block(modelOf(rubber()), {{2, 2, 1}});
  ImplicitSystem<GimpShape<2>> system = block.system(false);
  std::vector<double> u(static_cast<std::size_t>(2 * system.nodes().size()), 0.0), r(u.size());
  EXPECT_TRUE(system.residual(u, r));
  for (const double value : r) EXPECT_NEAR(value, 0, 1e-9);  // rounding of 8e5 Pa m
}

TEST(ImplicitSystem, RefusesToTurnAPointInsideOut) {
  Block<LinearShape<1>> block(modelOf(rubber()), {{1, 1, 1}});
  ImplicitSystem<LinearShape<1>> system = block.system(false);
  std::vector<double> u{0, -1.5}, r(2);
  EXPECT_FALSE(system.residual(u, r));
}

TEST(ImplicitSystem, MovesFreelyUnderGravityByNewmark) {
  Block<LinearShape<2>> block(modelOf(rubber()), {{2, 2, 1}});
  block.method.gravity = {0, -10, 0};
  for (Vec<2>& v : block.velocity()) v = {3, 0};
  ImplicitSystem<LinearShape<2>> system = block.system(true, 0.1);
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
  ImplicitSystem<LinearShape<1>> system = block.system(false);
  clamp(system);
  std::vector<double> u = system.guess();

  ASSERT_TRUE(solvers::solver().solve(system.unknowns(), system, direct(), u).converged);

  const double f = 1 + system.displacement(1, u)[0];
  const Matrix3 kirchhoff = rubber().kirchhoffStress(Matrix3(Vec3(f, 1, 1).asDiagonal()));
  // The particle at 3/4 hands 3/4 of its load to the node that is free.
  EXPECT_NEAR(kirchhoff(0, 0) / f, 0.75 * load, 1e-6 * load);
}

TEST(Newton, ConvergesQuadraticallyOnACantilever) {
  Block<LinearShape<2>> block(modelOf(rubber()), {{8, 2, 1}});
  block.method.gravity = {0, -0.25, 0};
  ImplicitSystem<LinearShape<2>> system = block.system(false);
  clamp(system);
  std::vector<double> u = system.guess();

  const solvers::Outcome outcome = solvers::solver().solve(system.unknowns(), system, direct(), u);

  std::cout << textOf(outcome.residuals) << '\n';
  ASSERT_TRUE(outcome.converged) << outcome.reason;
  EXPECT_GT(lastOrder(outcome.residuals), 1.8) << textOf(outcome.residuals);
}

TEST(Newton, ConvergesQuadraticallyOnCompressedRubber) {
  Block<LinearShape<3>> block(modelOf(mooneyRivlin()), {{2, 2, 2}});
  ImplicitSystem<LinearShape<3>> system = block.system(false);
  for (int k = 0; k < system.nodes().size(); ++k)
    if (system.nodes().node(k)[2] == 2)
      for (int d = 0; d < 3; ++d) system.prescribe(k, d, d == 2 ? -0.4 : 0.0);
  clamp(system);
  std::vector<double> u = system.guess();

  const solvers::Outcome outcome = solvers::solver().solve(system.unknowns(), system, direct(), u);

  std::cout << textOf(outcome.residuals) << '\n';
  ASSERT_TRUE(outcome.converged) << outcome.reason;
  EXPECT_GT(lastOrder(outcome.residuals), 1.8) << textOf(outcome.residuals);
}

TEST(Fbar, BendsWhatIsNearlyIncompressibleWithoutLocking) {
  // Two beams of one shape under loads that bend them alike; the second has twice the cells along each axis.
  const double coarse = sinking({{8, 2, 1}}, -1e-3, true), fine = sinking({{16, 4, 1}}, -5e-4, true) / 2;
  const double locked = sinking({{8, 2, 1}}, -1e-3, false);
  EXPECT_NEAR(coarse / fine, 1, 0.15);  // bilinear cells are a little too stiff in bending
  EXPECT_LT(locked / fine, 0.3);
}

TEST(Newton, SolvesWithOneParticleInACellAtItsEdge) {
  Block<LinearShape<2>> block(modelOf(rubber()), {{3, 1, 1}});
  block.method.gravity = {1, 0, 0};
  block.removeLast(3);
  block.x().back()[0] = 2 + 1e-10;
  ImplicitSystem<LinearShape<2>> system = block.system(false);
  clamp(system);
  std::vector<double> u = system.guess();

  const solvers::Outcome outcome = solvers::solver().solve(system.unknowns(), system, direct(), u);

  EXPECT_TRUE(outcome.converged) << outcome.reason << ' ' << textOf(outcome.residuals);
}

TEST(Newton, SolvesWithACellThatHoldsAParticleAtItsEdgeOnly) {
  Block<LinearShape<2>> block(modelOf(rubber()), {{3, 1, 1}});
  for (Vec<2>& x : block.x())
    if (x[0] > 2) x[0] = 2 + 1e-10 * x[0];
  block.method.gravity = {1, 0, 0};
  ImplicitSystem<LinearShape<2>> system = block.system(false);
  clamp(system);
  std::vector<double> u = system.guess();

  const solvers::Outcome outcome = solvers::solver().solve(system.unknowns(), system, direct(), u);

  EXPECT_TRUE(outcome.converged) << outcome.reason;
}

TEST(RigidMotions, HelpMultigridWithASolid) {
  Block<LinearShape<3>> block(modelOf(rubber()), {{16, 4, 4}});
  block.method.gravity = {0, 0, -1e-3};
  const auto iterations = [&](bool told) {
    ImplicitSystem<LinearShape<3>> system = block.system(false);
    clamp(system);
    std::vector<double> u = system.guess();
    solvers::Unknowns unknowns = system.unknowns();
    if (!told) unknowns.coordinates.clear();
    solvers::NewtonSettings settings;
    settings.linear = {"gmres", "gamg", 1e-8, 1000, ""};
    const solvers::Outcome outcome = solvers::solver().solve(unknowns, system, settings, u);
    EXPECT_TRUE(outcome.converged) << outcome.reason;
    return double(outcome.krylovIterations) / outcome.newtonIterations;
  };
  const double told = iterations(true), untold = iterations(false);
  std::cout << "iterations of gmres with GAMG: " << told << ", without rigid motions " << untold << '\n';
  EXPECT_LT(told, untold / 2);
}

TEST(ImplicitHeat, SpreadsEvenlyInOneLongStepAndKeepsTheHeat) {
  Block<LinearShape<2>> block(modelOf(rubber()), {{6, 2, 1}});
  for (std::size_t p = 0; p < block.x().size(); ++p) block.temperature()[p] = block.x()[p][0] < 3 ? 400 : 300;

  // The slowest part decays at k pi²/(rho c L²) = 2.7e-4 /s: 50 K / 2.7e6 are left of it.
  for (const Vec<2>& x : block.x()) EXPECT_NEAR(block.temperatureAfter(1e10, x), 350, 1e-4);
  // In a shorter step heat goes from the warm half to the cold one, and none is lost.
  double sum = 0;
  for (const Vec<2>& x : block.x()) sum += block.temperatureAfter(1000, x);
  EXPECT_NEAR(sum / double(block.x().size()), 350, 1e-7);
  EXPECT_GT(block.temperatureAfter(1000, Vec<2>(3.75, 0.25)), block.temperatureAfter(10, Vec<2>(3.75, 0.25)) + 1);
}

TEST(ImplicitMethod, ChangesTheTimeStepByNewtonsIterations) {
  const ImplicitMethod method;
  EXPECT_EQ(method.nextTimeStep(1, 13), 0.6);
  EXPECT_EQ(method.nextTimeStep(1, 12), 1);
  EXPECT_EQ(method.nextTimeStep(1, 5), 1);
  EXPECT_EQ(method.nextTimeStep(1, 4), 2);
}

}  // namespace tushar::mpm::solid
