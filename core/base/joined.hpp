#pragma once

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>

namespace tushar {

/// Values as text, with a separator between them: `1, 2, 3`. Used instead of fmt::join, whose formatting of numbers
/// would be compiled again in each file.
template <class Values>
std::string joined(const Values& values, std::string_view separator) {
  std::string text;
  for (const auto& value : values) {
    if (&value != &*std::begin(values)) text += separator;
    text += fmt::format("{}", value);
  }
  return text;
}

}  // namespace tushar
