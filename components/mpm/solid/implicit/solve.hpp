#pragma once

#include "components/mpm/solid/implicit/system.hpp"

namespace tushar::mpm::solid {

/// A variable of particles, by patch and material.
template <class T>
using ParticleViews = std::vector<std::vector<ParticleView<T>>>;
template <class T>
using NodeViews = std::vector<std::vector<NodeView<T>>>;

/// What the solve of a step is told about particles at its begin.
template <int D>
struct SolidViews {
  const ParticleViews<const Vec<D>>&x, &size, &velocity, &acceleration, &externalForce;
  const ParticleViews<const double>&mass, &temperature, &state;
  const ParticleViews<const Matrix3>&deformation, &stress;
};

/// What every step of a run has in common.
struct ImplicitSetup {
  const Problem* problem = nullptr;
  ImplicitMethod how;
  int stateSize = 1;  ///< numbers of a particle's model

  /// The contact that makes a material a rigid body, or null.
  const Contact* rigidContact(int material) const {
    for (const Contact& contact : problem->contacts)
      if (contact.type == Contact::Type::specified && contact.master == material) return &contact;
    return nullptr;
  }
};

/// A rigid body on the grid: the nodes that it touches, and how far they go in the step.
template <class Shape, int D = Shape::dimension>
class RigidBody {
 public:
  RigidBody(const RankPatches& patches, const ImplicitSetup& setup, int material, double time, double dt,
            const SolidViews<D>& views)
      : level_(&patches.front()->level()), nodes_(*level_), contact_(setup.rigidContact(material)) {
    const auto m = static_cast<std::size_t>(material);
    const auto forEachTouch = [&](auto&& visit) {
      for (std::size_t p = 0; p < patches.size(); ++p) {
        const Extents<Shape> extents(*level_, setup.problem->method.commonSize, views.size[p][m], std::nullopt);
        forEachStencil<Shape>(*patches[p], patches[p]->cells(), views.x[p][m], extents, [&](int k, const auto& stencil) {
          stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>&) {
            if (s > 0) visit(node, s * views.mass[p][m][k], views.velocity[p][m][k]);
          });
        });
      }
    };
    forEachTouch([&](const Index<D>& node, double, const Vec<D>&) { nodes_.touch(node); });
    nodes_.number();
    std::vector<double> mass(static_cast<std::size_t>(nodes_.size()), 0.0);
    moved_.assign(mass.size(), Vec<D>::Zero());
    forEachTouch([&](const Index<D>& node, double share, const Vec<D>& velocity) {
      mass[static_cast<std::size_t>(nodes_(node))] += share;
      moved_[static_cast<std::size_t>(nodes_(node))] += share * velocity;
    });
    const auto given = contact_->prescribedVelocity(time + dt / 2);
    for (std::size_t k = 0; k < mass.size(); ++k)
      moved_[k] = given ? Vec<D>(dt * level_->reduce<D>(*given)) : Vec<D>(dt / mass[k] * moved_[k]);
  }

  /// Displacement of a node in the step, m; null where the body is not.
  const Vec<D>* operator()(const Index<D>& node) const {
    const int number = nodes_(node);
    return number < 0 ? nullptr : &moved_[static_cast<std::size_t>(number)];
  }
  /// The solid goes along with the body where both are.
  void prescribe(ImplicitSystem<Shape>& system) const {
    for (int k = 0; k < system.nodes().size(); ++k)
      if (const Vec<D>* moved = (*this)(system.nodes().node(k)))
        for (int d = 0; d < D; ++d)
          if (contact_->direction[static_cast<std::size_t>(level_->axis(d))]) system.prescribe(k, d, (*moved)[d]);
  }

 private:
  const Level* level_;
  NodeMap<D> nodes_;
  const Contact* contact_;
  std::vector<Vec<D>> moved_;
};

/// The solid keeps the velocity that a face has, and does not pass a symmetry plane.
template <class Shape, int D = Shape::dimension>
void prescribeFaces(ImplicitSystem<Shape>& system, double dt) {
  const Level& level = system.nodes().level();
  for (int k = 0; k < system.nodes().size(); ++k)
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) {
        const int at = system.nodes().node(k)[d], face = side == 0 ? 0 : level.cells().extent(d);
        if (level.isPeriodic(d) || (side == 0 ? at > face : at < face)) continue;
        if (level.isSymmetry(d, side) && at == face) system.prescribe(k, d, 0);
        const grid::BoundaryCondition* condition = level.boundary(d, side, "Velocity");
        if (!condition || condition->kind != "Dirichlet") continue;
        const Vec<D> velocity = level.reduce<D>(condition->value);
        for (int e = 0; e < D; ++e) system.prescribe(k, e, dt * velocity[e]);
      }
}

