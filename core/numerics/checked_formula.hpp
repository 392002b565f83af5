#pragma once

#include <string>

#include "core/base/error.hpp"
#include "core/base/vec.hpp"
#include "core/input/expression.hpp"

namespace tushar::numerics {

/// A formula of the scene whose values are checked where they are needed.
struct CheckedFormula {
  const input::Expression& formula;
  Location where;    ///< its section in the scene
  std::string path;  ///< such as `Heat/temperature`
  std::string unit;  ///< empty without dimension

  /// The value at a point [m]. Throws InputError where it is not finite.
  double finiteAt(const Vec3& x) const;
  /// Throws InputError where the value is not finite and greater than 0.
  double positiveAt(const Vec3& x) const;

 private:
  [[noreturn]] void refuse(double value, const Vec3& x, const char* wanted) const;
};

}  // namespace tushar::numerics
