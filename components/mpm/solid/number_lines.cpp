#include "components/mpm/solid/number_lines.hpp"

#include <fmt/format.h>

#include <sstream>

#include "core/input/values.hpp"

namespace tushar::mpm::solid {

std::optional<std::vector<double>> numbersInLine(const std::string& line, const Location& where,
                                                 input::Diagnostics& diagnostics) {
  std::vector<double> numbers;
  std::istringstream words(line);
  for (std::string word; words >> word;) {
    const auto number = input::parse<double>(word).value;
    if (!number) {
      diagnostics.error(where, {}, fmt::format("found '{}', expected a number", word));
      return {};
    }
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace tushar::mpm::solid
