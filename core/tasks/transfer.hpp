#pragma once

#include "core/data/warehouse.hpp"

namespace tushar::tasks {

using data::CellValues;

/// Computes the values of coarse cells from those of the finer cells in them: the mean, in pairs along x, then y, then
/// z; for integers, the value of the first finer cell. `coarse` contains at least the cells in `box`.
void restrictTo(const data::Label& label, int dimension, const grid::Box& box, const CellValues& fine,
                const CellValues& coarse);

/// Computes the fine cells in `box` from coarser cells: U + sum_d ± s_d / 4 with monotonised central slopes s, for each
/// component separately; the slope along an axis is 0 if `coarse` lacks a neighbour on this axis. So the mean of the
/// fine cells in a coarse cell equals its value. Integers are copied. Source: B. van Leer, J. Comput. Phys. 23 (1977)
/// 276.
void prolong(const data::Label& label, int dimension, const CellValues& coarse, const grid::Box& box,
             const CellValues& fine);

/// Computes the fine cells in `box`, and the others in the same coarse cells, for variables that are interpolated
/// together, in their order. The memory is that of the calling thread until its next call.
const std::vector<CellValues>& prolongTogether(const data::VariableTable::Joint& joint, int dimension,
                                               const std::vector<CellValues>& coarse, const grid::Box& box);

}  // namespace tushar::tasks
