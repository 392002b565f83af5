#include "components/mpm/solid/contact/present.hpp"

namespace tushar::mpm::solid {

std::vector<Contact> contactsAmong(const std::vector<Contact>& contacts, const std::vector<std::size_t>& present,
                                   std::size_t count) {
  std::vector<int> place(count, -1);
  for (std::size_t k = 0; k < present.size(); ++k) place[present[k]] = static_cast<int>(k);
  const auto placeOf = [&](int material) {
    return material >= 0 && static_cast<std::size_t>(material) < count ? place[material] : -1;
  };
  std::vector<Contact> among;
  for (const Contact& contact : contacts) {
    std::vector<int> materials;
    for (const int material : contact.materials)
      if (placeOf(material) >= 0) materials.push_back(placeOf(material));
    if (!contact.materials.empty() && materials.size() < 2) continue;
    if ((contact.hasMaster() || !contact.frictionOfColor.empty()) && placeOf(contact.master) < 0) continue;
    Contact& one = among.emplace_back(contact);
    one.materials = materials;
    one.master = std::max(placeOf(contact.master), 0);
    one.excluded = placeOf(contact.excluded);
  }
  return among;
}

}  // namespace tushar::mpm::solid
