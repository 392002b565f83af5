#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "components/mpm/solid/implicit/conduct_heat.hpp"
#include "components/mpm/solid/implicit/system.hpp"
#include "tests/mpm/solid/constitutive/example_models.hpp"
#include "tests/support/levels.hpp"

// Plain particles, and the equations of an implicit step on them.

namespace tushar::mpm::solid::implicit::testing {

using namespace solid::testing;

inline CompNeoHook rubber() { return withModuli<CompNeoHook>(8e5, 2e5); }
inline CompMooneyRivlin mooneyRivlin() { return compMooneyRivlin(1e5, 2e4, 0.4); }

template <class M>
std::shared_ptr<const Model> modelOf(const M& model) {
  return std::make_shared<ModelOf<M>>(model);
}

/// A grid of unit cells between symmetry planes, two cells larger than `filled` along each axis in use.
inline grid::Domain domainAround(const Index3& filled) {
  grid::Domain domain;
  domain.upper = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    if (filled[axis] == 0) continue;
    domain.resolution[axis] = filled[axis] + 2;
    domain.upper[axis] = filled[axis] + 2;
    for (const int side : {0, 1})
      domain.boundaries.face(axis, side).push_back({grid::symmetric, grid::BoundaryKind::symmetry});
  }
  domain.nodesBeyond = 1;
  return domain;
}

/// A block of particles, two along each axis of a cell, on a grid of unit cells between symmetry planes.
template <class Shape>
class Block {
 public:
  static constexpr int D = Shape::dimension;

  /// Fills the `filled` cells next to the lower corner. `stretched` > 1 pulls the block apart before the step.
  Block(std::shared_ptr<const Model> model, const Index3& filled, double stretched = 1)
      : grid_(domainAround(restricted(filled))), state_size_(std::max(1, model->stateSize())) {
    material_.density = 1000;
    material_.model = std::move(model);
    const Patch& patch = grid_.patches().front();
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
  bool sharesVolume = false, resetsGrid = true;
  std::vector<Vec<D>>& x() { return x_; }
  std::vector<Vec<D>>& force() { return force_; }
  std::vector<Vec<D>>& velocity() { return velocity_; }
  const Level& level() const { return level_; }
  /// Removes the last `count` particles, all of one cell.
  void removeLast(int count) {
    x_.resize(x_.size() - count);
    const Index<D> cell = level_.template cellOf<D>(x_.back());
    set_.at(cell).last -= count;
    set_.setOwned(static_cast<int>(x_.size()));
  }

  const std::vector<double>& mass() const { return mass_; }
  std::vector<double> heatFlux;  ///< heat flow to each particle [W]; empty: none
  std::vector<double>& temperature() { return temperature_; }
  /// Returns the grid temperature [K] at x after a step of heat conduction: k = 1 W/(m K), c = 1 J/(kg K).
  double temperatureAfter(double dt, const Vec<D>& x) {
    std::vector<Material> materials{material_};
    materials[0].thermalConductivity = materials[0].specificHeat = 1;
    const Patch& patch = grid_.patches().front();
    const HeatedParticles<D> heated{.placed = {.x = view(x_), .size = std::nullopt, .deformation = std::nullopt},
                                    .mass = view(mass_),
                                    .temperature = view(temperature_),
                                    .deformation = view(deformation_),
                                    .heatFlux = heatFlux.empty() ? OptionalView<const double>() : view(heatFlux)};
    const OfRank<HeatedParticles<D>> particles{{heated}};
    const RankPatches patches{&patch};
    NodalHeat<D> heat(patches, materials, mpi::Communicator::alone(), shapesOf<Shape>, Vec3(0.5, 0.5, 0.5), particles,
                      resetsGrid);
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

  ImplicitSystem<D> system(bool dynamic, double dt = 0.01) {
    const Patch& patch = grid_.patches().front();
    const PointSources<D> sources{.group = {.material = &material_,
                                            .count = static_cast<int>(x_.size()),
                                            .mass = mass_.data(),
                                            .temperature = temperature_.data(),
                                            .oldDeformation = deformation_.data(),
                                            .oldStress = stress_.data(),
                                            .oldState = state_.data()},
                                  .patch = &patch,
                                  .placed = {.x = view(x_), .size = std::nullopt, .deformation = std::nullopt},
                                  .velocity = velocity_.data(),
                                  .acceleration = acceleration_.data(),
                                  .externalForce = force_.data()};
    ImplicitMethod how;
    how.dynamic = dynamic;
    how.sharesVolume = sharesVolume;
    how.resetsGrid = resetsGrid;
    Method halves = method;
    halves.commonSize = {0.5, 0.5, 0.5};
    return ImplicitSystem<D>({&patch}, mpi::Communicator::alone(), shapesOf<Shape>, halves, how, dt, state_size_,
                             {sources});
  }

 private:
  template <class T>
  ParticleView<const T> view(const std::vector<T>& values) const {
    return {values.data(), set_, grid_.patches().front().cells()};
  }
  static Index3 restricted(const Index3& filled) {
    Index3 cells;
    for (int d = 0; d < D; ++d) cells[d] = filled[d];
    return cells;
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
    state_.resize(state_.size() + state_size_);
    material_.model->initialize(&state_[state_.size() - state_size_], {});
  }

  Grid grid_;
  const Level& level_ = grid_.level();
  int state_size_;
  Material material_;
  data::ParticleSet set_;
  std::vector<Vec<D>> x_, velocity_, acceleration_, force_;
  std::vector<double> mass_, temperature_, state_;
  std::vector<Matrix3> deformation_, stress_;
};

/// Settings of Newton's method with a direct solver for the linear systems.
inline solvers::NewtonSettings direct() {
  solvers::NewtonSettings settings;
  settings.linear = {"preonly", "lu", 1e-12, 1, ""};
  return settings;
}

/// Fixes the nodes at the lower end of the block.
template <int D>
void clamp(ImplicitSystem<D>& system) {
  for (int k = 0; k < system.nodes().size(); ++k)
    if (system.nodes().node(k)[0] <= 0)
      for (int d = 0; d < D; ++d) system.prescribe(k, d, 0);
}

}  // namespace tushar::mpm::solid::implicit::testing
