#pragma once

#include <Eigen/LU>

#include "components/mpm/boundary_labels.hpp"
#include "components/mpm/solid/implicit/node_map.hpp"
#include "components/mpm/solid/implicit/particles.hpp"

namespace tushar::mpm::solid::implicit {

/// Heat conduction in a step by backward Euler, for the temperature T' of all nodes:
///
///     (C_i + dt K_ij) T'_j = C_i T_i + dt sum_p S_i Q_p,
///     C_i = sum_p S_i m_p c_p,  K_ij = sum_p V_p k_p grad S_i . grad S_j,
///
/// where T_i is the mean of the particles' temperatures, weighted by their heat capacities, and Q_p the heat flow from
/// loads. All materials have the same temperature at a node. A side of the grid has the temperature that the scene
/// specifies; otherwise it is insulated.
template <int D>
class NodalHeat {
 public:
  NodalHeat(const RankPatches& patches, const std::vector<Material>& materials, const mpi::Communicator& ranks,
            const ImplicitShapes<D>& shapes, const Vec3& commonSize, const OfRank<HeatedParticles<D>>& particles,
            bool resetsGrid = true)
      : patches_(patches),
        materials_(materials),
        shapes_(shapes),
        common_size_(commonSize),
        particles_(particles),
        resets_grid_(resetsGrid),
        nodes_(patches.front()->level(), ranks) {
    std::vector<ParticlesOnPatch<D>> list;
    for (std::size_t p = 0; p < patches.size(); ++p)
      for (std::size_t m = 0; m < materials.size(); ++m)
        list.push_back({patches[p], particles[p][m].placed.x, static_cast<int>(m)});
    cells_ = occupiedCells<D>(list);
    forEachPoint([&](const Point&, Touched touched) {
      for (const Touch<D>& touch : touched)
        if (touch.s != 0 || touch.gradient.squaredNorm() > 0) nodes_.touch(nodes_.imageOf(touch.node).node);
    });
    nodes_.number(patches, shapes.shaped.shape.ghostNodes + 1);
    gather();
  }

  solvers::Outcome solve(double dt, const solvers::LinearSettings& settings) {
    solvers::Unknowns unknowns = nodes_.unknowns(1);
    unknowns.entries = nodes_.neighbours(shapes_.nodes - 1);
    after_ = before_;
    std::vector<double> right(after_.size(), 0.0);
    const auto assemble = [&](solvers::Matrix& matrix) { this->assemble(dt, matrix, right); };
    const int owned = nodes_.owned();
    solvers::Outcome outcome =
        solvers::solve(unknowns, {assemble, std::span(right).first(owned)}, settings, std::span(after_).first(owned));
    std::fill(after_.begin() + owned, after_.end(), 0.0);
    solvers::addUp(nodes_.unknowns(1), after_);
    return outcome;
  }
  /// Temperature change T' - T of a node [K]; 0 at nodes without particles.
  double change(const Index<D>& node) const {
    const int k = nodes_(nodes_.imageOf(node).node);
    return k < 0 ? 0.0 : after_[k] - before_[k];
  }
  /// Temperature T' of a node [K].
  double temperature(const Index<D>& node) const { return after_[nodes_(nodes_.imageOf(node).node)]; }
  const NodeMap<D>& nodes() const { return nodes_; }

 private:
  using Touched = std::span<const Touch<D>>;
  struct Point {
    const Material& material;
    double mass, temperature, volume;  ///< mass [kg], temperature [K], volume [m^3]
    double heatFlux;                   ///< heat flow from loads [W]
    Matrix3 carried;                   ///< A in grad S = A^T grad_0 S: F^-1, or I if the grid is reset
  };

