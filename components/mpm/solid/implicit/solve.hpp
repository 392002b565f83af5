#pragma once

#include "components/mpm/boundary_labels.hpp"
#include "components/mpm/solid/implicit/rigid_body.hpp"

namespace tushar::mpm::solid::implicit {

/// Prescribes the velocity of the solid at faces that have one, and prevents the solid from crossing symmetry planes.
template <int D>
void prescribeFaces(ImplicitSystem<D>& system, double dt) {
  const Level& level = system.nodes().level();
  const grid::BoundarySides<Vec3> sides = level.sides(boundary::velocity);
  for (int k = 0; k < system.nodes().size(); ++k)
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) {
        const int at = system.nodes().node(k)[d], face = side == 0 ? 0 : level.cells().extent(d);
        if (level.isPeriodic(d) || (side == 0 ? at > face : at < face)) continue;
        if (level.isSymmetry(d, side) && at == face) system.holdAtPlane(k, d);
        const auto& given = sides(d, side);
        if (!given || !given->isDirichlet()) continue;
        const Vec<D> velocity = level.reduce<D>(given->value);
        for (int e = 0; e < D; ++e) system.prescribe(k, e, dt * velocity[e]);
      }
}

/// The particles of all materials that are not rigid bodies.
template <int D>
std::vector<PointSources<D>> sourcesOf(const RankPatches& patches, const std::vector<Material>& materials,
                                       const ImplicitSetup<D>& setup, const OfRank<SolidParticles<D>>& particles) {
  std::vector<PointSources<D>> sources;
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (std::size_t m = 0; m < materials.size(); ++m) {
      const SolidParticles<D>& solid = particles[p][m];
      if (setup.rigidContact(static_cast<int>(m)) || solid.mass.owned() == 0) continue;
      sources.push_back({.group = {.material = &materials[m],
                                   .count = solid.mass.owned(),
                                   .mass = valuesOf(solid.mass),
                                   .temperature = valuesOf(solid.temperature),
                                   .oldDeformation = valuesOf(solid.deformation),
                                   .oldStress = valuesOf(solid.stress),
                                   .oldState = valuesOf(solid.state)},
                         .patch = patches[p],
                         .placed = solid.placed,
                         .velocity = valuesOf(solid.velocity),
                         .acceleration = valuesOf(solid.acceleration),
                         .externalForce = valuesOf(solid.externalForce)});
    }
  return sources;
}

