#include "core/input/constraint.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tushar::input {

Constraint greaterThan(double limit) {
  return {[limit](double value) { return value > limit; }, fmt::format("greater than {}", limit)};
}

Constraint lessThan(double limit) {
  return {[limit](double value) { return value < limit; }, fmt::format("less than {}", limit)};
}

Constraint atLeast(double limit) {
  return {[limit](double value) { return value >= limit; }, fmt::format("at least {}", limit)};
}

Constraint atMost(double limit) {
  return {[limit](double value) { return value <= limit; }, fmt::format("at most {}", limit)};
}

Constraint between(double least, double most) {
  return {[=](double value) { return least <= value && value <= most; },
          least == most ? fmt::format("{} only", most) : fmt::format("from {} to {}", least, most)};
}

bool satisfies(double value, const Constraint& constraint) { return constraint.holds(value); }

bool satisfies(const Vec3& value, const Constraint& constraint) {
  return constraint.holds(value[0]) && constraint.holds(value[1]) && constraint.holds(value[2]);
}

bool satisfies(const Index3& value, const Constraint& constraint) {
  return std::all_of(value.at.begin(), value.at.end(), constraint.holds);
}

bool satisfies(const std::vector<double>& value, const Constraint& constraint) {
  return std::all_of(value.begin(), value.end(), constraint.holds);
}

bool satisfies(const std::vector<int>& value, const Constraint& constraint) {
  return std::all_of(value.begin(), value.end(), constraint.holds);
}

bool satisfies(const std::vector<Index3>& value, const Constraint& constraint) {
  return std::all_of(value.begin(), value.end(), [&](const Index3& one) { return satisfies(one, constraint); });
}

bool satisfies(const Expression& value, const Constraint& constraint) {
  return !value.isConstant() || constraint.holds(value(Vec3::Zero()));
}

bool satisfies(const VectorExpression& value, const Constraint& constraint) {
  return satisfies(value[0], constraint) && satisfies(value[1], constraint) && satisfies(value[2], constraint);
}

std::string violation(const std::string& found, const Constraint& constraint, const std::string& unit) {
  const bool hasUnit = !unit.empty() && unit != "1";
  const bool isNoun = constraint.allowed.starts_with("at ") || constraint.allowed.ends_with(" only");
  return fmt::format("found '{}', expected a value {}{}{}", found, isNoun ? "of " : "", constraint.allowed,
                     hasUnit ? " " + unit : "");
}

std::string violation(const std::string& found, const WithoutTime&, const std::string&) {
  return fmt::format("found '{}', expected a formula without t: it is evaluated only at the start", found);
}

}  // namespace tushar::input
