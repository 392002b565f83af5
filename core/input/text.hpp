#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tushar::input {

/// `text` without leading and trailing blanks, tabs and line ends.
std::string trimmed(std::string_view text);

/// The parts between commas, trimmed; commas within parentheses or brackets do not split. There is always at least one
/// part.
std::vector<std::string> splitAtCommas(std::string_view text);

/// Joins words by commas: `a, b, c`.
std::string listed(const std::vector<std::string>& words);

}  // namespace tushar::input
