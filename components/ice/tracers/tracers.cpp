#include "components/ice/tracers/tracers.hpp"

#include "components/euler/labels.hpp"
#include "components/ice/labels.hpp"

namespace tushar::ice {

std::string particleName(const std::string& name) { return name.starts_with("p.") ? name : "p." + name; }

TracerScalar::TracerScalar(TracerScalarSettings settings)
    : settings_(std::move(settings)),
      name_(particleName(settings_.name)),
      total_decay_name_(name_ + "_totalDecay"),
      coefficient_name_(name_ + "_expDecayCoef"),
      cells_name_("c.tracer-" + name_.substr(2) + "_expDecayCoef"),
      value_{name_, "1", "a quantity that tracers carry"},
      total_decay_{total_decay_name_, "s", "integral of the decay coefficient c2 over time"},
      coefficient_{coefficient_name_, "1", "decay coefficient c2 at the tracer"},
      coefficient_of_cells_{cells_name_, "1", "decay coefficient c2 of tracers in the cell"} {}

TracersOfGases::TracersOfGases(TracerSettings settings, const std::vector<std::string>& gases,
                               const std::vector<Cloneable>& cloneable)
    : settings_(std::move(settings)) {
  for (const std::string& gas : gases) {
    Tracers& tracers = tracers_.emplace_back(Tracers{gas.empty() ? "gas" : gas});
    if (!settings_.material.empty() && settings_.material != gas) continue;
    tracers.initial = settings_.initial;
    tracers.sources = settings_.sources;
  }
  for (const TracerScalarSettings& one : settings_.scalars)
    scalars_.push_back(std::make_unique<const TracerScalar>(one));
  for (const ClonedVariable& one : settings_.clones)
    for (const Cloneable& of : cloneable)
      if (of.name == one.name) clones_.push_back(std::make_unique<const TracerClone>(of));
}

void TracersOfGases::addNames(std::vector<std::pair<std::string, std::string>>& names) const {
  for (const auto& one : scalars_) {
    const std::string& name = one->settings().name;
    names.emplace_back(name, one->value().name);
    if (!one->decays()) continue;
    names.emplace_back(name + "_totalDecay", one->totalDecay().name);
    names.emplace_back(name + "_expDecayCoef", one->coefficient().name);
  }
}

std::vector<Cloneable> cloneableOf(const CarriedScalars& scalars, std::size_t gases, bool hasBodies) {
  std::vector<Cloneable> all;
  const auto add = [&](const std::string& uintahs, const CellLabel<double>& label, bool isOfState = false) {
    all.push_back({uintahs, &label, isOfState});
    all.push_back({std::string(label.name), &label, isOfState});
  };
  for (const auto& one : scalars) add(std::string(one->value().name.substr(2)), one->value());
  add("press_CC", euler::c::pressure);
  add("temp_CC", c::temperature);
  add("speedSound_CC", c::soundSpeed);
  add("sp_vol_CC", c::specificVolume);
  if (gases == 1 || hasBodies) add("rho_CC", euler::c::density, true);
  return all;
}

std::shared_ptr<const TracersOfGases> tracersOf(const std::optional<TracerSettings>& settings,
                                                const std::vector<std::string>& gases, const CarriedScalars& scalars,
                                                bool hasBodies) {
  if (!settings) return nullptr;
  return std::make_shared<const TracersOfGases>(*settings, gases, cloneableOf(scalars, gases.size(), hasBodies));
}

}  // namespace tushar::ice
