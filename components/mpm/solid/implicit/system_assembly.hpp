#pragma once

#include <Eigen/LU>

#include <algorithm>
#include <utility>

#include "components/mpm/solid/implicit/system.hpp"

// The members of ImplicitSystem: included by the files that instantiate it.

namespace tushar::mpm::solid::implicit {

template <int D>
std::size_t countPoints(const std::vector<PointSources<D>>& sources) {
  std::size_t count = 0;
  for (const PointSources<D>& from : sources) count += from.group.count;
  return count;
}

template <int D>
ImplicitSystem<D>::ImplicitSystem(const RankPatches& patches, const mpi::Communicator& ranks,
                                  const ImplicitShapes<D>& shapes, const Method& method, const ImplicitMethod& how,
                                  double dt, int stateSize, std::vector<PointSources<D>> sources)
    : shapes_(shapes),
      touches_(shapes.touches()),
      method_(method),
      how_(how),
      dt_(dt),
      map_(patches.front()->level(), ranks),
      sources_(std::move(sources)),
      touch_(countPoints(sources_) * touches_),
      states_(countPoints(sources_), stateSize, dt, how.sharesVolume) {
  findNodes(patches);
  if (!how.resetsGrid) carrySlopes();
  findRuns();
  gatherNodes();
  measureStiffness();
  supportNodes();
  prescribed_.assign(node_.size() * D, 0);
  prescribed_value_.assign(node_.size() * D, 0);
  held_.assign(node_.size() * D, 0);
}

template <int D>
void ImplicitSystem<D>::findNodes(const RankPatches& patches) {
  std::vector<Index<D>> images(touch_.size());
  std::size_t first = 0;
  for (PointSources<D>& from : sources_) {
    from.group.first = first;
    const Vec3& commonSize = method_.commonSize;
    const Box& cells = from.patch->cells();
    shapes_.forEachTouched(*from.patch, cells, from.placed, commonSize, [&](int p, std::span<const Touch<D>> touched) {
      std::size_t at = (first + p) * touches_;
      for (const Touch<D>& of : touched) {
        const auto image = map_.imageOf(of.node);
        NodeTouch<D>& touch = touch_[at];
        touch = {0, of.s, of.hoop, of.gradient, image.sign};
        if (of.s == 0 && of.hoop == 0 && of.gradient.squaredNorm() == 0) touch.node = -1;
        if (touch.node >= 0) map_.touch(image.node);
        images[at++] = image.node;
      }
    });
    first += from.group.count;
  }
  map_.number(patches, shapes_.shaped.shape.ghostNodes + 1);
  for (std::size_t k = 0; k < touch_.size(); ++k)
    if (touch_[k].node >= 0) touch_[k].node = map_(images[k]);
}

/// Computes grad S = F_old^-T grad_0 S.
template <int D>
void ImplicitSystem<D>::carrySlopes() {
  const Level& level = map_.level();
  for (const PointSources<D>& from : sources_)
    for (int p = 0; p < from.group.count; ++p) {
      const Matrix3 inverse = from.group.oldDeformation[p].inverse();
      NodeTouch<D>* touch = &touch_[(from.group.first + p) * touches_];
      for (int k = 0; k < touches_; ++k) {
        const Vec<D> slope = touch[k].gradient;
        touch[k].gradient =
            level.template reduce<D>(Vec3(level.template expandDirection<D>(slope).transpose() * inverse));
        touch[k].hoop *= inverse(2, 2);
      }
    }
}

template <int D>
void ImplicitSystem<D>::findRuns() {
  std::vector<ParticlesOnPatch<D>> list;
  for (const PointSources<D>& from : sources_) list.push_back({from.patch, from.placed.x, from.group.material->index});
  runs_ = occupiedCells<D>(list);
}

template <int D>
void ImplicitSystem<D>::gatherNodes() {
  std::vector<double> sums(sums_ * map_.size(), 0.0);
  forEachRun([&](const PointSources<D>& from, const PointRun& run) {
    const Material& material = *from.group.material;
    for (int p = run.from; p < run.from + run.count; ++p) {
      const NodeTouch<D>* touch = touchesOf(from.group.first + p);
      const double c = material.model->initialWaveSpeed(material.density, from.group.temperature[p]);
      const double modulus = c * c + from.group.oldStress[p].norm() / material.density;  // over the density
      for (int k = 0; k < touches_; ++k) {
        if (touch[k].node < 0) continue;
        Eigen::Map<Eigen::Matrix<double, sums_, 1>> sum(sums.data() + sums_ * touch[k].node);
        const double mass = touch[k].s * from.group.mass[p];
        sum[0] += mass;
        sum[1] += mass / material.density;
        sum[2] += from.group.mass[p] * modulus * (touch[k].gradient.norm() + std::abs(touch[k].hoop));
        sum.template segment<D>(3) += mass * touch[k].sign.cwiseProduct(from.velocity[p]);
        if (from.acceleration)
          sum.template segment<D>(3 + D) += mass * touch[k].sign.cwiseProduct(from.acceleration[p]);
        sum.template segment<D>(3 + 2 * D) += touch[k].s * touch[k].sign.cwiseProduct(from.externalForce[p]);
      }
    }
  });
  solvers::addUp(map_.unknowns(sums_), sums);
  shareNodes(sums);
}

template <int D>
void ImplicitSystem<D>::shareNodes(const std::vector<double>& sums) {
  const Vec<D> gravity = map_.level().template reduce<D>(method_.gravity);
  for (int k = 0; k < map_.size(); ++k) {
    const Eigen::Map<const Eigen::Matrix<double, sums_, 1>> sum(sums.data() + sums_ * k);
    Node& node = node_.emplace_back();
    node.mass = sum[0];
    node.volume = sum[1];
    node.rigidity = sum[2];
    node.force = sum.template segment<D>(3 + 2 * D) + node.mass * gravity;
    if (node.mass <= 0) continue;
    node.velocity = sum.template segment<D>(3) / node.mass;
    node.acceleration = sum.template segment<D>(3 + D) / node.mass;
  }
}

template <int D>
void ImplicitSystem<D>::measureStiffness() {
  for (const PointSources<D>& from : sources_) {
    const Material& material = *from.group.material;
    for (int p = 0; p < from.group.count; ++p) {
      const double c = material.model->initialWaveSpeed(material.density, from.group.temperature[p]);
      stiffest_ = std::max(stiffest_, from.group.mass[p] * c * c);
    }
  }
  const double h = map_.level().minSpacing();
  stiffest_ = map_.ranks().max(stiffest_) / (h * h);
}

/// Adds weak springs to nodes with less than a millionth of a cell's volume of material, because they may have almost
/// no stiffness along some axis.
template <int D>
void ImplicitSystem<D>::supportNodes() {
  for (Node& node : node_)
    if (node.volume < 1e-6 * map_.level().cellVolume()) node.support = 1e-10 * stiffest_;
}

template <int D>
solvers::Unknowns ImplicitSystem<D>::unknowns() const {
  solvers::Unknowns unknowns = map_.unknowns(D);
  const int width = shapes_.nodes - 1;  // for one particle; all of a cell reach one node further if it is more than 1
  unknowns.entries = map_.neighbours(width > 1 && how_.sharesVolume ? width + 1 : width);
  for (int k = 0; k < map_.owned(); ++k)
    for (int d = 0; d < D; ++d) unknowns.coordinates.push_back(map_.position(k)[d]);
  return unknowns;
}

template <int D>
void ImplicitSystem<D>::prescribe(int node, int d, double value) {
  prescribed_[D * node + d] = 1;
  prescribed_value_[D * node + d] = value;
}

template <int D>
void ImplicitSystem<D>::holdAtPlane(int node, int d) {
  prescribe(node, d, 0);
  node_[node].velocity[d] = node_[node].acceleration[d] = 0;
}

template <int D>
std::vector<double> ImplicitSystem<D>::guess() const {
  std::vector<double> u = prescribed_value_;
  for (int k = 0; k < map_.size(); ++k)
    for (int d = 0; d < D; ++d)
      if (!isPrescribed(k, d)) u[D * k + d] = dt_ * node_[k].velocity[d];
  return u;
}

template <int D>
auto ImplicitSystem<D>::acceleration(int node, std::span<const double> u) const -> Vec<D> {
  if (!how_.dynamic) return Vec<D>::Zero();
  const Node& n = node_[node];
  const Vec<D> change = displacement(node, u) / dt_ - n.velocity;
  Vec<D> acceleration = 4 / dt_ * change - n.acceleration;
  for (int d = 0; d < D; ++d)
    if (isPrescribed(node, d)) acceleration[d] = 2 / dt_ * change[d] - n.acceleration[d];
  return acceleration;
}

template <int D>
Matrix3 ImplicitSystem<D>::displacementGradient(std::size_t point, std::span<const double> u) const {
  const Level& level = map_.level();
  const NodeTouch<D>* touch = touchesOf(point);
  Eigen::Matrix<double, D, D> reduced = Eigen::Matrix<double, D, D>::Zero();
  double hoop = 0;
  for (int k = 0; k < touches_; ++k) {
    if (touch[k].node < 0) continue;
    const Vec<D> moved = touch[k].sign.cwiseProduct(displacement(touch[k].node, u));
    for (int j = 0; j < D; ++j)
      for (int i = 0; i < D; ++i) reduced(i, j) += moved[i] * touch[k].gradient[j];
    hoop += touch[k].hoop * moved[0];
  }
  Matrix3 gradient = Matrix3::Zero();
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) gradient(sceneAxis<D>(level, i), sceneAxis<D>(level, j)) = reduced(i, j);
  gradient(2, 2) += hoop;
  return gradient;
}

