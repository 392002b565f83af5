#pragma once

#include <algorithm>

#include "components/mpm/solid/implicit/system.hpp"

// The members of ImplicitSystem: included by the files that instantiate it.

namespace tushar::mpm::solid {

template <class Shape>
std::size_t countPoints(const std::vector<PointSources<Shape>>& sources) {
  std::size_t count = 0;
  for (const PointSources<Shape>& from : sources) count += static_cast<std::size_t>(from.group.count);
  return count;
}

template <class Shape>
ImplicitSystem<Shape>::ImplicitSystem(const Level& level, const Method& method, bool dynamic, double dt, int stateSize,
                                      std::vector<PointSources<Shape>> sources)
    : method_(method),
      dynamic_(dynamic),
      dt_(dt),
      map_(level),
      sources_(std::move(sources)),
      touch_(countPoints(sources_) * touches_),
      states_(countPoints(sources_), stateSize, dt) {
  findNodes();
  findRuns();
  gatherNodes();
  prescribed_.assign(node_.size() * D, 0);
  prescribed_value_.assign(node_.size() * D, 0);
}

template <class Shape>
void ImplicitSystem<Shape>::findNodes() {
  std::vector<Index<D>> images(touch_.size());
  std::size_t first = 0;
  for (PointSources<Shape>& from : sources_) {
    from.group.first = first;
    forEachStencil<Shape>(*from.patch, from.patch->cells(), from.x, from.extents, [&](int p, const auto& stencil) {
      std::size_t at = (first + static_cast<std::size_t>(p)) * touches_;
      stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>& gradient) {
        const auto image = map_.imageOf(node);
        Touch<D>& touch = touch_[at];
        touch = {0, s, 0, gradient, image.sign};
        if constexpr (Shape::axisymmetric)
          touch.hoop = s / stencil.s[0][std::size_t(node[0] - stencil.first[0])] * stencil.hoop[std::size_t(node[0] - stencil.first[0])];
        if (s == 0 && gradient.squaredNorm() == 0) touch.node = -1;
        if (touch.node >= 0) map_.touch(image.node);
        images[at++] = image.node;
      });
    });
    first += static_cast<std::size_t>(from.group.count);
  }
  map_.number();
  for (std::size_t k = 0; k < touch_.size(); ++k)
    if (touch_[k].node >= 0) touch_[k].node = map_(images[k]);
}

template <class Shape>
void ImplicitSystem<Shape>::findRuns() {
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    const PointSources<Shape>& from = sources_[s];
    forEach<D>(from.patch->cells(), [&](const Index<D>& cell) {
      const data::ParticleRange range = from.x.in(cell);
      if (!range.empty()) runs_.push_back({map_.level().template cellNumber<D>(cell), s, range.first, range.size()});
    });
  }
  std::stable_sort(runs_.begin(), runs_.end(), [&](const Run& a, const Run& b) {
    return std::pair(a.cell, sources_[a.source].group.material->index) <
           std::pair(b.cell, sources_[b.source].group.material->index);
  });
}

template <class Shape>
void ImplicitSystem<Shape>::gatherNodes() {
  node_.resize(static_cast<std::size_t>(map_.size()));
  forEachRun([&](const PointSources<Shape>& from, const PointRun& run) {
    for (int p = run.from; p < run.from + run.count; ++p) {
      const Touch<D>* touch = touchesOf(from.group.first + static_cast<std::size_t>(p));
      for (int k = 0; k < touches_; ++k) {
        if (touch[k].node < 0) continue;
        Node& node = node_[static_cast<std::size_t>(touch[k].node)];
        const double mass = touch[k].s * from.group.mass[p];
        node.mass += mass;
        node.velocity += mass * touch[k].sign.cwiseProduct(from.velocity[p]);
        node.acceleration += mass * touch[k].sign.cwiseProduct(from.acceleration[p]);
        node.force += touch[k].s * touch[k].sign.cwiseProduct(from.externalForce[p]);
      }
    }
  });
  const Vec<D> gravity = map_.level().template reduce<D>(method_.gravity);
  for (Node& node : node_) {
    node.force += node.mass * gravity;
    if (node.mass <= 0) continue;
    node.velocity /= node.mass;
    node.acceleration /= node.mass;
  }
}

