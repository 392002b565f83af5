#pragma once

#include <string>
#include <vector>

#include "core/input/schema.hpp"
#include "core/input/values.hpp"

namespace tushar::mpm::solid {

/// A switch of Uintah's that only stands at `false` or 0 here; `instead` says what there is.
template <class S>
void refuseSwitch(input::Schema<S>& schema, const std::string& tag, const std::string& instead) {
  schema.custom(tag,
                [tag, instead](S&, const input::Element& element, input::Diagnostics& diagnostics) {
                  const auto given = element.child(tag);
                  if (!given || given->text() == "false" || input::parse<double>(given->text()).value == 0.0) return;
                  diagnostics.error(*given, "is not available; " + instead);
                },
                {tag}, "only false: " + instead);
}

/// A choice of Uintah's of which only `available` are there; may be left out.
template <class S>
void refuseTypes(input::Schema<S>& schema, const std::string& tag, const std::vector<std::string>& available,
                 const std::string& sentence) {
  schema.custom(tag,
                [tag, available](S&, const input::Element& element, input::Diagnostics& diagnostics) {
                  const auto given = element.child(tag);
                  if (!given) return;
                  const std::string problem = input::choiceProblem(given->attribute("type").value_or(""), available);
                  if (!problem.empty()) diagnostics.error(*given, "attribute 'type': " + problem);
                },
                {tag}, sentence);
}

}  // namespace tushar::mpm::solid
