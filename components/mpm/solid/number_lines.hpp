#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/input/diagnostics.hpp"

namespace tushar::mpm::solid {

/// The numbers in a line of a file, separated by spaces; none if a word is not a number, which is reported.
std::optional<std::vector<double>> numbersInLine(const std::string& line, const Location& where,
                                                 input::Diagnostics& diagnostics);

}  // namespace tushar::mpm::solid
