#pragma once

#include "components/mpm/boundary_labels.hpp"
#include "components/mpm/solid/implicit/rigid_body.hpp"

namespace tushar::mpm::solid::implicit {

/// The solid keeps the velocity that a face has, and does not pass a symmetry plane.
template <class Shape, int D = Shape::dimension>
void prescribeFaces(ImplicitSystem<Shape>& system, double dt) {
  const Level& level = system.nodes().level();
  const grid::BoundarySides<Vec3> sides = level.sides(boundary::velocity);
  for (int k = 0; k < system.nodes().size(); ++k)
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) {
        const int at = system.nodes().node(k)[d], face = side == 0 ? 0 : level.cells().extent(d);
        if (level.isPeriodic(d) || (side == 0 ? at > face : at < face)) continue;
        if (level.isSymmetry(d, side) && at == face) system.prescribe(k, d, 0);
        const auto& given = sides(d, side);
        if (!given || !given->isDirichlet()) continue;
        const Vec<D> velocity = level.reduce<D>(given->value);
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
      sources.push_back(
          {group, patches[p],
           Extents<Shape>(patches[p]->level(), setup.problem->method.commonSize, v.size[p][m], std::nullopt), v.x[p][m],
           valuesOf(v.velocity[p][m]), valuesOf(v.acceleration[p][m]), valuesOf(v.externalForce[p][m])});
    }
  return sources;
}