template <class Shape>
solvers::Unknowns ImplicitSystem<Shape>::unknowns() const {
  solvers::Unknowns unknowns;
  unknowns.block = D;
  unknowns.owned = map_.size();
  unknowns.entries = map_.neighbours(Shape::Stencil::nodes - 1);
  for (int k = 0; k < map_.size(); ++k)
    for (int d = 0; d < D; ++d) unknowns.coordinates.push_back(map_.position(k)[d]);
  return unknowns;
}

template <class Shape>
void ImplicitSystem<Shape>::prescribe(int node, int d, double value) {
  prescribed_[static_cast<std::size_t>(D * node + d)] = 1;
  prescribed_value_[static_cast<std::size_t>(D * node + d)] = value;
}

template <class Shape>
std::vector<double> ImplicitSystem<Shape>::guess() const {
  std::vector<double> u = prescribed_value_;
  for (int k = 0; k < map_.size(); ++k)
    for (int d = 0; d < D; ++d)
      if (!isPrescribed(k, d)) u[static_cast<std::size_t>(D * k + d)] = dt_ * node_[static_cast<std::size_t>(k)].velocity[d];
  return u;
}

template <class Shape>
auto ImplicitSystem<Shape>::acceleration(int node, std::span<const double> u) const -> Vec<D> {
  if (!dynamic_) return Vec<D>::Zero();
  const Node& n = node_[static_cast<std::size_t>(node)];
  return 4 / dt_ * (displacement(node, u) / dt_ - n.velocity) - n.acceleration;
}

template <class Shape>
Matrix3 ImplicitSystem<Shape>::displacementGradient(std::size_t point, std::span<const double> u) const {
  const Level& level = map_.level();
  const Touch<D>* touch = touchesOf(point);
  Matrix3 gradient = Matrix3::Zero();
  for (int k = 0; k < touches_; ++k) {
    if (touch[k].node < 0) continue;
    const Vec<D> moved = touch[k].sign.cwiseProduct(displacement(touch[k].node, u));
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) gradient(sceneAxis<D>(level, i), sceneAxis<D>(level, j)) += moved[i] * touch[k].gradient[j];
    gradient(2, 2) += touch[k].hoop * moved[0];
  }
  return gradient;
}

template <class Shape>
bool ImplicitSystem<Shape>::residual(std::span<const double> u, std::span<double> r) {
  for (int k = 0; k < map_.size(); ++k) {
    const Node& node = node_[static_cast<std::size_t>(k)];
    Eigen::Map<Vec<D>>(r.data() + D * k) = node.mass * acceleration(k, u) - node.force;
  }
  bool admissible = true;
  forEachRun([&](const PointSources<Shape>&, const PointRun& run) {
    for (int k = run.from; k < run.from + run.count; ++k) {
      const std::size_t at = run.group->first + static_cast<std::size_t>(k);
      states_.gradient[at] = displacementGradient(at, u);
    }
    admissible = admissible && states_.deform(run);
    if (!admissible) return;
    states_.updateStress(run);
    addInternalForce(run, r);
  });
  for (std::size_t k = 0; k < prescribed_.size(); ++k)
    if (prescribed_[k]) r[k] = 0;
  return admissible;
}

template <class Shape>
void ImplicitSystem<Shape>::addInternalForce(const PointRun& run, std::span<double> r) const {
  const Level& level = map_.level();
  const PointGroup& group = *run.group;
  for (int p = run.from; p < run.from + run.count; ++p) {
    const std::size_t at = group.first + static_cast<std::size_t>(p);
    const Matrix3 step = Matrix3::Identity() + states_.gradient[at];
    const double volume = group.mass[p] / group.material->density * states_.deformation[at].determinant();
    const Matrix3 stress = volume * states_.stress[at] * step.inverse().transpose();
    const Touch<D>* touch = touchesOf(at);
    for (int k = 0; k < touches_; ++k) {
      if (touch[k].node < 0) continue;
      Vec<D> force;
      for (int i = 0; i < D; ++i) {
        force[i] = i == 0 ? touch[k].hoop * stress(2, 2) : 0.0;
        for (int j = 0; j < D; ++j) force[i] += stress(sceneAxis<D>(level, i), sceneAxis<D>(level, j)) * touch[k].gradient[j];
      }
      Eigen::Map<Vec<D>>(r.data() + D * touch[k].node) += touch[k].sign.cwiseProduct(force);
    }
  }
}

