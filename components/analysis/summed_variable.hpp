#pragma once

#include "components/analysis/time_sums.hpp"
#include "core/simulation/settings.hpp"

namespace tushar::analysis {

/// A label whose texts are its own. Its address must not change.
template <class T>
class OwnLabel {
 public:
  OwnLabel(const std::string& name, std::string unit, std::string meaning)
      : texts_{"c." + name, std::move(unit), std::move(meaning)}, label_(texts_[0], texts_[1], texts_[2]) {}
  OwnLabel(const OwnLabel&) = delete;
  OwnLabel& operator=(const OwnLabel&) = delete;

  const CellLabel<T>& label() const { return label_; }
  std::pair<std::string, std::string> names() const { return {texts_[0].substr(2), texts_[0]}; }

 private:
  std::array<std::string, 3> texts_;
  CellLabel<T> label_;
};

/// A variable of cells that the component computes, in its state or by diagnostics.
struct CellVariable {
  const data::Label* label = nullptr;
  bool isDerived = false;  ///< whether diagnostics compute it
};

/// Reads the current value of a variable, in tasks that follow the diagnostics.
template <class T>
auto current(const CellVariable& variable) {
  const auto& label = *static_cast<const CellLabel<T>*>(variable.label);
  return variable.isDerived ? requiresNew(label) : requiresOld(label);
}

/// The sums over time of a variable, and the tasks that compute and use them.
class SummedVariable {
 public:
  virtual ~SummedVariable() = default;
  /// Adds the tasks that add the current state to the sums.
  virtual void scheduleSums(TaskList& tasks, const SamplesBetween& between, const CellLabel<double>& count) const = 0;
  /// Adds the tasks that compute what can be saved.
  virtual void scheduleDerived(TaskList& tasks, const CellLabel<double>& count) const = 0;
  /// The names in scenes, and those of labels.
  virtual simulation::OtherNames names() const = 0;
};

/// K: the number of powers. `velocity`: with which products are formed.
template <int D, class T, int K>
class SummedVariableOf : public SummedVariable {
  static constexpr int N = data::Stored<T>::components;

 public:
  SummedVariableOf(const CellVariable& variable, const CellVariable& velocity, const NamesOfSums& names,
                   const std::string& velocityName)
      : variable_(variable),
        velocity_(velocity),
        sums_("sums_" + names.variable, "1", "sums over time of powers of a variable"),
        sums_of_velocity_("sums_" + velocityName, "1", "sums over time of powers of the velocity"),
        products_("products_" + names.variable, "1", "sum over time of products with the velocity") {
    const std::string unit(variable.label->unit);
    offer("mean_" + names.variable, unit, {1});
    offer("sum_" + names.variable, unit, {1, false, true});
    offer("variance_" + names.variable, power(unit, 2), {2});
    offer(names.meanSquare, power(unit, 2), {2, false});
    offer(names.sumOfSquares, power(unit, 2), {2, false, true});
    if (K == 4) {
      offer("skewness_" + names.variable, power(unit, 3), {3});
      offer("kurtosis_" + names.variable, power(unit, 4), {4});
    }
    if (!hasProducts()) return;
    const std::string both = unit == "m/s" ? power(unit, 2) : unit == "1" ? "m/s" : unit + " m/s";
    offerProducts(names.covariance, both, {0});
    offerProducts(names.meanProducts, both, {0, false});
    offerProducts(names.sumOfProducts, both, {0, false, true});
  }

  void scheduleSums(TaskList& tasks, const SamplesBetween& between, const CellLabel<double>& count) const override {
    tasks.perPatch("statistics::addSample", addSample<D, T, K>, with(between), startTime(), current<T>(variable_),
                   requiresOld(count), requiresOld(sums_.label()), computes(sums_.label()));
    if (!hasProducts()) return;
    const auto body = [](const Patch& patch, const SamplesBetween& when, double time, CellView<const T> value,
                         CellView<const Moments<N, K>> sums, CellView<const Vec<D>> velocity,
                         CellView<const Moments<D, K>> sumsOfVelocity, CellView<const double> samples,
                         CellView<const Vec3> before, CellView<Vec3> after) {
      addProducts<D, T, K>(patch, when, time, {value, sums}, {velocity, sumsOfVelocity}, samples, before, after);
    };
    tasks.perPatch("statistics::addProducts", body, with(between), startTime(), current<T>(variable_),
                   requiresOld(sums_.label()), current<Vec<D>>(velocity_), requiresOld(sums_of_velocity_.label()),
                   requiresOld(count), requiresOld(products_.label()), computes(products_.label()));
  }

  void scheduleDerived(TaskList& tasks, const CellLabel<double>& count) const override {
    for (const auto& [which, label] : moments_)
      tasks.perPatch(taskOf(*label), deriveMoment<D, T, K>, with(which), requiresOld(count), requiresOld(sums_.label()),
                     computes(label->label()));
    const auto body = [](const Patch& patch, const Derived& which, CellView<const double> samples,
                         CellView<const Moments<N, K>> sums, CellView<const Moments<D, K>> sumsOfVelocity,
                         CellView<const Vec3> products, CellView<Vec3> result) {
      deriveProducts<D, T, K>(patch, which, samples, {sums, sumsOfVelocity}, products, result);
    };
    for (const auto& [which, label] : with_velocity_)
      tasks.perPatch(taskOf(*label), body, with(which), requiresOld(count), requiresOld(sums_.label()),
                     requiresOld(sums_of_velocity_.label()), requiresOld(products_.label()), computes(label->label()));
  }

  simulation::OtherNames names() const override {
    simulation::OtherNames all;
    for (const auto& [which, label] : moments_) all.push_back(label->names());
    for (const auto& [which, label] : with_velocity_) all.push_back(label->names());
    return all;
  }

 private:
  static std::string power(const std::string& unit, int exponent) {
    if (unit == "1") return unit;
    const bool isSimple = unit.find_first_of(" /^") == std::string::npos;
    return fmt::format("{}{}{}^{}", isSimple ? "" : "(", unit, isSimple ? "" : ")", exponent);
  }
  template <class Own>
  static std::string taskOf(const Own& own) {
    return fmt::format("statistics::compute {}", own.label().name);
  }
  bool hasProducts() const { return velocity_.label != nullptr; }
  void offer(const std::string& name, const std::string& unit, const Derived& which) {
    if (!name.empty()) moments_.emplace_back(which, std::make_unique<OwnLabel<T>>(name, unit, "statistics over time"));
  }
  void offerProducts(const std::string& name, const std::string& unit, const Derived& which) {
    if (!name.empty())
      with_velocity_.emplace_back(which, std::make_unique<OwnLabel<Vec3>>(name, unit, "statistics over time"));
  }

  CellVariable variable_, velocity_;
  OwnLabel<Moments<N, K>> sums_;
  OwnLabel<Moments<D, K>> sums_of_velocity_;
  OwnLabel<Vec3> products_;
  std::vector<std::pair<Derived, std::unique_ptr<OwnLabel<T>>>> moments_;
  std::vector<std::pair<Derived, std::unique_ptr<OwnLabel<Vec3>>>> with_velocity_;
};

}  // namespace tushar::analysis
