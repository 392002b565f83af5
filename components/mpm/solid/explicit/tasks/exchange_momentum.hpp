#pragma once

#include <algorithm>
#include <optional>

#include "components/mpm/solid/contact/plane_friction.hpp"
#include "components/mpm/solid/contact/present.hpp"
#include "components/mpm/solid/material.hpp"

namespace tushar::mpm::solid {

/// The nodes at which bodies meet, if a contact uses planes; empty otherwise.
template <int D>
std::optional<MeetingBodies<D>> meetingIfPlanes(const std::vector<Contact>& contacts, const Records& records,
                                                const SeparatingPlanes<D>& planes) {
  const auto usesPlanes = [](const Contact& contact) { return contact.usesPlanes(); };
  if (std::none_of(contacts.begin(), contacts.end(), usesPlanes)) return std::nullopt;
  return meetingAtPlanes<D>(records, planes);
}

/// Applies a contact other than stress-based friction to the velocities in the records. `meeting` is for contacts that
/// use planes.
template <int D>
void applyContact(const Patch& patch, const Contact& contact, double time, double dt, const Records& records,
                  const SeparatingPlanes<D>& planes, const std::optional<MeetingBodies<D>>& meeting) {
  if (contact.type == Contact::Type::singleVelocity) moveAsOne<D>(patch, contact, records);
  if (contact.type == Contact::Type::specified) followMaster<D>(patch, contact, time, dt, records);
  if (contact.type == Contact::Type::planeFriction)
    slideAlongPlanes<D>(patch.level(), contact, records, planes, *meeting);
  if (contact.type == Contact::Type::specifiedFriction)
    slideOnMaster<D>(patch, contact, time, dt, records, planes, *meeting);
}

/// Applies contacts other than stress-based friction, to velocities at the start of a step or at its end: Uintah's
/// exMomInterpolated.
template <int D>
void exchangeMomentum(const Patch& patch, const std::vector<Material>& materials, const std::vector<Contact>& contacts,
                      Moment moment, double time, double dt, const Records& records,
                      const SeparatingPlanes<D>& planes) {
  if (const auto present = presentIn(records); present.size() < records.size())
    return exchangeMomentum<D>(patch, materials, contactsAmong(contacts, present, records.size()), moment, time, dt,
                               onlyOf(records, present), onlyOf(planes, present));
  const auto meeting = meetingIfPlanes<D>(contacts, records, planes);
  for (const Contact& contact : contacts)
    if (contact.actsTwice || moment == Moment::end) applyContact<D>(patch, contact, time, dt, records, planes, meeting);
}

/// Views of a force on the nodes [N] for each material; empty if no material transmits force.
template <int D>
using TransmittedForces = std::vector<std::optional<NodeView<Vec<D>>>>;

/// Adds `share` times the momentum of the materials of a contact at the nodes of its master [kg m/s].
template <int D>
void addMomentum(const Contact& contact, const Records& records, double share, NodeView<Vec<D>> sum) {
  forEach<D>(sum.box(), [&](const Index<D>& node) {
    if (!isPresent<D>(records, contact.master, node)) return;
    for (std::size_t m = 0; m < records.size(); ++m)
      if (const NodeRecord& record = records[m][node]; contact.concerns(static_cast<int>(m)) && record[lane::mass] != 0)
        sum[node] += share * record[lane::mass] * lanes<D>(record, lane::velocity);
  });
}

/// Applies contacts to the velocities at the end of the step, like Uintah's exMomIntegrated. Adds the force of rigid
/// and specified contacts to `reaction` and, for a master that transmits force, the force that the other materials
/// exert on it,
/// - sum m (v* after - v* before) / dt at each node [N] to `transmitted`.
template <int D>
void exchangeMomentumAtEnd(const Patch& patch, const std::vector<Material>& materials,
                           const std::vector<Contact>& contacts, const Acceleration& acceleration, double time,
                           double dt, const Records& records, const SeparatingPlanes<D>& planes, VectorSum& reaction,
                           const TransmittedForces<D>& transmitted) {
  if (const auto present = presentIn(records); present.size() < records.size())  // then no material transmits force
    return exchangeMomentumAtEnd<D>(patch, materials, contactsAmong(contacts, present, records.size()), acceleration,
                                    time, dt, onlyOf(records, present), onlyOf(planes, present), reaction,
                                    onlyOf(transmitted, present));
  for (const auto& force : transmitted)
    if (force) force->fill(Vec<D>::Zero());
  const auto meeting = meetingIfPlanes<D>(contacts, records, planes);
  for (const Contact& contact : contacts) {
    const bool isSpecified = contact.type == Contact::Type::specified;
    const std::size_t master = contact.master;
    const bool transmits = isSpecified && materials[master].transmitsForce;
    if (transmits) addMomentum<D>(contact, records, 1 / dt, *transmitted[master]);
    if (isSpecified) sumReaction<D>(patch, contact, acceleration, dt, records, reaction);
    if (contact.type == Contact::Type::specifiedFriction)
      sumSlidingReaction<D>(patch, contact, acceleration, time, dt, records, planes, *meeting, reaction);
    applyContact<D>(patch, contact, time, dt, records, planes, meeting);
    if (transmits) addMomentum<D>(contact, records, -1 / dt, *transmitted[master]);
  }
}

}  // namespace tushar::mpm::solid
