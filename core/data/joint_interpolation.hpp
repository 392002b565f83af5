#pragma once

#include <cstddef>
#include <vector>

#include "core/data/label.hpp"
#include "core/grid/box.hpp"

namespace tushar::data {

/// A label and its material; `material` is -1 for variables that do not belong to a material.
struct VariableName {
  const Label* label;
  int material;
};

/// The layout of cell values in memory.
struct CellValues {
  std::byte* values;
  grid::Box stored;
};

/// Cell variables whose values in finer cells must fit one another, such as the density and the momentum of a gas: what
/// follows from them may be impossible, or leave its range, if each is interpolated by itself.
class JointInterpolation {
 public:
  virtual ~JointInterpolation() = default;

  virtual std::vector<VariableName> variables() const = 0;
  /// Corrects the finer cells in the coarse cells `parents`, which were interpolated for each variable by itself.
  /// Values are in the order of `variables`. `coarse` contains the parents and, except beyond sides of the grid, the
  /// cells around them; `fine` contains all finer cells. The mean of those in a parent must remain its value, and the
  /// result in a parent must depend only on the cells around it. Several threads may call it at the same time.
  virtual void correct(const grid::Box& parents, const std::vector<CellValues>& coarse,
                       const std::vector<CellValues>& fine) const = 0;
};

}  // namespace tushar::data
