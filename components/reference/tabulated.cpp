#include "components/reference/tabulated.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "components/reference/gas_fields.hpp"
#include "core/base/error.hpp"
#include "core/output/archive_hdf5_input.hpp"

namespace tushar::reference {

namespace {

/// Path of a saved cell field, which belongs to no material or to a single one.
std::string findField(const output::Hdf5Input& file, const std::string& label) {
  if (const std::string plain = "cells/" + label; file.has(plain)) return plain;
  std::vector<std::string> found;
  for (const std::string& group : file.names("cells"))
    if (const std::string path = fmt::format("cells/{}/{}", group, label); file.has(path)) found.push_back(path);
  if (found.size() == 1) return found[0];
  throw FileError(fmt::format("'{}' holds {}", file.path().string(),
                              found.empty() ? "no " + label : "the " + label + " of several materials"));
}

std::vector<double> readField(const output::Hdf5Input& file, const std::string& label, std::size_t numbers) {
  const std::string path = findField(file, label);
  const auto values = file.dataset(path);
  const auto* reals = std::get_if<std::vector<double>>(&values);
  if (!reals || reals->size() != numbers)
    throw FileError(
        fmt::format("'{}': {} does not have the {} values that the grid needs", file.path().string(), path, numbers));
  return *reals;
}

}  // namespace

GasTable readGasTable(const std::filesystem::path& path, double gamma) {
  const output::Hdf5Input file(path);
  if (file.has("grid/boxes"))
    throw FileError(
        fmt::format("'{}' contains boxes of several levels: use tools/coarsen to make a table from it", path.string()));
  GasTable table;
  table.time = file.real("/", "time");
  table.cells = file.index("grid", "cells");
  table.lower = file.vector("grid", "lower");
  table.upper = table.lower;
  const Vec3 spacing = file.vector("grid", "spacing");
  for (int d = 0; d < 3; ++d) table.upper[d] += table.cells[d] * spacing[d];
  const auto count = static_cast<std::size_t>(table.cells[0]) * static_cast<std::size_t>(table.cells[1]) *
                     static_cast<std::size_t>(table.cells[2]);
  const auto density = readField(file, "c.density", count), velocity = readField(file, "c.velocity", 3 * count),
             pressure = readField(file, "c.pressure", count);
  for (std::size_t k = 0; k < count; ++k)
    table.means.push_back({density[k], Vec3(velocity[3 * k], velocity[3 * k + 1], velocity[3 * k + 2]), pressure[k],
                           density[k] > 0 ? pressure[k] / ((gamma - 1) * density[k]) : 0});
  return table;
}

Tabulated::Tabulated(GasTable table) : table_(std::move(table)) {
  std::size_t count = 1;
  for (int d = 0; d < 3; ++d) {
    if (table_.cells[d] < 1 || !(table_.upper[d] > table_.lower[d]))
      throw std::invalid_argument(fmt::format("A table of a gas has no cells along {}.", "xyz"[d]));
    count *= table_.cells[d];
    spacing_[d] = (table_.upper[d] - table_.lower[d]) / table_.cells[d];
  }
  if (count != table_.means.size())
    throw std::invalid_argument(
        fmt::format("A table of {} cells needs as many means, but has {}.", count, table_.means.size()));
}

bool Tabulated::holdsAt(double t) const { return std::abs(t - table_.time) <= 1e-9 * std::max(1.0, table_.time); }

bool Tabulated::covers(const Vec3& x, double t) const {
  for (int d = 0; d < 3; ++d)
    if (table_.cells[d] > 1 && (x[d] < table_.lower[d] || x[d] > table_.upper[d])) return false;
  return holdsAt(t);
}

std::vector<Tabulated::Share> Tabulated::between(int axis, double x) const {
  const int last = table_.cells[axis] - 1;
  const double place = std::clamp((x - table_.lower[axis]) / spacing_[axis] - 0.5, 0.0, static_cast<double>(last));
  const int cell = std::min(static_cast<int>(place), std::max(last - 1, 0));
  if (last == 0) return {{0, 1.0}};
  return {{cell, 1 - (place - cell)}, {cell + 1, place - cell}};
}

/// The cells along an axis that overlap an interval, and the part of the interval in each.
std::vector<Tabulated::Share> Tabulated::overlaps(int axis, double lower, double upper) const {
  if (table_.cells[axis] == 1) return {{0, 1.0}};
  const double from = std::max(0.0, (lower - table_.lower[axis]) / spacing_[axis]);
  const double to = std::min<double>(table_.cells[axis], (upper - table_.lower[axis]) / spacing_[axis]);
  if (upper == lower) return between(axis, lower);
  std::vector<Share> shares;
  for (int cell = static_cast<int>(from); cell < to; ++cell)
    if (const double part = std::min(to, cell + 1.0) - std::max(from, static_cast<double>(cell)); part > 0)
      shares.push_back({cell, part / (to - from)});
  if (shares.empty()) throw std::invalid_argument("There is no mean over a box outside the table.");
  return shares;
}

GasState Tabulated::sum(const std::vector<Share>& x, const std::vector<Share>& y, const std::vector<Share>& z) const {
  Fields total = Fields::Zero();
  for (const Share& k : z)
    for (const Share& j : y)
      for (const Share& i : x) {
        const auto row = static_cast<std::size_t>(k.cell) * static_cast<std::size_t>(table_.cells[1]) + j.cell;
        const auto cell = row * static_cast<std::size_t>(table_.cells[0]) + static_cast<std::size_t>(i.cell);
        total += k.part * j.part * i.part * toFields(table_.means[cell]);
      }
  return toState(total);
}

GasState Tabulated::at(const Vec3& x, double t) const {
  if (!holdsAt(t))
    throw std::domain_error(fmt::format("The table is for t = {:g} s, not for t = {:g} s.", table_.time, t));
  return sum(between(0, x[0]), between(1, x[1]), between(2, x[2]));
}

GasState Tabulated::average(const Vec3& lower, const Vec3& upper, double t) const {
  checkBox(lower, upper);
  if (!holdsAt(t))
    throw std::domain_error(fmt::format("The table is for t = {:g} s, not for t = {:g} s.", table_.time, t));
  return sum(overlaps(0, lower[0], upper[0]), overlaps(1, lower[1], upper[1]), overlaps(2, lower[2], upper[2]));
}

}  // namespace tushar::reference
