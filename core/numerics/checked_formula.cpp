#include "core/numerics/checked_formula.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tushar::numerics {

double CheckedFormula::finiteAt(const Vec3& x) const {
  const double value = formula(x);
  if (!std::isfinite(value)) refuse(value, x, "finite");
  return value;
}

double CheckedFormula::positiveAt(const Vec3& x) const {
  const double value = formula(x);
  if (!(value > 0 && std::isfinite(value))) refuse(value, x, "finite and greater than 0");
  return value;
}

void CheckedFormula::refuse(double value, const Vec3& x, const char* wanted) const {
  throw InputError({{formula.where(), path,
                     fmt::format("it is {:g}{}{} at ({:g}, {:g}, {:g}), but must be {} everywhere", value,
                                 unit.empty() ? "" : " ", unit, x[0], x[1], x[2], wanted)}});
}

}  // namespace tushar::numerics
