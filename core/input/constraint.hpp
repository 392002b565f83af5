#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/vec.hpp"
#include "core/input/expression.hpp"

namespace tushar::input {

/// A condition on a number, and its wording.
struct Constraint {
  std::function<bool(double)> holds;
  std::string allowed;  ///< the condition in words: `greater than 0`, `at least 1`, `from 0 to 1`
};

Constraint greaterThan(double limit);
Constraint lessThan(double limit);
Constraint atLeast(double limit);
Constraint atMost(double limit);
/// Restricts a number to a range, both ends included.
Constraint between(double least, double most);
inline Constraint positive() { return greaterThan(0); }
inline Constraint nonNegative() { return atLeast(0); }

/// A constraint on formulas that are evaluated at the start of a run: they must not depend on time.
struct WithoutTime {
  std::string allowed = "without t";
};

/// Vectors and lists satisfy a constraint if all components do; formulas that are not constant always do.
bool satisfies(double value, const Constraint& constraint);
bool satisfies(const Vec3& value, const Constraint& constraint);
bool satisfies(const Index3& value, const Constraint& constraint);
bool satisfies(const std::vector<double>& value, const Constraint& constraint);
bool satisfies(const std::vector<int>& value, const Constraint& constraint);
bool satisfies(const std::vector<Index3>& value, const Constraint& constraint);
bool satisfies(const Expression& value, const Constraint& constraint);
bool satisfies(const VectorExpression& value, const Constraint& constraint);
inline bool satisfies(const Expression& value, const WithoutTime&) { return !value.dependsOnTime(); }
inline bool satisfies(const VectorExpression& value, const WithoutTime&) { return !value.dependsOnTime(); }

/// Returns a message such as `found '-1', expected a value greater than 0 m`; the unit "1" is omitted.
std::string violation(const std::string& found, const Constraint& constraint, const std::string& unit);
std::string violation(const std::string& found, const WithoutTime& constraint, const std::string& unit);

}  // namespace tushar::input
