#pragma once

#include <filesystem>

#include "components/reference/gas_reference.hpp"
#include "core/base/vec.hpp"

namespace tushar::reference {

/// Cell means of a gas at one time on a uniform grid.
struct GasTable {
  Vec3 lower, upper;  ///< lower corner and upper corner [m]
  /// Number of cells along x, y, z; along an axis with one cell, the gas is uniform without end.
  Index3 cells;
  double time = 0;              ///< time [s]
  std::vector<GasState> means;  ///< cell means, x fastest, z slowest
};

/// Reads the cell means of a gas from an output of an archive (`t00042.h5`) that contains c.density, c.velocity and
/// c.pressure, or from a file made by tools/coarsen. The internal energy is p / ((gamma-1) rho), from these means.
/// Throws FileError if the file cannot be read or does not contain them.
GasTable readGasTable(const std::filesystem::path& file, double gamma);

/// The cell means of another run with higher resolution, as the reference for a scene that has no exact solution. They
/// are valid at the time of the table and within its box.
class Tabulated : public GasReference {
 public:
  /// Throws std::invalid_argument if the table has no cells, no extent, or a number of means that differs from the
  /// number of cells.
  explicit Tabulated(GasTable table);

  /// Interpolates linearly between the centres of cells, which smears a shock over two cells. Throws std::domain_error
  /// at any other time than that of the table.
  GasState at(const Vec3& x, double t) const override;
  bool holdsAt(double t) const override;
  bool covers(const Vec3& x, double t) const override;
  /// Mean of the cells, weighted by the part of each that is in the box; exact for boxes made of whole cells. Throws
  /// std::invalid_argument if upper < lower, or if the box is not within the table.
  GasState average(const Vec3& lower, const Vec3& upper, double t) const override;

 private:
  /// Cells along an axis, and their weights in a sum.
  struct Share {
    int cell;
    double part;
  };
  std::vector<Share> between(int axis, double x) const;
  std::vector<Share> overlaps(int axis, double lower, double upper) const;
  GasState sum(const std::vector<Share>& x, const std::vector<Share>& y, const std::vector<Share>& z) const;

  GasTable table_;
  Vec3 spacing_;  ///< spacing [m]
};

}  // namespace tushar::reference
