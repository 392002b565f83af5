#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tushar::input {

/// `text` without blanks, tabs and line ends at its ends.
std::string trimmed(std::string_view text);

/// The parts between commas, trimmed; commas within parentheses or brackets do not split. At least one part.
std::vector<std::string> splitAtCommas(std::string_view text);

/// `a, b, c`.
std::string listed(const std::vector<std::string>& words);

}  // namespace tushar::input