/// What Newton's method could not do, where it was worst, and what to try.
template <class Shape>
NumericalError failureOf(const solvers::Outcome& outcome, const ImplicitSystem<Shape>& system) {
  constexpr int D = Shape::dimension;
  const NodeMap<D>& nodes = system.nodes();
  std::optional<Vec3> worst;
  if (outcome.worst >= 0) worst = nodes.level().template expandPoint<D>(nodes.position(outcome.worst / D));
  const char* linear = outcome.krylovResiduals.empty() ? "" : "more <maxiterations> or ";
  return {
      solvers::sentenceOf("Newton's method", outcome) + solvers::worstPlace(nodes.ranks(), worst, "at the node"),
      fmt::format("a smaller <delt_init> or <delt_max>, slower loads, {}<solver> direct with <preconditioner> lu in "
                  "<MPM>/<Solver>, or support for a body that is free to move",
                  linear),
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

template <class Shape, int D = Shape::dimension>
void writeNodes(const Patch& patch, const RigidBody<Shape>& body, const NodeView<Vec<D>>& increment,
                const NodeView<Vec<D>>& acceleration) {
  forEach<D>(patch.nodes(), [&](const Index<D>& node) {
    increment[node] = body(node).value_or(Vec<D>::Zero());
    acceleration[node] = Vec<D>::Zero();
  });
}

/// The rigid body of each material that is one.
template <class Shape>
using RigidBodies = std::vector<std::optional<RigidBody<Shape>>>;

/// Prescribes what faces and rigid bodies do to the solid in the step.
template <class Shape, int D = Shape::dimension>
RigidBodies<Shape> constrain(ImplicitSystem<Shape>& system, const RankPatches& patches,
                             const std::vector<Material>& materials, const mpi::Communicator& ranks,
                             const ImplicitSetup& setup, double time, double dt, const SolidViews<D>& views) {
  prescribeFaces(system, dt);
  RigidBodies<Shape> rigid(materials.size());
  for (std::size_t m = 0; m < materials.size(); ++m)
    if (setup.rigidContact(static_cast<int>(m))) {
      rigid[m].emplace(patches, ranks, setup, static_cast<int>(m), time, dt, views);
      rigid[m]->prescribe(system);
    }
  return rigid;
}

/// The acceleration that Newmark's rule begins with, on the nodes: 0 where faces or rigid bodies hold them.
template <class Shape, int D = Shape::dimension>
void accelerateAtStart(const RankPatches& patches, const std::vector<Material>& materials,
                       const mpi::Communicator& ranks, const ImplicitSetup& setup, double time,
                       const ParticleViews<const Vec<D>>& x, const ParticleViews<const Vec<D>>& size,
                       const ParticleViews<const double>& mass, const ParticleViews<const Vec<D>>& velocity,
                       const ParticleViews<const Vec<D>>& externalForce, const ParticleViews<const double>& temperature,
                       const ParticleViews<const Matrix3>& deformation, const ParticleViews<const Matrix3>& stress,
                       const ParticleViews<const double>& state, const NodeViews<Vec<D>>& acceleration) {
  constexpr double dt = 1;  // nothing moves, over whatever time
  const SolidViews<D> views{x, size, velocity, velocity, externalForce, mass, temperature, state, deformation, stress};
  ImplicitSystem<Shape> system(patches, ranks, setup.problem->method, setup.how, dt, setup.stateSize,
                               sourcesOf<Shape>(patches, materials, setup, views));
  const auto rigid = constrain(system, patches, materials, ranks, setup, time, dt, views);
  const std::vector<double> starting = system.startingAcceleration();
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (std::size_t m = 0; m < materials.size(); ++m)
      forEach<D>(patches[p]->nodes(), [&](const Index<D>& node) {
        const auto image = system.nodes().imageOf(node);
        const int number = rigid[m] ? -1 : system.nodes()(image.node);
        acceleration[p][m][node] = Vec<D>::Zero();
        if (number >= 0) acceleration[p][m][node] = image.sign.cwiseProduct(system.displacement(number, starting));
      });
}

/// Solves for the displacement of all nodes in the step, by Newton's method. All materials move in one field, but those
/// that a contact makes rigid bodies. Throws NumericalError where Newton's method gives up.
template <class Shape, int D = Shape::dimension>
void solveStep(const RankPatches& patches, const std::vector<Material>& materials, const mpi::Communicator& ranks,
               const ImplicitSetup& setup, double time, double dt, const ParticleViews<const Vec<D>>& x,
               const ParticleViews<const Vec<D>>& size, const ParticleViews<const double>& mass,
               const ParticleViews<const Vec<D>>& velocity, const ParticleViews<const Vec<D>>& acceleration,
               const ParticleViews<const Vec<D>>& externalForce, const ParticleViews<const double>& temperature,
               const ParticleViews<const Matrix3>& deformation, const ParticleViews<const Matrix3>& stress,
               const ParticleViews<const double>& state, const NodeViews<Vec<D>>& increment,
               const NodeViews<Vec<D>>& newAcceleration, Maximum& newtonIterations, Maximum& newtonResidual,
               Maximum& krylovIterations, Minimum& nextTimeStep, Maximum& assembly, Maximum& preconditioner,
               Maximum& solution, VectorSum& rigidReaction) {
  const SolidViews<D> views{x,    size,        velocity, acceleration, externalForce,
                            mass, temperature, state,    deformation,  stress};
  ImplicitSystem<Shape> system(patches, ranks, setup.problem->method, setup.how, dt, setup.stateSize,
                               sourcesOf<Shape>(patches, materials, setup, views));
  const auto rigid = constrain(system, patches, materials, ranks, setup, time, dt, views);
  std::vector<double> u = system.guess();
  const solvers::Outcome outcome = solvers::solver().solve(system.unknowns(), system, setup.how.newton, u);
  if (!outcome.converged) throw failureOf(outcome, system);
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (std::size_t m = 0; m < materials.size(); ++m) {
      if (rigid[m])
        writeNodes(*patches[p], *rigid[m], increment[p][m], newAcceleration[p][m]);
      else
        writeNodes(*patches[p], system, u, increment[p][m], newAcceleration[p][m]);
    }
  for (const auto& body : rigid)
    if (body) body->addReaction(system, rigidReaction);
  newtonIterations.add(outcome.newtonIterations);
  newtonResidual.add(solvers::remainderOf(outcome));
  krylovIterations.add(outcome.krylovIterations);
  solvers::addTimes(outcome, assembly, preconditioner, solution);
  nextTimeStep.add(setup.how.nextTimeStep(dt, outcome.newtonIterations), "Newton's iterations");
}

}  // namespace tushar::mpm::solid::implicit
