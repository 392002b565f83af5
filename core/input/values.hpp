#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/vec.hpp"
#include "core/input/expression.hpp"
#include "core/input/parsed.hpp"

namespace tushar::input {

/// Reads text as a T: bool, int, std::int64_t, double, std::string, Vec3, Index3, std::vector of double, int,
/// std::string or Index3, Expression or VectorExpression. Blanks are allowed at the ends and around commas and
/// brackets. Numbers are read in the same way in every locale; infinite and undefined numbers are refused.
template <class T>
Parsed<T> parse(std::string_view text);

template <>
Parsed<bool> parse<bool>(std::string_view text);
template <>
Parsed<int> parse<int>(std::string_view text);
template <>
Parsed<std::int64_t> parse<std::int64_t>(std::string_view text);
template <>
Parsed<double> parse<double>(std::string_view text);
template <>
Parsed<std::string> parse<std::string>(std::string_view text);
template <>
Parsed<Vec3> parse<Vec3>(std::string_view text);
template <>
Parsed<Index3> parse<Index3>(std::string_view text);
template <>
Parsed<std::vector<double>> parse<std::vector<double>>(std::string_view text);
template <>
Parsed<std::vector<int>> parse<std::vector<int>>(std::string_view text);
template <>
Parsed<std::vector<std::string>> parse<std::vector<std::string>>(std::string_view text);
template <>
Parsed<std::vector<Index3>> parse<std::vector<Index3>>(std::string_view text);
template <>
Parsed<Expression> parse<Expression>(std::string_view text);
template <>
Parsed<VectorExpression> parse<VectorExpression>(std::string_view text);

/// The name of type T in the manual.
template <class T>
inline constexpr std::string_view typeName = "value";
template <>
inline constexpr std::string_view typeName<bool> = "true or false";
template <>
inline constexpr std::string_view typeName<int> = "integer";
template <>
inline constexpr std::string_view typeName<std::int64_t> = "integer";
template <>
inline constexpr std::string_view typeName<double> = "number";
template <>
inline constexpr std::string_view typeName<std::string> = "text";
template <>
inline constexpr std::string_view typeName<Vec3> = "numbers [a,b,c]";
template <>
inline constexpr std::string_view typeName<Index3> = "integers [a,b,c]";
template <>
inline constexpr std::string_view typeName<std::vector<double>> = "numbers [a,b,…]";
template <>
inline constexpr std::string_view typeName<std::vector<int>> = "integers [a,b,…]";
template <>
inline constexpr std::string_view typeName<std::vector<std::string>> = "words [a,b,…]";
template <>
inline constexpr std::string_view typeName<std::vector<Index3>> = "integers [[a,b,c],…]";
template <>
inline constexpr std::string_view typeName<Expression> = "formula in x, y, z, t";
template <>
inline constexpr std::string_view typeName<VectorExpression> = "formulas [a,b,c] in x, y, z, t";

/// The shortest text that parse reads back as the same value.
std::string toText(bool value);
std::string toText(int value);
std::string toText(std::int64_t value);
std::string toText(double value);
std::string toText(const char*) = delete;
std::string toText(const std::string& value);
std::string toText(const Vec3& value);
std::string toText(const Index3& value);
std::string toText(const std::vector<double>& value);
std::string toText(const std::vector<int>& value);
std::string toText(const std::vector<std::string>& value);
std::string toText(const std::vector<Index3>& value);
std::string toText(const Expression& value);
std::string toText(const VectorExpression& value);

}  // namespace tushar::input
