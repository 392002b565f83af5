#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "components/ice/scalar_decay.hpp"
#include "core/core.hpp"
#include "core/input/expression.hpp"
#include "core/input/geometry.hpp"

namespace tushar::ice {

/// A region with the initial value of a scalar, or with its source.
struct ScalarRegion {
  Location where;  ///< in the scene
  std::shared_ptr<const input::GeometryPiece> shape;
  input::Expression value;  ///< value of the scalar, or its increase in each step
  double most = 0;          ///< largest value after the increase
  bool isSine = false, isLinear = false;
  /// Number of waves along each axis: the value has a factor sin(2 pi waves_a d_a), where d_a runs from 0 to 1 through
  /// the region.
  Vec3 waves = Vec3::Zero();
  Vec3 slope = Vec3::Zero();  ///< slope in the term slope . d, which is added to the value

  /// The value of the scalar in the region at a point [m].
  double at(const Vec3& point) const;
};

/// `<Model type="PassiveScalar">`: a quantity per mass that is transported with the gas.
struct ScalarSettings {
  Location where;  ///< in the scene
  std::string name;
  ScalarDecay decay = {};              ///< how it falls with time
  double diffusivity = 0;              ///< diffusivity [m²/s]
  std::vector<ScalarRegion> start;     ///< initial values; where regions overlap, the last one applies
  std::vector<ScalarRegion> interior;  ///< sources: regions in which the scalar increases in each step
};

/// A scalar and the names of its variables, whose addresses must not change while tasks refer to them.
class CarriedScalar {
 public:
  explicit CarriedScalar(ScalarSettings settings)
      : settings_(std::move(settings)),
        words_{"scalar-" + settings_.name,
               "c.scalar-" + settings_.name,
               "c.held-scalar-" + settings_.name,
               "totalSum_scalar-" + settings_.name,
               "c.unshared-scalar-" + settings_.name,
               "c.scalar-" + settings_.name + "_expDecayCoef",
               "scalar-" + settings_.name + "_CC"} {}
  CarriedScalar(const CarriedScalar&) = delete;
  CarriedScalar& operator=(const CarriedScalar&) = delete;

  const ScalarSettings& settings() const { return settings_; }
  const CellLabel<double>& value() const { return value_; }
  const CellLabel<double>& held() const { return held_; }
  /// Like held(), but before small cells next to bodies are merged.
  const CellLabel<double>& unshared() const { return unshared_; }
  const ReductionLabel<Sum>& total() const { return total_; }
  /// The coefficient c2 of the decay.
  const CellLabel<double>& decayCoefficient() const { return decay_coefficient_; }
  /// The two labels for boundary conditions: the name of the scalar, and that with _CC, as in Uintah.
  const std::array<BoundaryLabel<double>, 2>& atSides() const { return atSides_; }
  /// Adds the names of its variables in Uintah, each with the name in Tushar.
  void addNames(std::vector<std::pair<std::string, std::string>>& names) const {
    names.emplace_back(words_[0], words_[1]);
    if (settings_.decay.isExponential) names.emplace_back(words_[5].substr(2), words_[5]);
  }
  /// Adds Uintah's variables of a scalar that no task computes here.
  void addForeignLabels(std::vector<std::string>& labels) const {
    labels.push_back("mag_grad_" + words_[0]);
    for (const char* end : {"_src", "_diffCoef", "_expDecayCoef", "RemovedScalar", "_X_FC_flux", "_Y_FC_flux",
                            "_Z_FC_flux", "_X_FC_corr", "_Y_FC_corr", "_Z_FC_corr"})
      labels.push_back(words_[0] + end);
  }

 private:
  ScalarSettings settings_;
  std::array<std::string, 7> words_;
  std::array<BoundaryLabel<double>, 2> atSides_{BoundaryLabel<double>(words_[0]), BoundaryLabel<double>(words_[6])};
  CellLabel<double> value_{words_[1], "1", "a quantity per mass that is transported with the gas"};
  CellLabel<double> held_{words_[2], "kg/m^3", "the scalar times density"};
  CellLabel<double> unshared_{words_[4], "kg/m^3", "the scalar times density, before small cells are merged"};
  CellLabel<double> decay_coefficient_{words_[5], "1", "coefficient c2 of the decay of a scalar"};
  ReductionLabel<Sum> total_{words_[3], "kg", "amount of the scalar in all cells"};
};

using CarriedScalars = std::vector<std::shared_ptr<const CarriedScalar>>;

/// Uintah's names of the scalars for which boundary conditions may be given.
inline constexpr std::array<const char*, 4> scalarsAtSides{"scalar-f", "scalar-q", "scalar-f_CC", "scalar-q_CC"};

}  // namespace tushar::ice
