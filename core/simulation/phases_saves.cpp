#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "core/input/values.hpp"
#include "core/simulation/phases.hpp"

// Which materials a scene saves, by name or by number.

namespace tushar::simulation {

namespace {

/// The numbers in a text such as `0`, `0,2` or `1-3`; none if the text has another form.
std::vector<int> numbersIn(const std::string& text) {
  std::vector<int> numbers;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const auto dash = part.find('-');
    const auto first = input::parse<int>(part.substr(0, dash));
    const auto last = dash == std::string::npos ? first : input::parse<int>(part.substr(dash + 1));
    if (!first.value || !last.value || *first.value < 0 || *last.value < *first.value) return {};
    for (int number = *first.value; number <= *last.value; ++number) numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

bool Phases::isMaterial(const std::string& name) const {
  return std::find(materials_.begin(), materials_.end(), name) != materials_.end();
}

bool Phases::isOfMaterials(const std::string& label) const {
  for (const auto* list : {&lists_.initialize, &lists_.timeAdvance, &lists_.diagnostics})
    for (const tasks::Task& task : list->tasks())
      for (const tasks::Access& access : task.accesses)
        if (access.writes() && access.label->name == label) return task.perMaterial(access);
  return false;
}

bool Phases::isTotal(const std::string& label) const {
  for (const auto* list : {&lists_.initialize, &lists_.timeAdvance, &lists_.diagnostics, &lists_.afterStep})
    for (const tasks::Task& task : list->tasks())
      for (const tasks::Access& access : task.accesses)
        if (access.writes() && access.label->name == label) return access.label->centring == data::Centring::reduction;
  return false;
}

std::vector<SaveRequest> Phases::named(const std::vector<SaveRequest>& saves) const {
  const int count = static_cast<int>(materials_.size());
  std::vector<SaveRequest> all;
  for (SaveRequest save : saves) {
    const std::vector<int> numbers = isMaterial(save.material) ? std::vector<int>{} : numbersIn(save.material);
    const bool isOfAll = std::find(numbers.begin(), numbers.end(), count) != numbers.end();
    if (isOfAll || (save.material == "all" && !isMaterial("all"))) save.material.clear();
    if (numbers.empty() || isOfAll) {
      all.push_back(save);
      continue;
    }
    for (const int number : numbers) {
      if (number > count) continue;
      save.material = materials_[number];
      all.push_back(save);
    }
  }
  return all;
}

std::vector<std::string> Phases::remarksOn(const SaveRequest& save) const {
  const int count = static_cast<int>(materials_.size());
  std::vector<std::string> remarks;
  if (isMaterial(save.material)) return remarks;
  for (const int number : numbersIn(save.material))
    if (number == count)
      remarks.push_back(
          fmt::format("in Uintah, material {} means all materials together; here, '{}' is saved for each of them",
                      number, save.label));
    else if (number > count)
      remarks.push_back(fmt::format("does nothing for {}: materials are numbered from 0 to {}", number, count - 1));
  return remarks;
}

std::vector<std::string> Phases::savedBesides() const {
  std::vector<std::string> others;
  const std::vector<std::string>& counted = fingerprinted();
  std::set_difference(lasting_.begin(), lasting_.end(), counted.begin(), counted.end(), std::back_inserter(others));
  return others;
}

}  // namespace tushar::simulation
