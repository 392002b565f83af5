#pragma once

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "components/mpm/solid/grains/clusters.hpp"
#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/material.hpp"
#include "core/base/mpi.hpp"
#include "core/simulation/between_materials.hpp"

namespace tushar::mpm::solid {

/// The variables of a material from which clusters follow.
template <int D>
struct ClusterSources {
  ParticleView<const Vec<D>> x;
  ParticleView<const Matrix3> deformation;
  OptionalView<const Vec<D>> size;  ///< initial edge lengths in cells, if they differ
  ParticleView<const ParticleId> id;
  ParticleView<int> next;

  static ClusterSources from(auto& take, bool keepsSizes) {
    return {.x = take(requiresOld(p::x<D>)),
            .deformation = take(requiresOld(p::deformationMeasure)),
            .size = take(when(keepsSizes, requiresOld(p::size<D>))),
            .id = take(requiresOld(data::particleId)),
            .next = take(computes(simulation::nextMaterial))};
  }
};

/// The edges that a particle has at the critical density, relative to its initial ones: (rho_0 / (J rho_c))^(1/D), as
/// Uintah estimates them.
template <int D>
double edgeAtCriticalDensity(const Material& material, const Matrix3& deformation) {
  const double volume = material.density / (deformation.determinant() * *material.criticalDensity);
  if constexpr (D == 1) return volume;
  return D == 2 ? std::sqrt(volume) : std::cbrt(volume);
}

/// Adds the boxes of a material's particles on a patch.
template <int D>
void addBoxes(const Patch& patch, const Material& material, const Vec3& commonSize, const ClusterSources<D>& u,
              std::vector<GrainBox>& boxes) {
  const Level& level = patch.level();
  const Vec<D> common = level.reduce<D>(commonSize);
  for (int p = 0; p < u.x.owned(); ++p) {
    GrainBox& box = boxes.emplace_back();
    box.id = u.id[p];
    box.material = material.index;
    box.type = *material.grainType;
    const double edge = edgeAtCriticalDensity<D>(material, u.deformation[p]);
    for (int d = 0; d < D; ++d) {
      box.centre[d] = u.x[p][d];
      box.half[d] = 0.5 * edge * (u.size ? (*u.size)[p][d] : common[d]) * level.spacing(d);
    }
  }
}

/// The boxes of all ranks, sorted, on each of them.
std::vector<GrainBox> gatheredBoxes(std::vector<GrainBox> mine, const mpi::Communicator& ranks);

/// Finds the clusters of particles that overlap at their critical density, and the material of each for the next step.
/// All ranks find all clusters, so that these do not depend on patches and ranks.
template <int D>
void formClusters(const RankPatches& patches, const std::vector<Material>& materials, const mpi::Communicator& ranks,
                  const Vec3& commonSize, const std::vector<std::vector<ClusterSources<D>>>& u) {
  std::vector<GrainBox> mine;
  for (std::size_t k = 0; k < patches.size(); ++k)
    for (std::size_t m = 0; m < materials.size(); ++m)
      addBoxes<D>(*patches[k], materials[m], commonSize, u[k][m], mine);
  const std::vector<GrainBox> boxes = gatheredBoxes(std::move(mine), ranks);
  const Level& level = patches.front()->level();
  GrainSpace space{.dimension = D};
  for (int d = 0; d < D; ++d) space.period[d] = level.isPeriodic(d) ? level.period(d) : 0;
  std::vector<Grain> grains;
  for (const Material& material : materials) grains.push_back(material.grain());
  const std::vector<int> next = materialsOfClusters(boxes, clustersOf(boxes, space), grains);
  for (std::size_t k = 0; k < patches.size(); ++k)
    for (std::size_t m = 0; m < materials.size(); ++m)
      for (int p = 0; p < u[k][m].x.owned(); ++p) {
        GrainBox wanted;
        wanted.id = u[k][m].id[p];
        wanted.type = *materials[m].grainType;
        const auto found = std::lower_bound(boxes.begin(), boxes.end(), wanted);
        u[k][m].next[p] = next[static_cast<std::size_t>(found - boxes.begin())];
      }
}

}  // namespace tushar::mpm::solid
