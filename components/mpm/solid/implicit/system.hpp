#pragma once

#include "components/mpm/solid/implicit/material_points.hpp"
#include "components/mpm/solid/implicit/method.hpp"
#include "components/mpm/solid/implicit/node_map.hpp"
#include "components/mpm/solid/implicit/shapes.hpp"

namespace tushar::mpm::solid::implicit {

/// Particles in an implicit step: positions, shape functions, motion and loads, apart from their state, which is in
/// PointGroup.
template <int D>
struct PointSources {
  PointGroup group;
  const Patch* patch = nullptr;
  Placed<D> placed;
  const Vec<D>* velocity = nullptr;       ///< velocity [m/s]
  const Vec<D>* acceleration = nullptr;   ///< acceleration [m/s^2]; null in the first step of a run, for 0
  const Vec<D>* externalForce = nullptr;  ///< external force [N]
};

/// The equations of an implicit step: at its end the forces at each node balance,
///
///     r_i = sum_p V0_p P_p F_oldᵀ grad S_i + m_i a_i - f_i - m_i g = 0,
///
/// with P = J sigma F^-T and F = (I + sum_i u_i grad S_i) F_old. The unknown is the nodal displacement u in the step.
/// S_i is evaluated at the particle positions at the start of the step or, if the grid moves with the solid, of the
/// run, so that grad S = F_old^-T grad_0 S. By Newmark's rule with beta = 1/4, gamma = 1/2: a = 4 (u/dt - v_old)/dt
/// - a_old. Guilkey & Weiss, Int. J. Numer. Meth. Engng 57 (2003) 1323.
template <int D>
class ImplicitSystem : public solvers::NonlinearProblem {
 public:
  /// Constructs the system for the particles of `patches`, all patches of this rank; the `ranks` together form one
  /// system.
  ImplicitSystem(const RankPatches& patches, const mpi::Communicator& ranks, const ImplicitShapes<D>& shapes,
                 const Method& method, const ImplicitMethod& how, double dt, int stateSize,
                 std::vector<PointSources<D>> sources);

  const NodeMap<D>& nodes() const { return map_; }
  solvers::Unknowns unknowns() const;
  /// Prescribes the displacement of a node along an axis, `value` [m].
  void prescribe(int node, int d, double value);
  /// Holds a node on a symmetry plane normal to an axis. Its velocity and acceleration along this axis are 0, because
  /// particles beyond the plane move the opposite way.
  void holdAtPlane(int node, int d);
  /// The initial guess: the displacement of each node due to its velocity [m], or the prescribed one.
  std::vector<double> guess() const;
  /// Sets the prescribed displacements in `u` [m]. A linear solver keeps them only to its tolerance.
  void hold(std::span<double> u) const;

  /// The residual at `u` with the prescribed displacements.
  bool residual(std::span<const double> u, std::span<double> r) override;
  void tangent(solvers::Matrix& matrix) override;
  /// Whether the residual of every node is at most 1e-14 of the sum of the forces on it, where each particle
  /// contributes its stress at a strain of 1.
  bool isNegligible(std::span<const double> u, std::span<const double> r) const override;

  /// The acceleration of each node at the start of a run: (f + m g - sum_p V_p sigma_p grad S) / m, 0 if prescribed
  /// [m/s^2]. Newmark's rule needs it: a load that acts from the start would otherwise lose half a step of its
  /// momentum.
  std::vector<double> startingAcceleration();

  /// The forces that enforce the prescribed displacements, at the nodes of this rank [N]; 0 along free axes.
  std::vector<double> reactions() const;

  /// Acceleration of a node at the end of the step, computed from its displacement u [m/s^2]; 0 without inertia. It is
  /// that of Newmark's rule, 4 (u/dt - v)/dt - a, or, where the displacement is prescribed, 2 (u/dt - v)/dt - a: then
  /// the node ends the step with the prescribed velocity u/dt, instead of 2 u/dt - v, which would swing about it.
  Vec<D> acceleration(int node, std::span<const double> u) const;
  Vec<D> displacement(int node, std::span<const double> u) const {
    return Eigen::Map<const Vec<D>>(u.data() + D * node);
  }

 private:
  template <class Visit>
  void forEachRun(Visit&& visit) const {
    for (const OccupiedCell& run : runs_)
      visit(sources_[run.source], PointRun{&sources_[run.source].group, run.particles.first, run.particles.size()});
  }
  /// Nodes are processed in groups of this size, which fill the lanes of a register.
  static constexpr int lanes_ = 4;
  static constexpr int mostNodes_ = (static_cast<int>(mostTouches<D>) + lanes_ - 1) / lanes_ * lanes_;
  /// A number for each component i of the displacement of each node n near a point, at [i][n].
  using Rows = std::array<std::array<double, mostNodes_>, D>;
  /// The displacement gradient at a point for unit displacements of the nodes that move it.
  struct Slopes {
    int count = 0;                              ///< number of nodes
    std::array<int, mostTouches<D>> numbers{};  ///< their numbers
    std::array<Rows, D> along;                  ///< along[j][i][n]: component i, j; 0 from n = count on
    Rows hoop;                                  ///< the hoop strain of axisymmetric scenes
    bool hasHoop = false;

