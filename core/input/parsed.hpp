#pragma once

#include <optional>
#include <string>
#include <utility>

namespace tushar::input {

/// The result of parsing a text: a value, or a sentence that says why the text is invalid.
template <class T>
struct Parsed {
  std::optional<T> value;
  std::string problem;  ///< the sentence; empty if and only if there is a value

  explicit operator bool() const { return value.has_value(); }
  const T& operator*() const { return *value; }

  static Parsed ok(T value) { return {std::move(value), {}}; }
  static Parsed wrong(std::string sentence) { return {std::nullopt, std::move(sentence)}; }
};

}  // namespace tushar::input
