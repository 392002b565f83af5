#include "components/mpm/gas/conserving/input.hpp"

namespace tushar::mpm::gas::conserving {

std::unique_ptr<Component> (*makeConservingMpm)(const Level& level, const ConservingGasDynamics& method,
                                                const std::vector<Gas>& gases) = nullptr;

using input::Schema;

namespace {

const Schema<Remap>& remapSchema() {
  static const Schema<Remap> schema =
      Schema<Remap>("remap", "One new particle per cell, with the mass, momentum and energy of the gas in the cell.")
          .value("every", &Remap::every, 4, "1", "steps", input::positive())
          .ours()
          .value("overfilled", &Remap::overfilled, 0.02, "1",
                 "remap early if the particles of a cell exceed its volume by this fraction", input::nonNegative())
          .ours();
  return schema;
}

}  // namespace

const Schema<Section>& sectionSchema() {
  static const Schema<Viscosity> viscosity =
      Schema<Viscosity>("artificial_viscosity", "q = rho |dv| (C_q |dv| + C_l c) where a cell is compressed.")
          .value("quadratic", &Viscosity::quadratic, 1, "1", "C_q", input::nonNegative())
          .ours()
          .value("linear", &Viscosity::linear, 0.5, "1", "C_l", input::nonNegative())
          .ours();
  static const Schema<Section> schema =
      Schema<Section>("conserving_gas_dynamics", "A gas method that conserves mass, momentum and total energy.")
          .choice("transfer", &Section::transfer, {{"apic", Transfer::apic}, {"affine_flip", Transfer::affineFlip}},
                  Transfer::apic,
                  "particles take the grid's velocity (apic) or, where the gas is smooth, its change (affine_flip, "
                  "second order)")
          .ours()
          .value("cfl", &Section::cfl, 0.5, "1", "dt times the speed of signals over h; affine_flip: dt max(c) / h",
                 input::positive())
          .ours()
          .value("advective_cfl", &Section::advectiveCfl, 0.8, "1", "affine_flip: dt max |v_d| / h",
                 input::between(0.01, 1))
          .ours()
          .optional("longest_particle", &Section::longestParticle, "1",
                    "length in cells beyond which a particle is halved (2.36 in one dimension with apic, else 1.4); "
                    "halving costs accuracy",
                    input::between(1, 2.9))
          .ours()
          .section("artificial_viscosity", &Section::viscosity, viscosity)
          .ours()
          .value("artificial_heat_conduction", &Section::heatConduction, 0, "1",
                 "C_h of the heat flow C_h rho h^2 |dv/dx| de/dx in compressed cells (Noh 1987); 1 removes wall "
                 "heating",
                 input::between(0, 1))
          .ours()
          .section("remap", &Section::remap, remapSchema())
          .ours();
  return schema;
}

ConservingGasDynamics settle(const Section& read, int dimension) {
  const bool apic = read.transfer == Transfer::apic;
  ConservingGasDynamics method;
  method.transfer = read.transfer;
  method.cfl = read.cfl;
  method.advectiveCfl = read.advectiveCfl;
  method.longestParticle = read.longestParticle.value_or(apic && dimension == 1 ? 2.36 : 1.4);
  method.viscosity = read.viscosity.value_or(apic ? Viscosity{1, 0.5} : Viscosity{0.25, 0.25});
  method.heatConduction = read.heatConduction;
  method.remap = read.remap;
  return method;
}

}  // namespace tushar::mpm::gas::conserving
