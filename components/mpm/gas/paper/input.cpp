#include "components/mpm/gas/paper/input.hpp"

#include <fmt/format.h>

namespace tushar::mpm::gas::paper {

using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

const Schema<Redistribution>& redistributeSchema() {
  using Mode = Redistribution::Mode;
  static const Schema<Redistribution> schema =
      Schema<Redistribution>("redistribute", "New particles where a cell has too few or too many.")
          .location(&Redistribution::where)
          .choice(
              "mode", &Redistribution::mode, {{"split_merge", Mode::splitMerge}, {"reseed", Mode::reseed}},
              Mode::splitMerge,
              "halve large particles and merge close ones, or put new ones at the centres of equal parts of the cell")
          .ours()
          .value("min_particles", &Redistribution::minParticles, 2, "1",
                 "smallest number of particles in a cell that is not empty", input::positive())
          .ours()
          .value("max_particles", &Redistribution::maxParticles, 16, "1", "largest number of particles in a cell",
                 input::positive())
          .ours()
          .value("target_particles", &Redistribution::targetParticles, 4, "1", "number of particles in a reseeded cell",
                 input::positive())
          .ours()
          .check([](const Redistribution& r, const Element& element, Diagnostics& diagnostics) {
            if (r.minParticles > r.maxParticles)
              diagnostics.error(element, "min_particles is greater than max_particles");
            if (r.mode == Mode::reseed && (r.targetParticles < r.minParticles || r.targetParticles > r.maxParticles))
              diagnostics.error(element, "target_particles is not between min_particles and max_particles");
          });
  return schema;
}

}  // namespace

const Schema<GasDynamics>& methodSchema() {
  static const Schema<Viscosity> viscosity =
      Schema<Viscosity>("artificial_viscosity",
                        "The artificial viscosity of Monaghan & Pongracic (1985), equation (16) of the paper.")
          .value("quadratic", &Viscosity::quadratic, 0.6, "1", "C_q", input::nonNegative())
          .ours()
          .value("linear", &Viscosity::linear, 2.75, "1", "C_l", input::nonNegative())
          .ours();
  static const Schema<GasDynamics> schema =
      Schema<GasDynamics>("gas_dynamics", "The gas method of Tran, Kim & Berzins (2009).")
          .value("cfl", &GasDynamics::cfl, 0.2125, "1", "dt max(|v| + c) / h", input::positive())
          .ours()
          .section("artificial_viscosity", &GasDynamics::viscosity, viscosity)
          .ours()
          .value("density_filter", &GasDynamics::densityFilter, true, "1",
                 "whether extrema of the cells' density are smoothed, equation (18) of the paper")
          .ours()
          .choice("volume_model", &GasDynamics::volumeModel,
                  {{"cell_share", VolumeModel::cellShare}, {"tracked", VolumeModel::tracked}}, VolumeModel::cellShare,
                  "particles share their cell's volume, as in the paper, or keep their mass, which conserves mass and "
                  "energy")
          .ours()
          .section("redistribute", &GasDynamics::redistribute, redistributeSchema())
          .ours();
  return schema;
}

void checkSeeds(const Redistribution& how, int dimension) {
  const int along = how.seededAlongAxis(dimension);
  const int seeds = static_cast<int>(std::pow(along, dimension));
  if (how.mode != Redistribution::Mode::reseed || seeds <= how.maxParticles) return;
  throw InputError({{how.where, "MPM/gas_dynamics/redistribute",
                     fmt::format("target_particles: {} per cell are rounded up to {}, {} along each of {} axes, but "
                                 "max_particles is {}; decrease target_particles or increase max_particles",
                                 how.targetParticles, seeds, along, dimension, how.maxParticles)}});
}

}  // namespace tushar::mpm::gas::paper
