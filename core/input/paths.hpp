#pragma once

#include <string>
#include <vector>

#include "core/input/element.hpp"

namespace tushar::input {

/// The paths of all values below a tag, as Document::set takes them, in the order of the file: `Time/maxTime`,
/// `Grid/BoundaryConditions/Face[2]/@side`. Tags of the same name beside each other have numbers.
std::vector<std::string> settablePaths(const Element& root);

}  // namespace tushar::input
