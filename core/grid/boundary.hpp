#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/base/vec.hpp"

namespace tushar::grid {

/// How a condition treats its variable at a side of the grid: reflected in the side as in a plane of symmetry, with a
/// given value, or with a given outward derivative.
enum class BoundaryKind { symmetry, dirichlet, neumann };

/// The `var` attributes of a `BCType`, in the order of BoundaryKind.
inline constexpr std::array<std::string_view, 3> boundaryKindNames{"symmetry", "Dirichlet", "Neumann"};
constexpr std::string_view nameOf(BoundaryKind kind) { return boundaryKindNames[static_cast<std::size_t>(kind)]; }

/// A variable for which a scene may give conditions, of any type. Two with the same name are the same variable.
struct BoundaryVariable {
  std::string_view name;  ///< the `label` attribute of a `BCType`
  bool isVector = false;  ///< whether its value is one
  bool isEven = false;    ///< may be given on a plane of symmetry; a vector where it lies in the plane

  /// The same variable, which may also be given on a plane of symmetry.
  constexpr BoundaryVariable evenOnPlanes() const { return {name, isVector, true}; }
  friend constexpr bool operator==(const BoundaryVariable& a, const BoundaryVariable& b) { return a.name == b.name; }
};

/// A variable with conditions whose values are of type T: a number or a Vec3 along x, y and z.
template <class T>
struct BoundaryLabel : BoundaryVariable {
  static_assert(std::is_same_v<T, double> || std::is_same_v<T, Vec3>, "a condition gives a number or a Vec3");
  constexpr explicit BoundaryLabel(std::string_view called) : BoundaryVariable{called, std::is_same_v<T, Vec3>} {}
};

/// Not a variable but the whole state, mirrored in a plane of symmetry.
inline constexpr BoundaryVariable symmetric{"Symmetric"};

/// One `BCType` of a `Face`: the condition for a variable at a side of the domain.
struct BoundaryCondition {
  BoundaryVariable variable;
  BoundaryKind kind;
  Vec3 value = Vec3::Zero();  ///< a number stands in the first component; the unit is the variable's
  int material = -1;          ///< the number of the one that it holds for; -1: all
};

/// A condition as a kernel reads it.
template <class T>
struct BoundaryValue {
  BoundaryKind kind;
  T value;  ///< the unit is the variable's, per metre for Neumann

  bool isDirichlet() const { return kind == BoundaryKind::dirichlet; }
  /// Takes a condition as the scene gives it.
  static BoundaryValue of(const BoundaryCondition& condition) {
    if constexpr (std::is_same_v<T, double>)
      return {condition.kind, condition.value[0]};
    else
      return {condition.kind, condition.value};
  }
};

/// The conditions for one variable at both sides of each kernel axis, looked up once: see Level::sides.
template <class T>
class BoundarySides {
 public:
  std::optional<BoundaryValue<T>>& operator()(int kernelAxis, int side) {
    return values_[static_cast<std::size_t>(2 * kernelAxis + side)];
  }
  const std::optional<BoundaryValue<T>>& operator()(int kernelAxis, int side) const {
    return values_[static_cast<std::size_t>(2 * kernelAxis + side)];
  }

 private:
  std::array<std::optional<BoundaryValue<T>>, 6> values_;
};

/// The conditions of the six faces x-, x+, y-, y+, z-, z+ in this order. A face with none is free.
struct BoundaryConditions {
  std::array<std::vector<BoundaryCondition>, 6> faces;

  std::vector<BoundaryCondition>& face(int axis, int side) { return faces[2 * axis + side]; }
  const std::vector<BoundaryCondition>& face(int axis, int side) const { return faces[2 * axis + side]; }
};

}  // namespace tushar::grid
