#include "core/input/values.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

#include "core/base/joined.hpp"
#include "core/input/text.hpp"

namespace tushar::input {

namespace {

std::string found(std::string_view text) { return text.empty() ? "found nothing" : fmt::format("found '{}'", text); }

std::string expected(std::string_view text, std::string_view what) {
  return fmt::format("{}, expected {}", found(text), what);
}

/// The text without a leading '+', which std::from_chars does not accept.
std::string_view withoutPlus(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return plus ? text.substr(1) : text;
}

/// The text without a decimal point that is followed only by zeros, so that `2.0` is read as an integer, too.
std::string_view withoutPoint(std::string_view text) {
  const auto point = text.find('.');
  const bool isWhole =
      point != std::string_view::npos && point > 0 && text.find_first_not_of('0', point + 1) == text.npos;
  return isWhole ? text.substr(0, point) : text;
}

template <class T>
Parsed<T> parseInteger(std::string_view given) {
  const std::string text = trimmed(given);
  const std::string_view digits = withoutPoint(withoutPlus(text));
  T value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool whole = end == digits.data() + digits.size();
  if (error == std::errc() && whole) return Parsed<T>::ok(value);
  if (error != std::errc::result_out_of_range || !whole) return Parsed<T>::wrong(expected(text, "an integer"));
  using Limits = std::numeric_limits<T>;
  return Parsed<T>::wrong(text[0] == '-'
                              ? fmt::format("found '{}', which is below the smallest integer, {}", text, Limits::min())
                              : fmt::format("found '{}', which is above the largest integer, {}", text, Limits::max()));
}

/// The parts of `[a,b,c]`; an error if the brackets are missing. `what` describes the expected value.
Parsed<std::vector<std::string>> parts(const std::string& text, std::string_view what) {
  if (text.size() < 2 || text.front() != '[' || text.back() != ']') {
    return Parsed<std::vector<std::string>>::wrong(expected(text, what));
  }
  const std::string inside = trimmed(std::string_view(text).substr(1, text.size() - 2));
  if (inside.empty()) return Parsed<std::vector<std::string>>::ok({});
  return Parsed<std::vector<std::string>>::ok(splitAtCommas(inside));
}

/// As in Uintah, a number without brackets is a list with one entry.
template <class T>
Parsed<std::vector<T>> parseList(std::string_view given, std::string_view what) {
  const std::string text = trimmed(given);
  if constexpr (std::is_arithmetic_v<T>)
    if (const Parsed<T> single = parse<T>(text)) return Parsed<std::vector<T>>::ok({*single});
  const auto pieces = parts(text, what);
  if (!pieces) return Parsed<std::vector<T>>::wrong(pieces.problem);
  std::vector<T> values;
  for (const std::string& piece : *pieces) {
    Parsed<T> value = parse<T>(piece);
    if (!value) return Parsed<std::vector<T>>::wrong(fmt::format("in '{}': {}", text, value.problem));
    values.push_back(*std::move(value.value));
  }
  return Parsed<std::vector<T>>::ok(std::move(values));
}

template <class Triple, class T>
Parsed<Triple> parseTriple(std::string_view text, std::string_view what) {
  const auto values = parseList<T>(text, what);
  if (!values) return Parsed<Triple>::wrong(values.problem);
  if ((*values).size() != 3) return Parsed<Triple>::wrong(expected(trimmed(text), what));
  Triple triple;
  for (int d = 0; d < 3; ++d) triple[d] = (*values)[d];
  return Parsed<Triple>::ok(triple);
}

}  // namespace

template <>
Parsed<bool> parse<bool>(std::string_view given) {
  const std::string text = trimmed(given);
  if (text == "true") return Parsed<bool>::ok(true);
  if (text == "false") return Parsed<bool>::ok(false);
  return Parsed<bool>::wrong(expected(text, "true or false"));
}

template <>
Parsed<int> parse<int>(std::string_view text) {
  return parseInteger<int>(text);
}

template <>
Parsed<std::int64_t> parse<std::int64_t>(std::string_view text) {
  return parseInteger<std::int64_t>(text);
}

template <>
Parsed<double> parse<double>(std::string_view given) {
  const std::string text = trimmed(given);
  const std::string_view digits = withoutPlus(text);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool whole = end == digits.data() + digits.size();
  if (error == std::errc::result_out_of_range && whole) {
    return Parsed<double>::wrong(found(text) + ", which is outside the range of a double");
  }
  if (error != std::errc() || !whole) return Parsed<double>::wrong(expected(text, "a number"));
  if (!std::isfinite(value)) return Parsed<double>::wrong(expected(text, "a finite number"));
  return Parsed<double>::ok(value);
}

template <>
Parsed<std::string> parse<std::string>(std::string_view given) {
  std::string text = trimmed(given);
  if (text.empty()) return Parsed<std::string>::wrong("found nothing, expected text");
  return Parsed<std::string>::ok(std::move(text));
}

template <>
Parsed<Vec3> parse<Vec3>(std::string_view text) {
  return parseTriple<Vec3, double>(text, "three numbers, such as [1,2,3]");
}

template <>
Parsed<Index3> parse<Index3>(std::string_view text) {
  return parseTriple<Index3, int>(text, "three integers, such as [1,2,3]");
}

template <>
Parsed<std::vector<double>> parse<std::vector<double>>(std::string_view text) {
  return parseList<double>(text, "numbers, as [1,2,3]");
}

template <>
Parsed<std::vector<int>> parse<std::vector<int>>(std::string_view text) {
  return parseList<int>(text, "integers, as [1,2,3]");
}

template <>
Parsed<std::vector<std::string>> parse<std::vector<std::string>>(std::string_view text) {
  return parseList<std::string>(text, "words, as [a,b,c]");
}

/// A triple without outer brackets is a list with one entry.
template <>
Parsed<std::vector<Index3>> parse<std::vector<Index3>>(std::string_view given) {
  const std::string text = trimmed(given);
  const auto pieces = parts(text, "lists of three integers, such as [[1,2,3]]");
  if (!pieces) return Parsed<std::vector<Index3>>::wrong(pieces.problem);
  if ((*pieces).empty())
    return Parsed<std::vector<Index3>>::wrong(expected(text, "lists of three integers, such as [[1,2,3]]"));
  const bool isOne = !(*pieces).front().starts_with('[');
  std::vector<Index3> triples;
  for (const std::string& piece : isOne ? std::vector{text} : *pieces) {
    const Parsed<Index3> triple = parse<Index3>(piece);
    if (!triple) return Parsed<std::vector<Index3>>::wrong(fmt::format("in '{}': {}", text, triple.problem));
    triples.push_back(*triple);
  }
  return Parsed<std::vector<Index3>>::ok(std::move(triples));
}

template <>
Parsed<Expression> parse<Expression>(std::string_view text) {
  return Expression::parse(text);
}

template <>
Parsed<VectorExpression> parse<VectorExpression>(std::string_view text) {
  return VectorExpression::parse(text);
}

std::string toText(bool value) { return value ? "true" : "false"; }
std::string toText(int value) { return fmt::to_string(value); }
std::string toText(std::int64_t value) { return fmt::to_string(value); }
std::string toText(double value) { return fmt::format("{}", value); }
std::string toText(const std::string& value) { return value; }
std::string toText(const Vec3& value) { return fmt::format("[{},{},{}]", value[0], value[1], value[2]); }
std::string toText(const Index3& value) { return fmt::format("[{}]", joined(value.at, ",")); }
std::string toText(const std::vector<double>& value) { return fmt::format("[{}]", joined(value, ",")); }
std::string toText(const std::vector<int>& value) { return fmt::format("[{}]", joined(value, ",")); }
std::string toText(const std::vector<std::string>& value) { return fmt::format("[{}]", joined(value, ",")); }
std::string toText(const std::vector<Index3>& value) {
  std::string text;
  for (const Index3& triple : value) text += (text.empty() ? "" : ",") + toText(triple);
  return "[" + text + "]";
}
std::string toText(const Expression& value) { return value.text(); }
std::string toText(const VectorExpression& value) { return value.text(); }

}  // namespace tushar::input