    int padded() const { return (count + lanes_ - 1) / lanes_ * lanes_; }
    bool hasSameNodes(const Slopes& other) const {
      return std::equal(numbers.begin(), numbers.begin() + count, other.numbers.begin(),
                        other.numbers.begin() + other.count);
    }
  };
  /// The stiffness of the points that touch the same nodes: rows[D n + i] for component i of node n.
  struct Local {
    std::array<Slopes, 2> slopes;  ///< of the latest point and of the next
    int latest = 0;
    std::vector<Rows> rows = std::vector<Rows>(D * mostTouches<D>);
    std::vector<double> values;  ///< the same, as the matrix takes them
  };
  /// a_ijkl at [D i + j][D k + l]; the last row and column belong to the hoop strain.
  using Spatial = std::array<std::array<double, D * D + 1>, D * D + 1>;

  /// Sums over the particles at a node of the system, in the order in which gatherNodes packs them.
  struct Node {
    double mass = 0, volume = 0;  ///< mass [kg], and volume at the start of the simulation [m^3]
    double rigidity = 0;          ///< sum of the forces that particles would exert at a strain of 1 [N]
    /// Velocity [m/s], acceleration [m/s^2], force [N].
    Vec<D> velocity = Vec<D>::Zero(), acceleration = Vec<D>::Zero(), force = Vec<D>::Zero();
    double support =
        0;  ///< stiffness [N/m] of a weak spring that pulls the node to the position that follows from its velocity
  };
  static constexpr int sums_ = 3 + 3 * D;

  void findRuns();
  void findNodes(const RankPatches& patches);
  void carrySlopes();
  void gatherNodes();
  void shareNodes(const std::vector<double>& sums);
  void measureStiffness();
  void supportNodes();
  Slopes slopesOf(std::size_t point) const {
    Slopes slopes;
    findSlopes(point, slopes);
    return slopes;
  }
  const NodeTouch<D>* touchesOf(std::size_t point) const { return &touch_[point * touches_]; }
  Matrix3 displacementGradient(std::size_t point, std::span<const double> u) const;
  bool addInternalForces(std::span<const double> u, std::span<double> r);
  void addInternalForce(const PointRun& run, std::span<double> r) const;
  void findSlopes(std::size_t point, Slopes& slopes) const;
  Spatial spatialTangent(const PointGroup& group, int k, const Matrix9& tangent, bool hasHoop) const;
  void addHoopForce(const Spatial& a, const Slopes& slopes, int i, int n, std::array<double, D * D + 1>& force) const;
  void addStiffnessOf(const Spatial& a, Local& local) const;
  /// Adds the stiffness between nodes to the matrix, without the rows and columns of prescribed displacements.
  void addStiffness(Local& local, solvers::Matrix& matrix) const;
  void addRunStiffness(const PointRun& run, solvers::Matrix& matrix);
  Rows contracted(const Slopes& slopes, const Matrix3& with) const;
  Rows volumeRow(std::size_t point, const Slopes& slopes) const;
  Rows volumeForce(const PointGroup& group, int k, const Matrix9& tangent, const Slopes& slopes) const;
  void addSharedStiffness(const PointRun& run, const std::vector<Rows>& forces, solvers::Matrix& matrix) const;
  void addDiagonals(solvers::Matrix& matrix) const;
  bool isPrescribed(int node, int d) const { return prescribed_[D * node + d] != 0; }

  const ImplicitShapes<D>& shapes_;
  int touches_;  ///< number of nodes near each point
  Method method_;
  ImplicitMethod how_;
  double dt_;
  NodeMap<D> map_;
  std::vector<PointSources<D>> sources_;
  std::vector<OccupiedCell> runs_;  ///< particles cell by cell: the order of every sum, for any patches
  std::vector<NodeTouch<D>> touch_;
  PointStates states_;
  Local local_;
  std::vector<Node> node_;
  std::vector<char> prescribed_;
  std::vector<double> prescribed_value_;
  std::vector<double> held_;  ///< contribution of this rank to the reactions [N]
  double stiffest_ = 0;       ///< largest rho c^2 V / h^2 of all particles at the start of the simulation [N/m]
};

}  // namespace tushar::mpm::solid::implicit
