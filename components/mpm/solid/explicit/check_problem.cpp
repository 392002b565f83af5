#include "components/mpm/solid/explicit/check_problem.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "components/mpm/solid/scene_input.hpp"

namespace tushar::mpm::solid {

using input::Diagnostics;
using input::Element;

namespace {

/// If use_CBDI_boundary_condition is set, checks that pressures specify the faces of particles on which they act.
void checkCorners(const Problem& problem, const Element& root, Diagnostics& diagnostics) {
  const auto loads = root.child("PhysicalBC");
  if (!problem.method.loadsAtCorners || !loads) return;
  if (problem.method.turnsPressures)
    diagnostics.error(root.child("MPM")->child("keepPressBCNormalToSurface").value(),
                      "is not available with <use_CBDI_boundary_condition>");
  if (!problem.start.loads.bodies.empty())
    diagnostics.error(
        *loads, "force: is not available with <use_CBDI_boundary_condition>, which takes only pressures and torques");
  for (const Element& pressure : loads->child("MPM").value().children("pressure"))
    if (!pressure.child("outward_normal"))
      diagnostics.error(pressure, "missing tag <outward_normal>: needed with <use_CBDI_boundary_condition>");
}

/// Refuses settings of contacts that conflict with other parts of the method.
void checkContactsOfMethod(const Problem& problem, const Element& root, Diagnostics& diagnostics) {
  for (const Contact& contact : problem.contacts) {
    if (problem.start.axisymmetric && contact.volumeConstraint > 0 && !contact.usesPlanes())
      diagnostics.error(
          root.child("MPM")->child("axisymmetric").value(),
          "volume_constraint of <contact> compares volumes, which are per radian in this scene: remove it");
    if (problem.method.stressUpdate == StressUpdate::first && contact.usesPlanes())
      diagnostics.error(
          root.child("MPM")->child("stress_update").value(),
          "contacts of type friction_LR, friction_LRVar and specified_friction are available only with usl and musl");
  }
}

/// Refuses contacts whose force a body with is_force_transmitting_material would not feel.
void checkTransmitters(const Problem& problem, const Element& root, Diagnostics& diagnostics) {
  const Element mpm = root.child("MaterialProperties")->child("MPM").value();
  const auto tags = mpm.children("material");
  for (std::size_t m = 0; m < problem.materials.size(); ++m) {
    if (!problem.materials[m].transmitsForce) continue;
    for (const Contact& contact : problem.contacts) {
      const bool isItsMaster = contact.type == Contact::Type::specified && contact.master == static_cast<int>(m);
      const bool meetsOthers = contact.bodies(problem.materials.size()).size() > 1;
      if (!isItsMaster && meetsOthers && contact.concerns(static_cast<int>(m)))
        diagnostics.error(tags[m].child("is_force_transmitting_material").value(),
                          "the body feels only contacts of type rigid or specified of which it is the master: leave it "
                          "out of the <materials> of the others");
    }
  }
}

/// Refuses loads that have no effect because of another setting.
void checkLoads(const Problem& problem, const Element& root, Diagnostics& diagnostics) {
  const Loads& loads = problem.start.loads;
  if (problem.start.solution && (loads.hasForces() || loads.hasHeat()))
    diagnostics.error(root.child("PhysicalBC").value(), "<RunMMSProblem> applies its own loads: remove these");
  for (const SurfaceLoad& load : loads.surfaces)
    if (load.material >= static_cast<int>(problem.materials.size()))
      diagnostics.error(root.child("PhysicalBC").value(),
                        fmt::format("load_curve/material: there is no material {}; materials are numbered from 0 to {}",
                                    load.material, problem.materials.size() - 1));
  if (loads.hasHeat() && !problem.method.conductsHeat)
    diagnostics.error(root.child("PhysicalBC").value(), "heat_flux: needs <DoExplicitHeatConduction> true");
}

/// Adds notes on settings that other settings make ineffective.
void noteIdle(const Problem& problem, const Element& root, Diagnostics& diagnostics) {
  const auto mpm = root.child("MPM");
  if (!mpm) return;
  const auto usesPlanes = [](const Contact& contact) { return contact.usesPlanes(); };
  if (problem.method.contactHeats && std::any_of(problem.contacts.begin(), problem.contacts.end(), usesPlanes))
    diagnostics.note(mpm->child("do_contact_friction_heating").value(),
                     "has no effect on friction along planes (friction_LR, friction_LRVar, specified_friction), which "
                     "makes no heat");
  const auto update = mpm->child("stress_update"), momentum = mpm->child("UseMomentumForm");
  if (momentum && momentum->text() == "true" && update && update->text() != "musl")
    diagnostics.note(*update, "has no effect with <UseMomentumForm> true, which means musl");
}

}  // namespace

void checkProblem(const Problem& problem, const Element& root, Diagnostics& diagnostics) {
  refuseHeatFlows(problem, root, diagnostics);
  checkLoads(problem, root, diagnostics);
  checkCorners(problem, root, diagnostics);
  checkContactsOfMethod(problem, root, diagnostics);
  checkTransmitters(problem, root, diagnostics);
  noteIdle(problem, root, diagnostics);
}

}  // namespace tushar::mpm::solid
