#pragma once

#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/material.hpp"

namespace tushar::mpm::solid {

/// Fills each body with its particles, `particlesPerCell` along each axis in the middle of equal parts of a cell, where
/// that point is inside the shape. Bodies may overlap, as in Uintah.
///
/// The id of a particle is its cell's number and its place in the cell, so that it does not depend on the patches.
template <int D>
void actuallyInitialize(const Patch& patch, const Material& material, ParticleMaker& maker, std::vector<Vec<D>>& x,
                        std::vector<Vec<D>>& velocity, std::vector<Vec<D>>& displacement, std::vector<Vec<D>>& size,
                        std::vector<double>& mass, std::vector<double>& volume, std::vector<double>& temperature,
                        std::vector<double>& color, std::vector<Matrix3>& deformation, std::vector<Matrix3>& stress,
                        std::vector<double>& viscosity, std::vector<double>& strainEnergy) {
  const Level& level = patch.level();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    ParticleId inCell = 0;
    for (const Body& body : material.bodies) {
      Box places{{}, Index3::filled(1)};
      Vec<D> extent;
      for (int d = 0; d < D; ++d) {
        places.upper[d] = body.particlesPerCell[level.axis(d)];
        extent[d] = 1.0 / places.upper[d];
      }
      forEach<D>(places, [&](const Index<D>& k) {
        Vec<D> at;
        for (int d = 0; d < D; ++d)
          at[d] = level.nodePosition(d, 0) + (cell[d] + (k[d] + 0.5) * extent[d]) * level.spacing(d);
        const Vec3 point = level.expandPoint<D>(at);
        if (!body.shape->contains(point)) return;
        maker.add(cell, (level.cellNumber(cell) << 16) + inCell++);
        x.push_back(at);
        velocity.push_back(level.reduce<D>(body.velocity(point)));
        displacement.push_back(Vec<D>::Zero());
        size.push_back(extent);
        volume.push_back(level.cellVolume() * extent.prod());
        mass.push_back(body.density(point) * volume.back());
        temperature.push_back(body.temperature(point));
        color.push_back(body.color);
        deformation.push_back(Matrix3::Identity());
        stress.push_back(Matrix3::Zero());
        viscosity.push_back(0);
        strainEnergy.push_back(0);
      });
    }
  });
}

}  // namespace tushar::mpm::solid
