#pragma once

#include "components/mpm/solid/contact/contact.hpp"
#include "components/mpm/solid/material.hpp"

namespace tushar::mpm::solid {

/// Contact on the velocities that came from the particles.
template <int D>
void exMomInterpolated(const Patch& patch, const std::vector<Material>&, const std::vector<Contact>& contacts,
                       const NodeMasses& mass, const NodeVelocities<D>& velocity) {
  for (const Contact& contact : contacts)
    if (contact.type == Contact::Type::singleVelocity) moveAsOne<D>(patch, contact, mass, velocity);
}

/// Contact on the velocities at the end of the step.
template <int D>
void exMomIntegrated(const Patch& patch, const std::vector<Material>&, const std::vector<Contact>& contacts,
                     double time, const NodeMasses& mass, const NodeVelocities<D>& velocityStar) {
  for (const Contact& contact : contacts) {
    if (contact.type == Contact::Type::singleVelocity) moveAsOne<D>(patch, contact, mass, velocityStar);
    if (contact.type == Contact::Type::specified) followMaster<D>(patch, contact, time, mass, velocityStar);
  }
}

}  // namespace tushar::mpm::solid