template <int D>
void ImplicitSystem<D>::hold(std::span<double> u) const {
  for (std::size_t k = 0; k < prescribed_.size(); ++k)
    if (prescribed_[k]) u[k] = prescribed_value_[k];
}

template <int D>
bool ImplicitSystem<D>::residual(std::span<const double> given, std::span<double> r) {
  std::vector<double> u(given.begin(), given.end());
  hold(u);
  std::fill(r.begin(), r.end(), 0.0);
  for (int k = 0; k < map_.owned(); ++k) {
    const Node& node = node_[k];
    Eigen::Map<Vec<D>>(r.data() + D * k) =
        node.mass * acceleration(k, u) - node.force + node.support * (displacement(k, u) - dt_ * node.velocity);
  }
  const bool admissible = addInternalForces(u, r);
  for (std::size_t k = 0; k < prescribed_.size(); ++k)
    if (prescribed_[k]) held_[k] = std::exchange(r[k], 0.0);
  return admissible;
}

/// Adds the internal forces; returns false if a point would be inverted.
template <int D>
bool ImplicitSystem<D>::addInternalForces(std::span<const double> u, std::span<double> r) {
  bool admissible = true;
  forEachRun([&](const PointSources<D>&, const PointRun& run) {
    for (int k = run.from; k < run.from + run.count; ++k) {
      const std::size_t at = run.group->first + k;
      states_.gradient[at] = displacementGradient(at, u);
    }
    admissible = admissible && states_.deform(run);
    if (!admissible) return;
    states_.updateStress(run);
    addInternalForce(run, r);
  });
  return admissible;
}

