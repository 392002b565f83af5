#pragma once

#include <array>
#include <span>
#include <vector>

#include "components/mpm/solid/grains/grain.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid {

/// The box that a particle occupies at the critical density, along the axes that the grid uses.
struct GrainBox {
  ParticleId id = 0;
  int material = 0;
  int type = 0;                            ///< type of its material; ids are unique within a type
  std::array<double, 3> centre{}, half{};  ///< centre, and half of each edge [m]

  /// The order of boxes that does not depend on patches.
  bool operator<(const GrainBox& other) const { return type != other.type ? type < other.type : id < other.id; }
};

/// The space in which boxes overlap.
struct GrainSpace {
  int dimension = 3;
  std::array<double, 3> period{};  ///< period along each axis [m]; 0: none
};

/// For each box, the index of the first box of its cluster. Boxes that overlap or touch are in one cluster.
std::vector<int> clustersOf(std::span<const GrainBox> boxes, const GrainSpace& space);

/// For each box, the material to which its particle belongs from now on. The particles of one type in a cluster form a
/// part, which needs a material of its own: one with contacts if the cluster has particles of other types, too, and one
/// without contacts otherwise. A part keeps the material that most of its particles have, if this has, or lacks,
/// contacts as needed and no other part has more particles in it. Otherwise, it moves to the first suitable material of
/// its type that has no particles. Particles of materials that may not split stay where they are.
///
/// `boxes` are sorted, and `clusters` are those of clustersOf. Throws NumericalError if there are not enough materials,
/// and for equal ids within a type.
std::vector<int> materialsOfClusters(std::span<const GrainBox> boxes, const std::vector<int>& clusters,
                                     const std::vector<Grain>& materials);

}  // namespace tushar::mpm::solid
