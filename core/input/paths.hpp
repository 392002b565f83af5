#pragma once

#include <string>
#include <vector>

#include "core/input/element.hpp"

namespace tushar::input {

/// The paths of all values below a tag, in the form that Document::set accepts and in the order of the file, such as
/// `Time/maxTime` and `Grid/BoundaryConditions/Face[2]/@side`. Siblings with the same name are numbered.
std::vector<std::string> settablePaths(const Element& root);

}  // namespace tushar::input