template <int D>
std::vector<double> ImplicitSystem<D>::startingAcceleration() {
  std::vector<double> sums(node_.size() * D, 0.0);
  const std::vector<double> still(sums);
  addInternalForces(still, sums);
  solvers::addUp(map_.unknowns(D), sums);
  for (int k = 0; k < map_.size(); ++k) {
    const Node& node = node_[k];
    Eigen::Map<Vec<D>> sum(sums.data() + D * k);
    sum = node.mass > 0 ? Vec<D>((node.force - sum) / node.mass) : Vec<D>::Zero();
    for (int d = 0; d < D; ++d)
      if (isPrescribed(k, d)) sum[d] = 0;
  }
  return sums;
}

template <int D>
std::vector<double> ImplicitSystem<D>::reactions() const {
  std::vector<double> sums = held_;
  solvers::addUp(map_.unknowns(D), sums);
  sums.resize(D * map_.owned());
  return sums;
}

template <int D>
bool ImplicitSystem<D>::isNegligible(std::span<const double> u, std::span<const double> r) const {
  double largest = 0;
  for (int k = 0; k < map_.owned(); ++k) {
    const Node& node = node_[k];
    double forces = node.rigidity + node.force.norm();
    if (how_.dynamic)
      forces +=
          node.mass * (4 / dt_ * (displacement(k, u).norm() / dt_ + node.velocity.norm()) + node.acceleration.norm());
    const double left = Eigen::Map<const Vec<D>>(r.data() + D * k).norm();
    if (left > 0) largest = std::max(largest, left / forces);
  }
  return map_.ranks().max(largest) <= 1e-14;
}

template <int D>
void ImplicitSystem<D>::addInternalForce(const PointRun& run, std::span<double> r) const {
  const Level& level = map_.level();
  const PointGroup& group = *run.group;
  for (int p = run.from; p < run.from + run.count; ++p) {
    const std::size_t at = group.first + p;
    const Matrix3 step = Matrix3::Identity() + states_.gradient[at];
    const double volume = group.mass[p] / group.material->undeformedDensity() * states_.deformation[at].determinant();
    const Matrix3 stress = volume * states_.stress[at] * step.inverse().transpose();
    Eigen::Matrix<double, D, D> reduced;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) reduced(i, j) = stress(sceneAxis<D>(level, i), sceneAxis<D>(level, j));
    const NodeTouch<D>* touch = touchesOf(at);
    for (int k = 0; k < touches_; ++k) {
      if (touch[k].node < 0) continue;
      Vec<D> force = Vec<D>::Zero();
      force[0] = touch[k].hoop * stress(2, 2);
      for (int j = 0; j < D; ++j)
        for (int i = 0; i < D; ++i) force[i] += reduced(i, j) * touch[k].gradient[j];
      Eigen::Map<Vec<D>>(r.data() + D * touch[k].node) += touch[k].sign.cwiseProduct(force);
    }
  }
}

}  // namespace tushar::mpm::solid::implicit
