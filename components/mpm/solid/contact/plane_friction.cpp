#include "components/mpm/solid/contact/plane_friction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "components/mpm/solid/contact/friction.hpp"
#include "components/mpm/solid/transfer/node_windows.hpp"
#include "core/base/lane_functions.hpp"

namespace tushar::mpm::solid {

namespace {

constexpr int mostSteps = 51;
constexpr double tolerance = 1e-7;
/// A body with less mass than this at a node is ignored there [kg], as in Uintah.
constexpr double leastMass = 1e-16;
/// Bodies that are less than this fraction of a cell apart touch: faces that meet differ by their rounding errors.
constexpr double touchTolerance = 1e-9;

template <int N>
using Square = Eigen::Matrix<double, N, N>;
template <int N>
using Column = Eigen::Matrix<double, N, 1>;

/// The sum of a(row, i) b[i] over i from `last` - 1 down to `first`.
template <int N>
double sumInRow(const Square<N>& a, const Column<N>& b, int row, int first, int last) {
  if (first == last) return 0;
  double sum = a(row, last - 1) * b[last - 1];
  for (int i = last - 2; i >= first; --i) sum = a(row, i) * b[i] + sum;
  return sum;
}

/// Eliminates column k below its largest entry, which is moved to row k.
template <int N>
void eliminate(Square<N>& a, Column<N>& b, int k) {
  int pivot = k;
  for (int i = k + 1; i < N; ++i)
    if (std::abs(a(i, k)) > std::abs(a(pivot, k))) pivot = i;
  a.row(k).swap(a.row(pivot));
  std::swap(b[k], b[pivot]);
  if (a(k, k) == 0) return;
  for (int i = k + 1; i < N; ++i) {
    a(i, k) /= a(k, k);
    for (int j = k + 1; j < N; ++j) a(i, j) -= a(i, k) * a(k, j);
  }
}

/// The solution x of a x = b by Gaussian elimination with partial pivoting. (Eigen's solver takes ten times as long to
/// compile.)
template <int N>
Column<N> solved(Square<N> a, Column<N> b) {
  for (int k = 0; k < N; ++k) eliminate<N>(a, b, k);
  for (int i = 1; i < N; ++i) b[i] -= sumInRow<N>(a, b, i, 0, i);
  for (int i = N - 1; i >= 0; --i) {
    if (i < N - 1) b[i] -= sumInRow<N>(a, b, i, i + 1, N);
    b[i] /= a(i, i);
  }
  return b;
}

/// The particles of a regression, one list for each coordinate, filled up to whole registers. With X = phi . (x, 1) and
/// c = 1 for the particles of other bodies, -1 for those of the leader, the function f = tanh(X / 2) approximates c.
template <int D>
struct Regression {
  std::array<std::vector<double>, D> x;  ///< coordinates relative to the node [m]
  std::vector<double> side;              ///< c
  std::vector<double> slope, missing;    ///< df/dX and (c - f) df/dX for the current phi
  std::size_t count;

