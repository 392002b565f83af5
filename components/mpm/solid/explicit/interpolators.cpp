#include "components/mpm/solid/explicit/interpolators.hpp"

#include <array>

#include "core/simulation/module.hpp"

namespace tushar::mpm::solid {

namespace {

constexpr std::array modules{"mpm_solid_linear", "mpm_solid_gimp", "mpm_solid_cpdi", "mpm_solid_quadratic",
                             "mpm_solid_cubic"};

struct Makers {
  MakeSolids plane = nullptr, axisymmetric = nullptr;
};
std::array<Makers, modules.size()>& makers() {
  static std::array<Makers, modules.size()> makers;
  return makers;
}

}  // namespace

MakeSolids solidsOf(Interpolator interpolator, bool isAxisymmetric) {
  const auto place = static_cast<std::size_t>(interpolator);
  simulation::loadModule(modules[place]);
  return isAxisymmetric ? makers()[place].axisymmetric : makers()[place].plane;
}

void defineSolids(Interpolator interpolator, MakeSolids make, MakeSolids axisymmetric) {
  makers()[static_cast<std::size_t>(interpolator)] = {make, axisymmetric};
}

}  // namespace tushar::mpm::solid
