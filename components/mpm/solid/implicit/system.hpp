#pragma once

#include "components/mpm/solid/implicit/material_points.hpp"
#include "components/mpm/solid/implicit/method.hpp"
#include "components/mpm/solid/implicit/node_map.hpp"

namespace tushar::mpm::solid::implicit {

/// What particles bring to an implicit step, besides what PointGroup says.
template <class Shape>
struct PointSources {
  static constexpr int D = Shape::dimension;

  PointGroup group;
  const Patch* patch = nullptr;
  Extents<Shape> extents;
  ParticleView<const Vec<D>> x;
  const Vec<D>*velocity, *acceleration, *externalForce;  ///< m/s, m/s^2, N
};

/// The equations of an implicit step: forces balance at each node at the end of the step,
///
///     r_i = sum_p V0_p P_p F_oldᵀ grad S_i + m_i a_i - f_i - m_i g = 0,
///
/// for the displacement u of the nodes in the step, with P = J sigma F^-T, F = (I + sum_i u_i grad S_i) F_old and S_i
/// at the positions at its begin, or where the grid goes along with the solid at those of the start, so that grad S =
/// F_old^-T grad_0 S. By Newmark's rule with beta = 1/4, gamma = 1/2: a = 4 (u/dt - v_old)/dt - a_old.
/// Guilkey & Weiss, Int. J. Numer. Meth. Engng 57 (2003) 1323.
template <class Shape>
class ImplicitSystem : public solvers::NonlinearProblem {
 public:
  static constexpr int D = Shape::dimension;

  /// `patches` are those of this rank; all `ranks` make the system together.
  ImplicitSystem(const RankPatches& patches, const mpi::Communicator& ranks, const Method& method,
                 const ImplicitMethod& how, double dt, int stateSize, std::vector<PointSources<Shape>> sources);

  const NodeMap<D>& nodes() const { return map_; }
  solvers::Unknowns unknowns() const;
  /// The node's displacement along an axis is `value`, m.
  void prescribe(int node, int d, double value);
  /// Where every node would be with its velocity, m; prescribed values as they are.
  std::vector<double> guess() const;

  bool residual(std::span<const double> u, std::span<double> r) override;
  void tangent(solvers::Matrix& matrix) override;
  /// Whether no node has more of a residual than 1e-14 of the forces that it is the sum of, the stresses of particles
  /// counted as those of a strain of 1.
  bool isNegligible(std::span<const double> u, std::span<const double> r) const override;

  /// What each node is accelerated by when a run starts: (f + m g - sum_p V_p sigma_p grad S) / m, 0 where prescribed,
  /// m/s^2. Newmark's rule begins with it: without, a load that is there from the start would lose half a step of its
  /// momentum.
  std::vector<double> startingAcceleration();

  /// The forces that hold the nodes of this rank where they are prescribed, along the axes along which they are, N.
  std::vector<double> reactions() const;

  /// Of a node, from its displacement in the step, m/s^2; 0 where inertia is left out.
  Vec<D> acceleration(int node, std::span<const double> u) const;
  Vec<D> displacement(int node, std::span<const double> u) const {
    return Eigen::Map<const Vec<D>>(u.data() + D * node);
  }

 private:
  template <class Visit>
  void forEachRun(Visit&& visit) const {
    for (const Run& run : runs_)
      visit(sources_[run.source], PointRun{&sources_[run.source].group, run.from, run.count});
  }
  static constexpr int touches_ = [] {
    int count = 1;
    for (int d = 0; d < D; ++d) count *= Shape::Stencil::nodes;
    return count;
  }();
  // All of touches_ * D rows or columns; sizes that the compiler does not unroll.
  using Strain = Eigen::Matrix<double, 9, Eigen::Dynamic, Eigen::ColMajor, 9, touches_ * D>;
  using Local = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, touches_ * D, touches_ * D>;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, touches_ * D, 1>;

  /// What the particles bring to a node of the system, in the order of the numbers in which it is summed.
  struct Node {
    double mass = 0, volume = 0;  ///< kg, m^3 at the start of the simulation
    double rigidity = 0;          ///< N, sum of the forces of particles at a strain of 1
    Vec<D> velocity = Vec<D>::Zero(), acceleration = Vec<D>::Zero(), force = Vec<D>::Zero();  ///< mass times, at first
    double support = 0;  ///< N/m, of a weak spring to where the node would go by itself
  };
  static constexpr int brought_ = 3 + 3 * D;

  void findRuns();
  void findNodes(const RankPatches& patches);
  void carrySlopes();
  void gatherNodes();
  void shareNodes(const std::vector<double>& sums);
  void measureStiffness();
  void supportNodes();
  const NodeTouch<D>* touchesOf(std::size_t point) const { return &touch_[point * touches_]; }
  Matrix3 displacementGradient(std::size_t point, std::span<const double> u) const;
  bool addInternalForces(std::span<const double> u, std::span<double> r);
  void addInternalForce(const PointRun& run, std::span<double> r) const;
  Strain strainOf(std::size_t point) const;
  Local stiffnessOf(const PointGroup& group, int k, const Matrix9& tangent) const;
  void addStiffness(const PointGroup& group, int k, Local stiffness, solvers::Matrix& matrix) const;
  void addRunStiffness(const PointRun& run, solvers::Matrix& matrix);
  std::array<int, touches_> numbersOf(std::size_t point) const;
  Rows volumeRow(std::size_t point) const;
  Rows volumeForce(const PointGroup& group, int k, const Matrix9& tangent) const;
  void addSharedStiffness(const PointRun& run, const std::vector<Rows>& forces, solvers::Matrix& matrix) const;
  void addDiagonals(solvers::Matrix& matrix) const;
  bool isPrescribed(int node, int d) const { return prescribed_[static_cast<std::size_t>(D * node + d)] != 0; }

  Method method_;
  ImplicitMethod how_;
  double dt_;
  NodeMap<D> map_;
  std::vector<PointSources<Shape>> sources_;
  struct Run {
    std::uint64_t cell;
    std::size_t source;
    int from, count;
  };
  std::vector<Run> runs_;  ///< cell by cell, in the order of every sum, which does not depend on the patches
  std::vector<NodeTouch<D>> touch_;
  PointStates states_;
  std::vector<Node> node_;
  std::vector<char> prescribed_;
  std::vector<double> prescribed_value_;
  std::vector<double> held_;  ///< what this rank brings to reactions
  double stiffest_ = 0;       ///< of all particles at the start of the simulation: rho c^2 V / h^2, N/m
};

}  // namespace tushar::mpm::solid::implicit
