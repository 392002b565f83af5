#pragma once

#include <array>
#include <utility>
#include <vector>

#include "components/mpm/solid/tensor.hpp"
#include "core/core.hpp"
#include "core/input/geometry/piece.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// The particles of a body that a file lists, such as the solid voxels of a tomogram. Uintah's shape `file`. Lists
/// other than `at` are empty, or have one entry for each particle.
class ListedParticles : public input::GeometryPiece {
 public:
  std::vector<Vec3> at;             ///< position [m]
  std::vector<Matrix3> edges;       ///< edges of the particle, one per column [m]
  std::vector<double> volume;       ///< volume [m^3]
  std::vector<double> temperature;  ///< temperature [K]
  std::vector<double> color;        ///< p.color [1]
  std::vector<Vec3> velocity;       ///< velocity [m/s]

  /// Whether a point lies in the box around one of the particles; none has a box before `giveBoxes`.
  bool contains(const Vec3& point) const override { return halfAt(point) != nullptr; }
  /// The half widths of the box that contains a point [m], of the nearest particle if there are several; null if there
  /// is none.
  const Vec3* halfAt(const Vec3& point) const;
  /// The smallest box that contains all positions.
  input::Box3 bounds() const override;
  /// Gives each particle a box with these half widths [m], which may be infinite; `half` has one entry for all
  /// particles, or one for each.
  void giveBoxes(std::vector<Vec3> half);

 private:
  using Bin = std::array<int, 3>;

  const Vec3& halfOf(std::size_t particle) const { return half_[half_.size() == 1 ? 0 : particle]; }
  Bin binOf(const Vec3& point) const;

  std::vector<Vec3> half_;
  Vec3 binWidth_ = Vec3::Zero();                   ///< width of the bins, that of the widest box [m]
  std::vector<std::pair<Bin, std::size_t>> bins_;  ///< bin and number of each particle, sorted
};

/// The schema of the tag `file`.
const input::SchemaBase& listedParticlesSchema();

/// Reads the tag `file` and the file that it names. Returns null, with errors in the diagnostics, if one of them is
/// invalid.
std::shared_ptr<const ListedParticles> readListedParticles(const input::Element& tag, input::Diagnostics& diagnostics);

}  // namespace tushar::mpm::solid