/// The nine numbers of the displacement gradient for a unit displacement of each node that a point touches.
template <class Shape>
auto ImplicitSystem<Shape>::strainOf(std::size_t point) const -> Strain {
  const Level& level = map_.level();
  const Touch<D>* touch = touchesOf(point);
  Strain strain = Strain::Zero();
  for (int k = 0; k < touches_; ++k) {
    if (touch[k].node < 0) continue;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j)
        strain(3 * sceneAxis<D>(level, i) + sceneAxis<D>(level, j), D * k + i) = touch[k].sign[i] * touch[k].gradient[j];
    strain(8, D * k) += touch[k].sign[0] * touch[k].hoop;
  }
  return strain;
}

/// V0 Bᵀ a B, where B is strainOf and a_ijkl = sum_JL dP_iJ/dF_kL F_old_jJ F_old_lL.
template <class Shape>
auto ImplicitSystem<Shape>::stiffnessOf(const PointGroup& group, int k, const Matrix9& tangent) const -> Local {
  const Matrix3& f = group.oldDeformation[k];
  Matrix9 half, whole;
  for (int c = 0; c < 3; ++c) half.middleCols<3>(3 * c) = tangent.middleCols<3>(3 * c) * f.transpose();
  for (int c = 0; c < 3; ++c) whole.middleRows<3>(3 * c) = f * half.middleRows<3>(3 * c);
  const Strain strain = strainOf(group.first + static_cast<std::size_t>(k));
  return group.mass[k] / group.material->density * (strain.transpose() * (whole * strain));
}

template <class Shape>
void ImplicitSystem<Shape>::addStiffness(const PointGroup& group, int k, const Matrix9& tangent,
                                         solvers::Matrix& matrix) {
  Local stiffness = stiffnessOf(group, k, tangent);
  stiffest_ = std::max(stiffest_, stiffness.diagonal().maxCoeff());
  const Touch<D>* touch = touchesOf(group.first + static_cast<std::size_t>(k));
  std::array<int, touches_> numbers;
  for (int n = 0; n < touches_; ++n) {
    numbers[static_cast<std::size_t>(n)] = touch[n].node;
    for (int d = 0; d < D && touch[n].node >= 0; ++d) {
      if (!isPrescribed(touch[n].node, d)) continue;
      stiffness.row(D * n + d).setZero();
      stiffness.col(D * n + d).setZero();
    }
  }
  matrix.add(numbers, numbers, {stiffness.data(), static_cast<std::size_t>(stiffness.size())});
}

/// Inertia, and the rows of what is prescribed, as stiff as the rest.
template <class Shape>
void ImplicitSystem<Shape>::addDiagonals(solvers::Matrix& matrix) const {
  for (int k = 0; k < map_.size(); ++k) {
    Eigen::Matrix<double, D, D> block;  // diagonal: the order of rows and columns does not matter
    block.setZero();
    const double inertia = dynamic_ ? 4 * node_[static_cast<std::size_t>(k)].mass / (dt_ * dt_) : 0.0;
    for (int d = 0; d < D; ++d) block(d, d) = isPrescribed(k, d) ? stiffest_ : inertia;
    matrix.add({&k, 1}, {&k, 1}, {block.data(), D * D});
  }
}

template <class Shape>
void ImplicitSystem<Shape>::tangent(solvers::Matrix& matrix) {
  stiffest_ = 0;
  forEachRun([&](const PointSources<Shape>& from, const PointRun& run) {
    states_.forEachTangent(run, [&](int k, const Matrix9& one) { addStiffness(from.group, k, one, matrix); });
  });
  addDiagonals(matrix);
}

}  // namespace tushar::mpm::solid
