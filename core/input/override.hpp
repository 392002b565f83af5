#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/input/diagnostics.hpp"
#include "core/input/node.hpp"

namespace tushar::input {

/// One tag of the path of an override: `Box`, `Box[2]` or `Box[@label='left']`.
struct OverrideStep {
  std::string name;
  int index = 0;          ///< index among siblings of the same name, from 1; 0 if none is given
  std::string attribute;  ///< name of the attribute in brackets; empty if none is given
  std::string value;      ///< value of the attribute in brackets
};

/// An override such as `Grid/Level/Box/resolution=[200,1,1]`, split into its parts.
struct Override {
  std::vector<OverrideStep> steps;
  std::string attribute;  ///< the attribute to set; empty to set the text of the tag
  std::string value;
};

/// Reads `PATH=VALUE`; returns none, with an error in `diagnostics`, if the text has another form.
std::optional<Override> parseOverride(std::string_view text, const Location& where, Diagnostics& diagnostics);

/// Sets the value below `root`, creating missing tags. `where` becomes the location of new tags, and of the tag or
/// attribute that is set.
void apply(const Override& change, Node& root, const Location& where, Diagnostics& diagnostics);

}  // namespace tushar::input
