#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/vec.hpp"
#include "core/input/parsed.hpp"

namespace tushar::input {

/// A formula in the coordinates x, y, z [m] and the time t [s], such as `1e5*(1 + 0.1*sin(2*pi*x))`.
///
/// Supports the operators + - * / ^, comparisons, && ||, `condition ? a : b`, the constants pi and e, and the usual
/// functions (sin, cos, exp, ln, sqrt, abs, min, max, …). A formula without x, y, z and t is evaluated only once, when
/// it is read. Several threads may evaluate a formula at the same time.
class Expression {
 public:
  /// A formula with the constant `value`.
  Expression(double value = 0.0);
  Expression(const Expression& other);
  Expression(Expression&& other) noexcept;
  Expression& operator=(Expression other) noexcept;
  ~Expression();

  /// Reads a formula or a plain number; refuses infinite or undefined constants.
  static Parsed<Expression> parse(std::string_view text);

  double operator()(const Vec3& x, double t = 0) const { return constant_ ? value_ : evaluate(x, t); }
  /// Whether the formula is constant in space and time.
  bool isConstant() const { return constant_; }
  bool dependsOnTime() const { return dependsOnTime_; }
  /// The formula as written in the scene.
  const std::string& text() const { return text_; }
  /// The location of the tag from which the formula was read, or of the option that overrides it.
  const Location& where() const { return where_; }
  void readAt(const Location& where) { where_ = where; }

 private:
  struct Program;
  double evaluate(const Vec3& x, double t) const;

  std::string text_;
  double value_ = 0;
  bool constant_ = true;
  bool dependsOnTime_ = false;
  Location where_;
  std::unique_ptr<Program> program_;  ///< the compiled formula; null for a constant
};

/// Three formulas, `[fx,fy,fz]`.
class VectorExpression {
 public:
  /// A vector with the constant `value`.
  VectorExpression(const Vec3& value = Vec3::Zero());
  explicit VectorExpression(std::array<Expression, 3> components) : components_(std::move(components)) {}

  static Parsed<VectorExpression> parse(std::string_view text);

  Vec3 operator()(const Vec3& x, double t = 0) const {
    return {components_[0](x, t), components_[1](x, t), components_[2](x, t)};
  }
  bool isConstant() const;
  bool dependsOnTime() const;
  /// The component along `axis`: 0, 1 or 2 for x, y or z.
  const Expression& operator[](int axis) const { return components_[axis]; }
  std::string text() const;
  /// The location of the tag from which the formulas were read, or of the option that overrides it.
  const Location& where() const { return components_[0].where(); }
  void readAt(const Location& where);

 private:
  std::array<Expression, 3> components_;
};

}  // namespace tushar::input
