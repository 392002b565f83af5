#pragma once

#include <vector>

#include "components/mpm/solid/contact/contact.hpp"

// Materials that have no particles at all have no values on nodes (see simulation::MovesBetweenMaterials): tasks
// across materials leave them out, with their contacts.

namespace tushar::mpm::solid {

/// The indices of the materials that have values on nodes.
template <class T>
std::vector<std::size_t> presentIn(const std::vector<NodeView<T>>& records) {
  std::vector<std::size_t> present;
  for (std::size_t m = 0; m < records.size(); ++m)
    if (records[m].values()) present.push_back(m);
  return present;
}

/// The entries of a list over all materials that belong to those in `present`.
template <class T>
std::vector<T> onlyOf(const std::vector<T>& all, const std::vector<std::size_t>& present) {
  std::vector<T> chosen;
  chosen.reserve(present.size());
  for (const std::size_t m : present) chosen.push_back(all[m]);
  return chosen;
}

/// Those contacts that concern two or more of `count` materials that are present, or a master that is; their materials
/// are numbered by their places in `present`.
std::vector<Contact> contactsAmong(const std::vector<Contact>& contacts, const std::vector<std::size_t>& present,
                                   std::size_t count);

}  // namespace tushar::mpm::solid
