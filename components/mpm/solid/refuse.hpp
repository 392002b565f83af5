#pragma once

#include <string>

#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// A switch of Uintah's that only stands at `false` here; `instead` says what there is.
template <class S>
void refuseSwitch(input::Schema<S>& schema, const std::string& tag, const std::string& instead) {
  schema.custom(tag,
                [tag, instead](S&, const input::Element& element, input::Diagnostics& diagnostics) {
                  const auto given = element.child(tag);
                  if (given && given->text() != "false")
                    diagnostics.error(*given, "is not available; " + instead);
                },
                {tag}, "only false: " + instead);
}

}  // namespace tushar::mpm::solid
