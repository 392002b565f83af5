#include "components/ice/heating_input.hpp"

#include <fmt/format.h>

namespace tushar::ice {

Heating heatingOf(const HeatingSection& read, int solids, std::size_t gases, input::Diagnostics& diagnostics) {
  Heating heating{read.where, std::vector<double>(gases), read.start, read.end};
  const auto refuse = [&](const std::string& sentence) { diagnostics.error(read.where, "CFD/ICE/ADD_HEAT", sentence); };
  if (read.materials.size() != read.perMass.size())
    refuse(fmt::format("found {} materials and {} coefficients, expected one coefficient for each material",
                       read.materials.size(), read.perMass.size()));
  else if (read.materials.empty())
    refuse("found no materials, expected at least one");
  if (read.end < read.start)
    refuse(
        fmt::format("found <add_heat_t_final> {:g}, expected at least <add_heat_t_start>, {:g}", read.end, read.start));
  std::vector<bool> isGiven(gases);
  for (std::size_t k = 0; k < std::min(read.materials.size(), read.perMass.size()); ++k) {
    const int number = read.materials[k], gas = number - solids;
    if (gas < 0 || gas >= static_cast<int>(gases)) {
      refuse(fmt::format("material {} is not available: only gases can be heated, which have indices {} to {}", number,
                         solids, solids + static_cast<int>(gases) - 1));
      continue;
    }
    if (isGiven[gas]) refuse(fmt::format("material {} is given twice", number));
    isGiven[gas] = true;
    heating.perMass[gas] = read.perMass[k];
  }
  return heating;
}

}  // namespace tushar::ice