/// The particles of everything that is not rigid.
template <class Shape, int D = Shape::dimension>
std::vector<PointSources<Shape>> sourcesOf(const RankPatches& patches, const std::vector<Material>& materials,
                                           const ImplicitSetup& setup, const SolidViews<D>& v) {
  std::vector<PointSources<Shape>> sources;
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (std::size_t m = 0; m < materials.size(); ++m) {
      if (setup.rigidContact(static_cast<int>(m)) || v.x[p][m].owned() == 0) continue;
      PointGroup group;
      group.material = &materials[m];
      group.count = v.x[p][m].owned();
      group.mass = valuesOf(v.mass[p][m]);
      group.temperature = valuesOf(v.temperature[p][m]);
      group.oldDeformation = valuesOf(v.deformation[p][m]);
      group.oldStress = valuesOf(v.stress[p][m]);
      group.oldState = valuesOf(v.state[p][m]);
      sources.push_back({group, patches[p],
                         Extents<Shape>(patches[p]->level(), setup.problem->method.commonSize, v.size[p][m], std::nullopt),
                         v.x[p][m], valuesOf(v.velocity[p][m]), valuesOf(v.acceleration[p][m]),
                         valuesOf(v.externalForce[p][m])});
    }
  return sources;
}

/// What Newton's method could not do, where it was worst, and what to try.
template <class Shape>
NumericalError failureOf(const solvers::Outcome& outcome, const ImplicitSystem<Shape>& system) {
  constexpr int D = Shape::dimension;
  std::string where;
  if (outcome.worst >= 0) {
    const Vec3 x = system.nodes().level().template expandPoint<D>(system.nodes().position(outcome.worst / D));
    where = fmt::format("; the greatest residual is at the node at ({:g}, {:g}, {:g})", x[0], x[1], x[2]);
  }
  return {solvers::sentenceOf("Newton's method", outcome) + where,
          "a smaller <delt_init> or <delt_max>, slower loads, <preconditioner> lu in <MPM>/<Solver>, or support for a body "
          "that is free to move",
          "g.displacement"};
}

/// Writes what was solved for to the nodes of a patch.
template <class Shape, int D = Shape::dimension>
void writeNodes(const Patch& patch, const ImplicitSystem<Shape>& system, std::span<const double> u,
                const NodeView<Vec<D>>& increment, const NodeView<Vec<D>>& acceleration) {
  forEach<D>(patch.nodes(), [&](const Index<D>& node) {
    const auto image = system.nodes().imageOf(node);
    const int number = system.nodes()(image.node);
    increment[node] = acceleration[node] = Vec<D>::Zero();
    if (number < 0) return;
    increment[node] = image.sign.cwiseProduct(system.displacement(number, u));
    acceleration[node] = image.sign.cwiseProduct(system.acceleration(number, u));
  });
}

/// Solves for the displacement of all nodes in the step, by Newton's method. All materials move in one field, but those
/// that a contact makes rigid bodies. Throws NumericalError where Newton's method gives up.
template <class Shape, int D = Shape::dimension>
void solveStep(const RankPatches& patches, const std::vector<Material>& materials, const ImplicitSetup& setup, double time,
               double dt, const ParticleViews<const Vec<D>>& x, const ParticleViews<const Vec<D>>& size,
               const ParticleViews<const double>& mass, const ParticleViews<const Vec<D>>& velocity,
               const ParticleViews<const Vec<D>>& acceleration, const ParticleViews<const Vec<D>>& externalForce,
               const ParticleViews<const double>& temperature, const ParticleViews<const Matrix3>& deformation,
               const ParticleViews<const Matrix3>& stress, const ParticleViews<const double>& state,
               const NodeViews<Vec<D>>& increment, const NodeViews<Vec<D>>& newAcceleration, Maximum& newtonIterations,
               Maximum& krylovIterations, Minimum& nextTimeStep) {
  const Level& level = patches.front()->level();
  const SolidViews<D> views{x, size, velocity, acceleration, externalForce, mass, temperature, state, deformation, stress};
  ImplicitSystem<Shape> system(level, setup.problem->method, setup.how.dynamic, dt, setup.stateSize,
                               sourcesOf<Shape>(patches, materials, setup, views));
  prescribeFaces(system, dt);
  std::vector<std::optional<RigidBody<Shape>>> rigid(materials.size());
  for (std::size_t m = 0; m < materials.size(); ++m)
    if (setup.rigidContact(static_cast<int>(m))) {
      rigid[m].emplace(patches, setup, static_cast<int>(m), time, dt, views);
      rigid[m]->prescribe(system);
    }
  std::vector<double> u = system.guess();
  const solvers::Outcome outcome = solvers::solver().solve(system.unknowns(), system, setup.how.newton, u);
  if (!outcome.converged) throw failureOf(outcome, system);
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (std::size_t m = 0; m < materials.size(); ++m) {
      writeNodes(*patches[p], system, u, increment[p][m], newAcceleration[p][m]);
      if (!rigid[m]) continue;
      forEach<D>(patches[p]->nodes(), [&](const Index<D>& node) {
        const Vec<D>* moved = (*rigid[m])(node);
        increment[p][m][node] = moved ? *moved : Vec<D>(Vec<D>::Zero());
        newAcceleration[p][m][node] = Vec<D>::Zero();
      });
    }
  newtonIterations.add(outcome.newtonIterations);
  krylovIterations.add(outcome.krylovIterations);
  nextTimeStep.add(setup.how.nextTimeStep(dt, outcome.newtonIterations), "Newton's iterations");
}

}  // namespace tushar::mpm::solid