  /// Calls `visit(point, touched)` for each particle of the rank, in an order that patches do not change.
  template <class Visit>
  void forEachPoint(Visit&& visit) const {
    const HeatedParticles<D>* heated = nullptr;
    const Material* material = nullptr;
    const VisitTouches<D> visitOne = [&](int k, Touched touched) {
      const double mass = heated->mass[k], volume = mass / material->undeformedDensity();
      const Matrix3& f = heated->deformation[k];
      const Matrix3 carried = resets_grid_ ? Matrix3(Matrix3::Identity()) : Matrix3(f.inverse());
      const double flux = heated->heatFlux ? (*heated->heatFlux)[k] : 0.0;
      visit(Point{*material, mass, heated->temperature[k], volume * f.determinant(), flux, carried}, touched);
    };
    for (const OccupiedCell& of : cells_) {
      const std::size_t patch = of.source / materials_.size(), m = of.source % materials_.size();
      heated = &particles_[patch][m];
      material = &materials_[m];
      shapes_.forEachTouched(*patches_[patch], of.cell, heated->placed, common_size_, visitOne);
    }
  }
  void gather() {
    std::vector<double> sums(2 * nodes_.size(), 0.0);
    forEachPoint([&](const Point& point, Touched touched) {
      for (const Touch<D>& touch : touched) {
        const int k = nodes_(nodes_.imageOf(touch.node).node);
        if (k < 0) continue;
        const double capacity = touch.s * point.mass * point.material.specificHeat;
        sums[2 * k] += capacity;
        sums[2 * k + 1] += capacity * point.temperature;
      }
    });
    solvers::addUp(nodes_.unknowns(2), sums);
    for (std::size_t k = 0; k < sums.size(); k += 2) least_ = std::max(least_, sums[k]);
    least_ = 1e-12 * nodes_.ranks().max(least_);
    const grid::BoundarySides<double> sides = nodes_.level().sides(boundary::temperature);
    for (int k = 0; k < nodes_.size(); ++k) {
      const double capacity = sums[2 * k], heat = sums[2 * k + 1];
      capacity_.push_back(capacity);
      before_.push_back(capacity > 0 ? heat / capacity : 0.0);
      given_.push_back(givenAt(nodes_.node(k), sides));
    }
  }
  /// The temperature that a side of the grid prescribes at a node [K].
  std::optional<double> givenAt(const Index<D>& node, const grid::BoundarySides<double>& sides) const {
    const Level& level = nodes_.level();
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) {
        const int face = side == 0 ? 0 : level.cells().extent(d);
        if (level.isPeriodic(d) || (side == 0 ? node[d] > face : node[d] < face)) continue;
        const auto& given = sides(d, side);
        if (given && given->isDirichlet()) return given->value;
      }
    return std::nullopt;
  }
  void assemble(double dt, solvers::Matrix& matrix, std::vector<double>& right) const {
    const Level& level = nodes_.level();
    forEachPoint([&](const Point& point, Touched touched) {
      std::array<int, mostTouches<D>> numbers;
      std::array<Vec<D>, mostTouches<D>> slopes;
      for (std::size_t n = 0; n < touched.size(); ++n) {
        const Vec3 slope = level.template expandDirection<D>(touched[n].gradient);
        numbers[n] = nodes_(nodes_.imageOf(touched[n].node).node);
        slopes[n] = level.template reduce<D>(Vec3(slope.transpose() * point.carried));
        if (numbers[n] >= 0 && !given_[numbers[n]]) right[numbers[n]] += dt * touched[n].s * point.heatFlux;
      }
      addPoint(dt * point.volume * point.material.thermalConductivity, std::span(numbers).first(touched.size()),
               std::span(slopes).first(touched.size()), matrix, right);
    });
    for (int k = 0; k < nodes_.owned(); ++k) {
      const double diagonal = std::max(capacity_[k], least_);
      matrix.add({&k, 1}, {&k, 1}, {&diagonal, 1});
      right[k] += diagonal * given_[k].value_or(before_[k]);
    }
    solvers::addUp(nodes_.unknowns(1), right);
  }
  /// Adds a particle. Removes the rows and columns of nodes with a given temperature; the right-hand side includes
  /// their effect on other nodes.
  void addPoint(double factor, std::span<const int> numbers, std::span<const Vec<D>> slopes, solvers::Matrix& matrix,
                std::vector<double>& right) const {
    const std::size_t count = numbers.size();
    std::array<double, mostTouches<D> * mostTouches<D>> block{};
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j) {
        if (numbers[i] < 0 || numbers[j] < 0 || given_[numbers[i]]) continue;
        const double value = factor * slopes[i].dot(slopes[j]);
        if (const auto& given = given_[numbers[j]])
          right[numbers[i]] -= value * *given;
        else
          block[i * count + j] = value;
      }
    matrix.add(numbers, numbers, std::span(block).first(count * count));
  }

  const RankPatches& patches_;
  const std::vector<Material>& materials_;
  const ImplicitShapes<D>& shapes_;
  Vec3 common_size_;
  const OfRank<HeatedParticles<D>>& particles_;
  bool resets_grid_;
  std::vector<OccupiedCell> cells_;
  NodeMap<D> nodes_;
  std::vector<double> capacity_, before_, after_;  ///< heat capacity [J/K], temperature before and after the step [K]
  /// Smallest heat capacity of a node, for nodes to which particles contribute only gradients [J/K].
  double least_ = 0;
  std::vector<std::optional<double>> given_;  ///< given temperatures [K]
};

/// Computes the rate of change of the nodal temperatures in the step. Throws NumericalError if the solver fails.
template <int D>
void conductHeat(const RankPatches& patches, const std::vector<Material>& materials, const mpi::Communicator& ranks,
                 const ImplicitSetup<D>& setup, double dt, const OfRank<HeatedParticles<D>>& particles,
                 const OfRank<NodeView<double>>& rate) {
  NodalHeat<D> heat(patches, materials, ranks, *setup.shapes, setup.problem->method.commonSize, particles,
                    setup.how.resetsGrid);
  const solvers::Outcome outcome = heat.solve(dt, setup.how.heat);
  if (!outcome.converged) {
    std::optional<Vec3> worst;
    if (outcome.worst >= 0)
      worst = patches.front()->level().template expandPoint<D>(heat.nodes().position(outcome.worst));
    throw NumericalError(
        solvers::sentenceOf("the conduction of heat", outcome) + solvers::worstPlace(ranks, worst, "at the node"),
        "a smaller <delt_max>", "g.temperatureRate");
  }
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (std::size_t m = 0; m < materials.size(); ++m)
      forEach<D>(patches[p]->nodes(), [&](const Index<D>& node) { rate[p][m][node] = heat.change(node) / dt; });
}

}  // namespace tushar::mpm::solid::implicit
