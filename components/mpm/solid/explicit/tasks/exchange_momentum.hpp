#pragma once

#include "components/mpm/solid/contact/contact.hpp"
#include "components/mpm/solid/material.hpp"

namespace tushar::mpm::solid {

/// Contact on the velocities that came from the particles.
template <int D>
void exMomInterpolated(const Patch& patch, const std::vector<Material>&, const std::vector<Contact>& contacts,
                       double time, const Records& records) {
  for (const Contact& contact : contacts) {
    if (!contact.actsTwice) continue;
    if (contact.type == Contact::Type::singleVelocity) moveAsOne<D>(patch, contact, records);
    if (contact.type == Contact::Type::specified) followMaster<D>(patch, contact, time, records);
  }
}

/// Contact on the velocities at the end of the step.
template <int D>
void exMomIntegrated(const Patch& patch, const std::vector<Material>&, const std::vector<Contact>& contacts,
                     const Acceleration& acceleration, double time, double dt, const Records& records,
                     VectorSum& reaction) {
  for (const Contact& contact : contacts) {
    if (contact.type == Contact::Type::singleVelocity) moveAsOne<D>(patch, contact, records);
    if (contact.type != Contact::Type::specified) continue;
    sumReaction<D>(patch, contact, acceleration, dt, records, reaction);
    followMaster<D>(patch, contact, time, records);
  }
}

/// Contact on the velocities that stresses follow, where those are not of the end of the step.
template <int D>
void exMomOfStresses(const Patch& patch, const std::vector<Material>&, const std::vector<Contact>& contacts,
                     double time, const Records& records) {
  for (const Contact& contact : contacts) {
    if (contact.type == Contact::Type::singleVelocity) moveAsOne<D>(patch, contact, records);
    if (contact.type == Contact::Type::specified) followMaster<D>(patch, contact, time, records);
  }
}

}  // namespace tushar::mpm::solid
