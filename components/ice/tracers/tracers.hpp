#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "components/ice/scalar.hpp"
#include "core/core.hpp"
#include "core/input/geometry.hpp"

namespace tushar::ice {

/// A region in which tracers are made, in each cell whose centre it contains.
struct TracerRegion {
  Location where;  ///< in the scene
  std::shared_ptr<const input::GeometryPiece> shape;
  int perCell = 0;            ///< at the start
  double perCellPerTime = 0;  ///< during the run [1/s]
};

/// The name of a scalar in Tushar, where variables of particles begin with `p.`.
std::string particleName(const std::string& name);

/// A quantity that tracers carry, which may fall with time.
struct TracerScalarSettings {
  Location where;  ///< in the scene
  std::string name;
  double initialValue = 0;
  ScalarDecay decay = {};
};

/// A variable of cells whose value tracers show.
struct ClonedVariable {
  Location where;  ///< in the scene
  std::string name;
};

/// `<Model type="TracerParticles">`: particles without mass that move with the gas.
struct TracerSettings {
  Location where;                                               ///< in the scene
  std::string material;                                         ///< name of the gas; empty if the scene names none
  double start = 0, stop = std::numeric_limits<double>::max();  ///< when tracers may be made [s]
  std::vector<TracerRegion> initial, sources;
  std::vector<TracerScalarSettings> scalars;
  std::vector<ClonedVariable> clones;
};

/// Labels of tracers.
namespace p {
template <int D>
inline constexpr ParticleLabel<Vec<D>> x{"p.x", "m", "position"};
template <int D>
inline constexpr ParticleLabel<Vec<D>> velocity{"p.velocity", "m/s", "velocity"};
template <int D>
inline constexpr ParticleLabel<Vec<D>> displacement{"p.displacement", "m", "displacement since the start"};
}  // namespace p

namespace c {
template <int D>
inline constexpr CellLabel<Vec<D>> flow{"c.flow", "m/s",
                                        "velocity with which tracers move: of the gas, or of the body in the cell"};
}  // namespace c

namespace total {
inline constexpr ReductionLabel<Sum> tracers{"Tracers", "1", "number of tracers in the grid"};
}  // namespace total

/// A quantity that tracers carry, and the names of its variables, whose addresses must not change.
class TracerScalar {
 public:
  explicit TracerScalar(TracerScalarSettings settings);
  TracerScalar(const TracerScalar&) = delete;
  TracerScalar& operator=(const TracerScalar&) = delete;

  const TracerScalarSettings& settings() const { return settings_; }
  bool decays() const { return settings_.decay.isExponential; }
  const ParticleLabel<double>& value() const { return value_; }
  /// The integral of c2 over time.
  const ParticleLabel<double>& totalDecay() const { return total_decay_; }
  /// c2 at the place of the tracer, and in cells.
  const ParticleLabel<double>& coefficient() const { return coefficient_; }
  const CellLabel<double>& coefficientOfCells() const { return coefficient_of_cells_; }

 private:
  TracerScalarSettings settings_;
  std::string name_, total_decay_name_, coefficient_name_, cells_name_;
  ParticleLabel<double> value_, total_decay_, coefficient_;
  CellLabel<double> coefficient_of_cells_;
};

/// Scalars of tracers, for which tasks have variables.
using TracerScalars = std::vector<std::unique_ptr<const TracerScalar>>;

/// A cell variable that tracers can show.
struct Cloneable {
  std::string name;  ///< in the scene: that of Uintah, or that of Tushar
  const CellLabel<double>* label;
  bool isOfState = false;  ///< whether it belongs to the state; otherwise a diagnostic task computes it
};

/// A variable of tracers that shows the value of a variable in their cell.
class TracerClone {
 public:
  explicit TracerClone(const Cloneable& of)
      : name_("p.clone-" + of.name),
        of_(of),
        label_{name_, of.label->unit, "value of a variable in the tracer's cell"} {}
  TracerClone(const TracerClone&) = delete;
  TracerClone& operator=(const TracerClone&) = delete;

  const Cloneable& of() const { return of_; }
  const ParticleLabel<double>& label() const { return label_; }

 private:
  std::string name_;
  Cloneable of_;
  ParticleLabel<double> label_;
};

/// The tracers of a gas; a gas without tracers has no regions.
struct Tracers {
  std::string name;  ///< that of the gas
  std::vector<TracerRegion> initial = {}, sources = {};
};

/// The tracers of a scene: those of each gas, and what all of them carry.
class TracersOfGases {
 public:
  /// The labels of `cloneable` must outlive this object; the settings name some of these variables.
  TracersOfGases(TracerSettings settings, const std::vector<std::string>& gases,
                 const std::vector<Cloneable>& cloneable);

  const TracerSettings& settings() const { return settings_; }
  const std::vector<Tracers>& ofGases() const { return tracers_; }
  const TracerScalars& scalars() const { return scalars_; }
  const std::vector<std::unique_ptr<const TracerClone>>& clones() const { return clones_; }
  bool hasSources() const { return !settings_.sources.empty(); }
  /// Adds the names of scalars in Uintah, each with the name in Tushar.
  void addNames(std::vector<std::pair<std::string, std::string>>& names) const;

 private:
  TracerSettings settings_;
  std::vector<Tracers> tracers_;
  TracerScalars scalars_;
  std::vector<std::unique_ptr<const TracerClone>> clones_;
};

/// The tracers of a scene with these gases, which carry `scalars`; null if there are none.
std::shared_ptr<const TracersOfGases> tracersOf(const std::optional<TracerSettings>& settings,
                                                const std::vector<std::string>& gases, const CarriedScalars& scalars,
                                                bool hasBodies);
/// The variables that tracers can show: those of `scalars`, and those of a single gas or of all gases together.
std::vector<Cloneable> cloneableOf(const CarriedScalars& scalars, std::size_t gases, bool hasBodies);

/// The reasons why tracers need a grid of one level and of one box.
inline constexpr const char* tracersOnOneLevel =
    "the tracers of a <Model type=\"TracerParticles\"> move on one level; remove the model, or <AMR>";
inline constexpr const char* tracersInOneBox =
    "the tracers of a <Model type=\"TracerParticles\"> move in one box; remove the model";

}  // namespace tushar::ice
