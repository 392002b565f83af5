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

/// The cells of a gas in an output of an archive (`t00042.h5`) that contains c.density, c.velocity and c.pressure, or
/// in a file made by tools/coarsen. Internal energy is p / ((gamma-1) rho) of the means. Throws FileError where the
/// file cannot be read or does not hold these.
GasTable readGasTable(const std::filesystem::path& file, double gamma);

/// The cell means of another run, of higher resolution, as the reference of a scene that has no exact solution. Valid
/// at the time of the table and within its box.
class Tabulated : public GasReference {
 public:
  /// Throws std::invalid_argument if the table has no cells, no extent, or a number of means that differs from the
  /// number of cells.
  explicit Tabulated(GasTable table);

  /// Interpolates linearly between the centres of cells, which smears shocks over two of them. Throws std::domain_error
  /// at another time.
  GasState at(const Vec3& x, double t) const override;
  bool holdsAt(double t) const override;
  bool covers(const Vec3& x, double t) const override;
  /// Mean of the cells, each weighted by the part of it that is in the box: exact for boxes made of whole cells.
  /// Throws std::invalid_argument where upper < lower or the box leaves the table.
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
