#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/base/vec.hpp"
#include "core/grid/side_part.hpp"
#include "core/input/expression.hpp"

namespace tushar::grid {

/// The kind of a condition at a side of the grid: reflection, as at a symmetry plane; a given value; or a given outward
/// derivative.
enum class BoundaryKind { symmetry, dirichlet, neumann };

/// The `var` attributes of a `BCType`, in the order of BoundaryKind.
inline constexpr std::array<std::string_view, 3> boundaryKindNames{"symmetry", "Dirichlet", "Neumann"};
constexpr std::string_view nameOf(BoundaryKind kind) { return boundaryKindNames[static_cast<std::size_t>(kind)]; }

/// A variable of any type for which a scene may give conditions. Variables with the same name are the same variable.
struct BoundaryVariable {
  std::string_view name;  ///< the `label` attribute of a `BCType`
  bool isVector = false;  ///< whether its value is a vector
  /// Whether a condition is also allowed on a symmetry plane; for a vector, if the vector is parallel to the plane.
  bool isEven = false;

  /// The same variable, but conditions for it are also allowed on symmetry planes.
  constexpr BoundaryVariable evenOnPlanes() const { return {name, isVector, true}; }
  friend constexpr bool operator==(const BoundaryVariable& a, const BoundaryVariable& b) { return a.name == b.name; }
};

/// A variable with conditions whose values are of type T: a number or a Vec3 along x, y and z.
template <class T>
struct BoundaryLabel : BoundaryVariable {
  static_assert(std::is_same_v<T, double> || std::is_same_v<T, Vec3>,
                "the value of a condition must be a number or a Vec3");
  constexpr explicit BoundaryLabel(std::string_view called) : BoundaryVariable{called, std::is_same_v<T, Vec3>} {}
};

/// Stands for the whole state, which a symmetry plane mirrors, not for a single variable.
inline constexpr BoundaryVariable symmetric{"Symmetric"};

/// One `BCType` of a `Face`: the condition for a variable at a side of the domain.
struct BoundaryCondition {
  BoundaryVariable variable;
  BoundaryKind kind;
  Vec3 value = Vec3::Zero();  ///< the value, in the unit of the variable; a scalar is in the first component
  int material = -1;          ///< index of the material to which it applies; -1: all
  /// Formulas instead of the value, for components that support them; a scalar is in the first component.
  std::shared_ptr<const input::VectorExpression> formula = {};

  /// Whether the condition applies to a material.
  bool isOf(int number) const { return material < 0 || material == number; }
};

/// A condition, in the form for kernels.
template <class T>
struct BoundaryValue {
  BoundaryKind kind;
  /// The value, in the unit of the variable; per metre for Neumann conditions.
  T value;
  const input::VectorExpression* formula = nullptr;  ///< the formula that replaces the value, or null

  bool isDirichlet() const { return kind == BoundaryKind::dirichlet; }
  /// The value at a position [m] and a time [s].
  T at(const Vec3& x, double time) const { return formula ? of((*formula)(x, time)) : value; }
  /// Converts a condition of a scene.
  static BoundaryValue of(const BoundaryCondition& condition) {
    return {condition.kind, of(condition.value), condition.formula.get()};
  }

 private:
  static T of(const Vec3& given) {
    if constexpr (std::is_same_v<T, double>)
      return given[0];
    else
      return given;
  }
};

/// A part of a side with its own conditions.
struct ConditionsOfPart {
  SidePart shape;
  std::vector<BoundaryCondition> conditions;
};

/// The part index that stands for the rest of a side, outside all its parts.
inline constexpr int restOfSide = -1;

/// The conditions at the faces x-, x+, y-, y+, z-, z+, in this order. A face without conditions is open.
///
/// Parts of a side may have their own conditions. On a part, these replace the conditions of the whole side for the
/// materials that they concern. On a part without any conditions, the conditions of the whole side apply to no
/// material.
struct BoundaryConditions {
  std::array<std::vector<BoundaryCondition>, 6> faces;
  std::array<std::vector<ConditionsOfPart>, 6> parts;

  std::vector<BoundaryCondition>& face(int axis, int side) { return faces[2 * axis + side]; }
  const std::vector<BoundaryCondition>& face(int axis, int side) const { return faces[2 * axis + side]; }
};

}  // namespace tushar::grid
