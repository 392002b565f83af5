#pragma once

#include <string>

#include "core/base/error.hpp"
#include "core/base/vec.hpp"
#include "core/data/views.hpp"
#include "core/grid/level.hpp"
#include "core/input/expression.hpp"

namespace tushar::numerics {

/// A formula of the scene whose values are checked when they are used.
struct CheckedFormula {
  const input::Expression& formula;
  std::string path;  ///< path of the formula's tag, such as `Heat/temperature`
  std::string unit;  ///< unit of the values; empty for a dimensionless number

  /// The value at a point [m]. Throws InputError if it is not finite.
  double finiteAt(const Vec3& x) const;
  /// Like finiteAt, but throws InputError unless the value is finite and greater than 0.
  double positiveAt(const Vec3& x) const;
  /// Sets each cell of a patch to the value at its centre. Throws InputError if a value is not finite.
  template <int D>
  void fill(const grid::Patch& patch, data::CellView<double> field) const {
    atMiddles<D>(patch, [&](const Index<D>& cell, const Vec3& x) { field[cell] = finiteAt(x); });
  }
  /// Throws InputError if the value at the centre of any cell is not finite and greater than 0.
  template <int D>
  void requirePositive(const grid::Patch& patch) const {
    atMiddles<D>(patch, [&](const Index<D>&, const Vec3& x) { positiveAt(x); });
  }

 private:
  template <int D, class Visit>
  static void atMiddles(const grid::Patch& patch, Visit&& visit) {
    const grid::Level& level = patch.level();
    grid::forEach<D>(patch.cells(),
                     [&](const Index<D>& cell) { visit(cell, level.expandPoint<D>(level.cellCentre<D>(cell))); });
  }
  [[noreturn]] void refuse(double value, const Vec3& x, const char* wanted) const;
};

}  // namespace tushar::numerics