/// The error that says why Newton's method failed, where the residual was largest, and what to try.
template <int D>
NumericalError failureOf(const solvers::Outcome& outcome, const ImplicitSystem<D>& system) {
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

/// Views of the motion of the nodes in a step.
template <int D>
struct NodalMotion {
  NodeView<Vec<D>> increment, acceleration;

  static NodalMotion from(auto& take) {
    return {.increment = take(computes(g::increment<D>)), .acceleration = take(computes(g::newAcceleration<D>))};
  }
};

/// Writes the solution to the nodes of a patch.
template <int D>
void writeNodes(const Patch& patch, const ImplicitSystem<D>& system, std::span<const double> u,
                const NodalMotion<D>& motion) {
  forEach<D>(patch.nodes(), [&](const Index<D>& node) {
    const auto image = system.nodes().imageOf(node);
    const int number = system.nodes()(image.node);
    motion.increment[node] = motion.acceleration[node] = Vec<D>::Zero();
    if (number < 0) return;
    motion.increment[node] = image.sign.cwiseProduct(system.displacement(number, u));
    motion.acceleration[node] = image.sign.cwiseProduct(system.acceleration(number, u));
  });
}

template <int D>
void writeNodes(const Patch& patch, const RigidBody<D>& body, const NodalMotion<D>& motion) {
  forEach<D>(patch.nodes(), [&](const Index<D>& node) {
    motion.increment[node] = body(node).value_or(Vec<D>::Zero());
    motion.acceleration[node] = Vec<D>::Zero();
  });
}

/// The rigid bodies, indexed by material; none for materials that deform.
template <int D>
using RigidBodies = std::vector<std::optional<RigidBody<D>>>;

/// Prescribes the displacements in the step at faces and rigid bodies.
template <int D>
RigidBodies<D> constrain(ImplicitSystem<D>& system, const RankPatches& patches, const std::vector<Material>& materials,
                         const mpi::Communicator& ranks, const ImplicitSetup<D>& setup, double time, double dt,
                         const OfRank<SolidParticles<D>>& particles) {
  prescribeFaces(system, dt);
  RigidBodies<D> rigid(materials.size());
  for (std::size_t m = 0; m < materials.size(); ++m)
    if (setup.rigidContact(static_cast<int>(m))) {
      rigid[m].emplace(patches, ranks, setup, static_cast<int>(m), time, dt, particles);
      rigid[m]->prescribe(system);
    }
  return rigid;
}

/// Computes the accelerations of nodes with which Newmark's method starts; 0 at nodes that faces or rigid bodies hold.
template <int D>
void accelerateAtStart(const RankPatches& patches, const std::vector<Material>& materials,
                       const mpi::Communicator& ranks, const ImplicitSetup<D>& setup, double time,
                       const OfRank<SolidParticles<D>>& particles, const OfRank<NodeView<Vec<D>>>& acceleration) {
  constexpr double dt = 1;  // nothing moves, over whatever time
  ImplicitSystem<D> system(patches, ranks, *setup.shapes, setup.problem->method, setup.how, dt, setup.stateSize,
                           sourcesOf(patches, materials, setup, particles));
  const auto rigid = constrain(system, patches, materials, ranks, setup, time, dt, particles);
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

/// References to the totals of the solve in a step.
struct SolveTotals {
  Maximum &newtonIterations, &newtonResidual, &krylovIterations;
  Minimum& nextTimeStep;
  Maximum &assembly, &preconditioner, &solution;
  VectorSum& rigidReaction;

  static SolveTotals from(auto& take) {
    return {.newtonIterations = take(computes(total::newtonIterations)),
            .newtonResidual = take(computes(total::newtonResidual)),
            .krylovIterations = take(computes(total::krylovIterations)),
            .nextTimeStep = take(computes(total::nextTimeStep)),
            .assembly = take(computes(solvers::assemblyTime)),
            .preconditioner = take(computes(solvers::preconditionerTime)),
            .solution = take(computes(solvers::solveTime)),
            .rigidReaction = take(computes(total::rigidReactionForce))};
  }
};

/// Solves for the displacement of all nodes in the step, by Newton's method. All materials that are not rigid bodies
/// move in one field. Throws NumericalError if Newton's method fails.
template <int D>
void solveStep(const RankPatches& patches, const std::vector<Material>& materials, const mpi::Communicator& ranks,
               const ImplicitSetup<D>& setup, double time, double dt, const OfRank<SolidParticles<D>>& particles,
               const OfRank<NodalMotion<D>>& motion, const SolveTotals& totals) {
  ImplicitSystem<D> system(patches, ranks, *setup.shapes, setup.problem->method, setup.how, dt, setup.stateSize,
                           sourcesOf(patches, materials, setup, particles));
  const auto rigid = constrain(system, patches, materials, ranks, setup, time, dt, particles);
  std::vector<double> u = system.guess();
  const solvers::Outcome outcome = solvers::solve(system.unknowns(), system, setup.how.newton, u);
  if (!outcome.converged) throw failureOf(outcome, system);
  system.hold(u);
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (std::size_t m = 0; m < materials.size(); ++m) {
      if (rigid[m])
        writeNodes(*patches[p], *rigid[m], motion[p][m]);
      else
        writeNodes(*patches[p], system, u, motion[p][m]);
    }
  for (const auto& body : rigid)
    if (body) body->addReaction(system, totals.rigidReaction);
  totals.newtonIterations.add(outcome.newtonIterations);
  totals.newtonResidual.add(solvers::remainderOf(outcome));
  totals.krylovIterations.add(outcome.krylovIterations);
  solvers::addTimes(outcome, totals.assembly, totals.preconditioner, totals.solution);
  totals.nextTimeStep.add(setup.how.nextTimeStep(dt, outcome.newtonIterations), "Newton's iterations");
}

}  // namespace tushar::mpm::solid::implicit