  explicit Regression(const std::vector<SidedParticle<D>>& particles) : count(particles.size()) {
    const std::size_t whole = (count + Lanes::count - 1) / Lanes::count * Lanes::count;
    for (std::vector<double>& list : x) list.resize(whole);
    for (std::vector<double>* list : {&side, &slope, &missing}) list->resize(whole);
    for (std::size_t p = 0; p < count; ++p) {
      for (int d = 0; d < D; ++d) x[d][p] = particles[p].x[d];
      side[p] = particles[p].isOther ? 1.0 : -1.0;
    }
  }
  /// Far from the plane, f differs from c by less than the rounding error of 1, and df/dX by as little from 0. So both
  /// are found from e^|X|, not from f.
  void evaluate(const Column<D + 1>& phi) {
    for (std::size_t p = 0; p < slope.size(); p += Lanes::count) {
      Lanes sum = phi[0] * Lanes::at(&x[0][p]);
      for (int d = 1; d < D; ++d) sum += phi[d] * Lanes::at(&x[d][p]);
      sum += phi[D];
      const Lanes c = Lanes::at(&side[p]), size = select(sum < Lanes(0.0), -sum, sum);
      const Lanes e = exponential(select(size < Lanes(700.0), size, Lanes(700.0)));
      const Lanes inverse = 1.0 / (e + 1.0), steep = 2.0 * e * inverse * inverse;
      const Lanes distance = select(sum * c < Lanes(0.0), 2.0 * e * inverse, 2.0 * inverse);
      steep.copyTo(&slope[p]);
      (steep * distance * c).copyTo(&missing[p]);
    }
  }
};

/// Performs one step of the regression: (J^T J + lambda) change = J^T (c - f) - lambda phi.
template <int D>
Column<D + 1> step(Regression<D>& particles, double lambda, const Column<D + 1>& phi) {
  std::array<std::array<double, D + 1>, D + 1> matrix{};
  std::array<double, D + 1> right{};
  for (int d = 0; d < D; ++d) {
    matrix[d][d] = lambda;
    right[d] = -lambda * phi[d];
  }
  particles.evaluate(phi);
  for (std::size_t p = 0; p < particles.count; ++p) {
    std::array<double, D + 1> x;
    for (int d = 0; d < D; ++d) x[d] = particles.x[d][p];
    x[D] = 1;
    const double slope = particles.slope[p];
    for (int i = 0; i <= D; ++i) {
      const double weighted = slope * slope * x[i];
      for (int j = i; j <= D; ++j) matrix[i][j] += weighted * x[j];
      right[i] += particles.missing[p] * x[i];
    }
  }
  Square<D + 1> all;
  Column<D + 1> b;
  for (int i = 0; i <= D; ++i) {
    for (int j = i; j <= D; ++j) all(i, j) = all(j, i) = matrix[i][j];
    b[i] = right[i];
  }
  return solved<D + 1>(all, b);
}

/// Index of the material, of those present at a node, to which the plane there belongs; -1 if there is no plane.
template <int D>
int foremost(const SeparatingPlanes<D>& planes, std::span<const std::size_t> bodies, const Index<D>& node) {
  for (const std::size_t m : bodies)
    if (!(*planes[m].normal)[node].isZero()) return static_cast<int>(m);
  return -1;
}

/// Whether, at a node, a body extends across the plane into the body to which the plane belongs, or touches it except
/// for rounding errors.
template <int D>
bool overlaps(const Level& level, const SeparatingPlanes<D>& planes, int first, std::size_t m, const Index<D>& node) {
  const double own = (*planes[m].prominence)[node];
  return own != noProminence && own <= (*planes[first].prominence)[node] + touchTolerance * level.minSpacing();
}

/// The friction coefficient mu at a node.
template <int D>
double frictionAt(const Contact& contact, const SeparatingPlanes<D>& planes, const Index<D>& node) {
  const auto& table = contact.frictionOfColor;
  if (table.empty()) return contact.friction;
  const double color = (*planes[contact.master].color)[node];
  if (color <= table.front().first) return table.front().second;
  if (color >= table.back().first) return table.back().second;
  const auto next =
      std::lower_bound(table.begin(), table.end(), color, [](const auto& entry, double c) { return entry.first < c; });
  const auto& [c0, mu0] = *(next - 1);
  const double share = (color - c0) / (next->first - c0);
  return share * next->second + (1 - share) * mu0;
}

/// Whether a body may slide on a master at a node: the body takes part, and both are present and overlap.
template <int D>
bool meetsMaster(const Level& level, const Contact& contact, const Records& records, const SeparatingPlanes<D>& planes,
                 int first, std::size_t m, const Index<D>& node) {
  return static_cast<int>(m) != contact.master && contact.concerns(static_cast<int>(m)) &&
         records[contact.master][node][lane::mass] != 0 && records[m][node][lane::mass] != 0 &&
         overlaps<D>(level, planes, first, m, node);
}

/// Calls `visit(node, m, touch)` for each body m that meets the master at a node and moves against it.
template <int D, class Visit>
void forEachTouch(const Patch& patch, const Contact& contact, double time, double dt, const Records& records,
                  const SeparatingPlanes<D>& planes, const MeetingBodies<D>& meeting, Visit&& visit) {
  const auto motion = contact.prescribedMotion(time);
  meeting.forEachNode([&](const Index<D>& node, std::span<const std::size_t> bodies) {
    const int first = foremost<D>(planes, bodies, node);
    if (first < 0 || isExcluded<D>(contact, records, node)) return;
    const Vec<D> moving = masterVelocity<D>(patch, contact, motion, dt, records, node);
    const Vec<D> normal = -(*planes[first].normal)[node];
    for (const std::size_t m : bodies) {
      if (!meetsMaster<D>(patch.level(), contact, records, planes, first, m, node)) continue;
      const Touch<D> touch{normal, lanes<D>(records[m][node], lane::velocity) - moving, false};
      if (touch.velocity.dot(normal) > 0) visit(node, m, touch);
    }
  });
}

}  // namespace

template <int D>
MeetingBodies<D> meetingAtPlanes(const Records& records, const SeparatingPlanes<D>& planes) {
  RowsOfNodes rows;
  for (const auto& plane : planes) rows.push_back(&touchedRows<D>(*plane.x, plane.ghostNodes));
  return {rows, records};
}

template <int D>
Vec<D> separatingNormal(const std::vector<SidedParticle<D>>& particles, double width) {
  Eigen::Matrix<double, D + 1, 1> phi = Eigen::Matrix<double, D + 1, 1>::Zero();
  Vec<D> last = Vec<D>::Zero(), closest = Vec<D>::Zero();
  double least = 1;
  Regression<D> regression(particles);
  for (int k = 0; k < mostSteps; ++k) {
    phi += step<D>(regression, 1e-7 * width * width, phi);
    Vec<D> normal = phi.template head<D>();
    if (const double length = normal.norm(); length > 0) normal /= length;
    const double change = 1 - normal.dot(last);
    if (change < least) {
      least = change;
      closest = normal;
    }
    if (change < tolerance) return normal;
    last = normal;
  }
  return closest;
}

template <int D>
void slideAlongPlanes(const Level& level, const Contact& contact, const Records& records,
                      const SeparatingPlanes<D>& planes, const MeetingBodies<D>& meeting) {
  const std::vector<bool> takesPart = contact.takingPart(records.size());
  meeting.forEachNode([&](const Index<D>& node, std::span<const std::size_t> bodies) {
    const int first = foremost<D>(planes, bodies, node);
    if (first < 0) return;
    Vec<D> momentum = Vec<D>::Zero();
    double mass = 0;
    for (const std::size_t m : bodies) {
      if (!takesPart[m]) continue;
      momentum += records[m][node][lane::mass] * lanes<D>(records[m][node], lane::velocity);
      mass += records[m][node][lane::mass];
    }
    const Vec<D> normal = -(*planes[first].normal)[node];
    NodeRecord& body = records[first][node];
    for (const std::size_t m : bodies) {
      NodeRecord& record = records[m][node];
      if (static_cast<int>(m) == first || !takesPart[m]) continue;
      if (record[lane::mass] <= leastMass || !overlaps<D>(level, planes, first, m, node)) continue;
      const Vec<D> v = lanes<D>(record, lane::velocity);
      const Touch<D> touch{normal, v - momentum / mass, false};
      const Vec<D> change = frictionImpulse<D>(touch, frictionAt<D>(contact, planes, node)).change;
      setLanes<D>(record, lane::velocity, v + change);
      const double share = record[lane::mass] / body[lane::mass];
      setLanes<D>(body, lane::velocity, lanes<D>(body, lane::velocity) - share * change);
    }
  });
}

template <int D>
void slideOnMaster(const Patch& patch, const Contact& contact, double time, double dt, const Records& records,
                   const SeparatingPlanes<D>& planes, const MeetingBodies<D>& meeting) {
  forEachTouch<D>(patch, contact, time, dt, records, planes, meeting,
                  [&](const Index<D>& node, std::size_t m, const Touch<D>& touch) {
                    const Vec<D> change = frictionImpulse<D>(touch, contact.friction).change;
                    setLanes<D>(records[m][node], lane::velocity, lanes<D>(records[m][node], lane::velocity) + change);
                  });
  const auto motion = contact.prescribedMotion(time);
  forEach<D>(records.front().box(), [&](const Index<D>& node) {
    NodeRecord& master = records[contact.master][node];
    if (master[lane::mass] == 0 || isExcluded<D>(contact, records, node)) return;
    setLanes<D>(master, lane::velocity, masterVelocity<D>(patch, contact, motion, dt, records, node));
  });
}

template <int D>
void sumSlidingReaction(const Patch& patch, const Contact& contact, const Acceleration& acceleration, double time,
                        double dt, const Records& records, const SeparatingPlanes<D>& planes,
                        const MeetingBodies<D>& meeting, VectorSum& reaction) {
  const Vec<D> gravity = patch.level().reduce<D>(acceleration.gravity);
  forEachTouch<D>(patch, contact, time, dt, records, planes, meeting,
                  [&](const Index<D>& node, std::size_t m, const Touch<D>&) {
                    if (!countsOnce<D>(patch, node)) return;
                    const NodeRecord& record = records[m][node];
                    reaction.add(patch.level().expandDirection<D>(heldForce<D>(record, gravity, acceleration, dt)));
                  });
}

template MeetingBodies<1> meetingAtPlanes<1>(const Records&, const SeparatingPlanes<1>&);
template Vec<1> separatingNormal<1>(const std::vector<SidedParticle<1>>&, double);
template MeetingBodies<2> meetingAtPlanes<2>(const Records&, const SeparatingPlanes<2>&);
template Vec<2> separatingNormal<2>(const std::vector<SidedParticle<2>>&, double);
template MeetingBodies<3> meetingAtPlanes<3>(const Records&, const SeparatingPlanes<3>&);
template Vec<3> separatingNormal<3>(const std::vector<SidedParticle<3>>&, double);
template void slideAlongPlanes<1>(const Level&, const Contact&, const Records&, const SeparatingPlanes<1>&,
                                  const MeetingBodies<1>&);
template void slideAlongPlanes<2>(const Level&, const Contact&, const Records&, const SeparatingPlanes<2>&,
                                  const MeetingBodies<2>&);
template void slideAlongPlanes<3>(const Level&, const Contact&, const Records&, const SeparatingPlanes<3>&,
                                  const MeetingBodies<3>&);
template void slideOnMaster<1>(const Patch&, const Contact&, double, double, const Records&, const SeparatingPlanes<1>&,
                               const MeetingBodies<1>&);
template void slideOnMaster<2>(const Patch&, const Contact&, double, double, const Records&, const SeparatingPlanes<2>&,
                               const MeetingBodies<2>&);
template void slideOnMaster<3>(const Patch&, const Contact&, double, double, const Records&, const SeparatingPlanes<3>&,
                               const MeetingBodies<3>&);
template void sumSlidingReaction<1>(const Patch&, const Contact&, const Acceleration&, double, double, const Records&,
                                    const SeparatingPlanes<1>&, const MeetingBodies<1>&, VectorSum&);
template void sumSlidingReaction<2>(const Patch&, const Contact&, const Acceleration&, double, double, const Records&,
                                    const SeparatingPlanes<2>&, const MeetingBodies<2>&, VectorSum&);
template void sumSlidingReaction<3>(const Patch&, const Contact&, const Acceleration&, double, double, const Records&,
                                    const SeparatingPlanes<3>&, const MeetingBodies<3>&, VectorSum&);

}  // namespace tushar::mpm::solid
