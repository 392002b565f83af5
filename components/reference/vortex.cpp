#include "components/reference/vortex.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace tushar::reference {

void VortexProblem::requireGas(const std::string& name) const {
  if (!(density > 0 && pressure > 0 && gamma > 1 && radius > 0))
    throw std::invalid_argument(
        fmt::format("{} needs a positive density, pressure and radius and a gamma above 1, but has {}, {}, {} and {}.",
                    name, density, pressure, radius, gamma));
  if (axis < 0 || axis > 2)
    throw std::invalid_argument(fmt::format("The axis of a vortex must be 0, 1 or 2, not {}.", axis));
}

}  // namespace tushar::reference
