#pragma once

#include <array>
#include <optional>

#include "components/mpm/solid/loads/load.hpp"

// Pressures on the faces of particles: convected boundary domain interpolation, CBDI; Sadeghirad, Brannon & Guilkey,
// Int. J. Numer. Meth. Engng 95 (2013) 928, section 4.

namespace tushar::mpm::solid {

/// The face of a particle on which a pressure acts.
struct LoadedFace {
  std::array<Vec3, 4> corners;  ///< corners [m]
  double stretch;               ///< ratio of the face's area to its initial area
};

/// A particle as a parallelepiped: its centre, and its initial and current edges, one per column [m].
struct ParticleBox {
  Vec3 middle;
  Matrix3 startEdges, edges;

  /// The face towards a normal, if there is one: the face whose edge is so nearly parallel to the normal that the
  /// cosine of their angle exceeds 0.9.
  std::optional<LoadedFace> face(const Vec3& normal) const;
};

/// The forces of a particle's loads at the corners of one of its faces.
struct CornerLoad {
  Vec3 force;                   ///< force [N], of which a quarter acts at each corner
  std::array<Vec3, 4> corners;  ///< corners [m]
};

/// The pressures and torques on a particle; `packed` contains their numbers in the form of p.loadCurveID. Without a
/// face towards the normal of a pressure there is no load, and a torque counts four times, as in Uintah.
std::optional<CornerLoad> cornerLoad(const Loads& loads, int packed, const ParticleBox& particle, double time);

}  // namespace tushar::mpm::solid
