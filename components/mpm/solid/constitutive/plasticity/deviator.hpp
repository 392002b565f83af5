#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "components/mpm/solid/constitutive/maxwell.hpp"
#include "components/mpm/solid/tensor.hpp"
#include "core/input/schema.hpp"
#include "core/input/values.hpp"

namespace tushar::mpm::solid {

/// Hypoelastic deviator: ds/dt = 2 G dev D without yielding.
struct HypoelasticDeviator {
  static constexpr std::string_view name = "hypoElastic";

  static const input::Schema<HypoelasticDeviator>& schema() {
    static const input::Schema<HypoelasticDeviator> schema("deviatoric_stress_model",
                                                           "The stress deviator grows with 2 G dev D.");
    return schema;
  }
};

/// Parallel Maxwell elements, ds_j/dt = 2 mu_j (dev D - D_p) - s_j/tau_j, s = sum_j s_j, with the plastic strain rate
/// D_p common to all. In a step, s is the deviator of an elastic body with the shear modulus sum_j gained_j mu_j and
/// the deviator sum_j kept_j s_j at the start: see MaxwellStep. Uintah's steps are explicit and return with the
/// <shear_modulus>, which should be sum_j mu_j.
struct MaxwellDeviator {
  static constexpr std::string_view name = "hypoViscoElastic";
  static constexpr int greatestCount = 5;

  int count = 0;
  std::array<double, greatestCount> modulus{};  ///< modulus mu_j [Pa]
  std::array<double, greatestCount> time{};     ///< time tau_j [s]

  static const input::Schema<MaxwellDeviator>& schema() {
    static const input::Schema<MaxwellDeviator> schema = makeSchema();
    return schema;
  }
  MaxwellStep step(int j, double timeStep) const { return MaxwellStep(timeStep / time[j]); }
  /// Shear modulus for a step [Pa]; for a step of 0, that of a fast wave.
  double modulusIn(double timeStep) const {
    double sum = 0;
    for (int j = 0; j < count; ++j) sum += step(j, timeStep).gained * modulus[j];
    return sum;
  }
  /// Power of the dashpots per volume, sum s_j:s_j / (2 mu_j tau_j) [W/m³], with the stress deviators s_j [Pa].
  double dissipation(const std::array<Tensor, greatestCount>& deviators) const {
    double sum = 0;
    for (int j = 0; j < count; ++j)
      if (modulus[j] > 0) sum += matrixOf(deviators[j]).squaredNorm() / (2 * modulus[j] * time[j]);
    return sum;
  }

 private:
  static input::Schema<MaxwellDeviator> makeSchema() {
    input::Schema<MaxwellDeviator> tags("deviatoric_stress_model", "Maxwell elements, whose stress relaxes.");
    tags.custom(
            "mu",
            [](MaxwellDeviator& read, const input::Element& element, input::Diagnostics& diagnostics) {
              readElements(read, element, diagnostics);
            },
            {"mu", "tau"},
            "shear moduli (Pa) and relaxation times (s) of up to " + std::to_string(greatestCount) + " elements")
        .forms({input::typeForm({"mu", "tau"}, std::string(input::typeName<std::vector<double>>), 1)});
    return tags;
  }
  static void readElements(MaxwellDeviator& read, const input::Element& element, input::Diagnostics& diagnostics) {
    const std::vector<double> moduli = numbersOf("mu", element, diagnostics);
    const std::vector<double> times = numbersOf("tau", element, diagnostics);
    if (moduli.size() != times.size())
      return diagnostics.error(element, "<mu> and <tau> are lists of different lengths");
    if (moduli.size() > greatestCount)
      return diagnostics.error(element, "at most " + std::to_string(greatestCount) + " elements are available");
    read.count = int(moduli.size());
    std::copy(moduli.begin(), moduli.end(), read.modulus.begin());
    std::copy(times.begin(), times.end(), read.time.begin());
  }
  static std::vector<double> numbersOf(const std::string& tag, const input::Element& element,
                                       input::Diagnostics& diagnostics) {
    const auto given = element.child(tag);
    if (!given) {
      diagnostics.error(element, "missing tag <" + tag + "> in <" + element.name() + ">");
      return {};
    }
    const auto read = input::parse<std::vector<double>>(given->text());
    if (!read.problem.empty()) {
      diagnostics.error(*given, read.problem);
      return {};
    }
    for (const double number : *read.value)
      if (number <= 0) diagnostics.error(*given, "contains a number that is not positive");
    return *read.value;
  }
};

/// The models of the deviator; the first is the default, as in Uintah.
using DeviatorModel = std::variant<HypoelasticDeviator, MaxwellDeviator>;

}  // namespace tushar::mpm::solid
