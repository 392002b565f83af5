#include "core/collect/summary.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "core/base/merge.hpp"
#include "core/collect/sources.hpp"
#include "core/data/reduction.hpp"

namespace tushar::collect {

using data::Centring;
using data::Label;
using grid::Box;
using grid::Patch;

namespace {

/// The extremes and the sum of one component, on one plane or over the whole grid.
struct Extremes {
  double least = std::numeric_limits<double>::infinity(), greatest = -std::numeric_limits<double>::infinity();
  data::Sum sum;

  void add(double value, double weight) {
    least = value < least || std::isnan(value) ? value : least;
    greatest = value > greatest || std::isnan(value) ? value : greatest;
    sum.add(weight * value);
  }
  void merge(const Extremes& other) {
    least = other.least < least || std::isnan(other.least) ? other.least : least;
    greatest = other.greatest > greatest || std::isnan(other.greatest) ? other.greatest : greatest;
    sum.merge(other.sum);
  }
};

/// The cells or nodes that a patch counts: nodes on a face between two patches belong to the upper patch.
Box countedBy(const Patch& patch, const Label& label) {
  if (label.centring != Centring::node) return patch.cells();
  Box nodes = patch.cells().nodes(patch.level().dimension());
  for (int d = 0; d < patch.level().dimension(); ++d)
    if (!patch.isAtBoundary(d, 1)) --nodes.upper[d];
  return nodes;
}

double numberAt(const Label& label, const std::byte* values, std::size_t place) {
  if (label.number == data::Number::integer) return reinterpret_cast<const int*>(values)[place];
  return reinterpret_cast<const double*>(values)[place];
}

void addPatch(const Patch& patch, const Label& label, const data::Variable& variable, SummaryOver over,
              std::vector<Extremes>& extremes) {
  const std::size_t components = label.components;
  const double weight = patch.level().weight();
  grid::forEach<3>(countedBy(patch, label), [&](const Index3& at) {
    const std::size_t plane = over.axis < 0 ? 0 : static_cast<std::size_t>(at[over.axis] >> patch.level().number());
    const std::size_t place = variable.stored.offset(at);
    for (std::size_t k = 0; k < components; ++k)
      extremes[plane * components + k].add(numberAt(label, variable.values, place * components + k), weight);
  });
}

output::Array arrayOf(const Label& label, const grid::Level& level, const std::vector<double>& numbers) {
  const EntryForm form(label, level);
  const bool isWidened = label.isVector && label.components < 3;
  output::Array array{std::string(label.name),
                      std::string(label.unit),
                      std::string(label.description),
                      isWidened ? 3 : label.components,
                      {}};
  if (!isWidened) {
    array.values = numbers;
    return array;
  }
  const std::size_t entries = numbers.size() / static_cast<std::size_t>(label.components);
  std::vector<double> wide(3 * entries);
  form.copy(reinterpret_cast<const std::byte*>(numbers.data()), entries, reinterpret_cast<std::byte*>(wide.data()));
  array.values = std::move(wide);
  return array;
}

}  // namespace

Summary summaryOf(data::Warehouse& warehouse, data::Generation generation, int number, SummaryOver over) {
  const Label& label = *warehouse.table()[number].label;
  const grid::Grid& grid = warehouse.grid();
  const bool isGridded = label.centring == Centring::cell || label.centring == Centring::node;
  if (!isGridded || !warehouse.isHeld(generation, number)) return {};
  const Box all = label.centring == Centring::node ? grid.level().nodesOfCells() : grid.level().cells();
  const int planes = over.axis < 0 ? 1 : all.extent(over.axis);
  std::vector<Extremes> extremes(static_cast<std::size_t>(planes) * static_cast<std::size_t>(label.components));
  for (const Patch& patch : grid.patches())
    addPatch(patch, label, warehouse.variable(generation, number, patch.id()), over, extremes);
  warehouse.ranks().merge(std::as_writable_bytes(std::span(extremes)), [&](const std::byte* from, std::byte* into) {
    for (std::size_t k = 0; k < extremes.size(); ++k)
      mergeInMemory<Extremes>(from + k * sizeof(Extremes), into + k * sizeof(Extremes));
  });
  if (!warehouse.ranks().isFirst()) return {};
  std::vector<double> least, greatest, sum;
  for (const Extremes& one : extremes) {
    least.push_back(one.least);
    greatest.push_back(one.greatest);
    sum.push_back(one.sum.total());
  }
  const auto array = [&](const std::vector<double>& numbers) { return arrayOf(label, grid.level(), numbers); };
  return {array(least), array(greatest), array(sum)};
}

}  // namespace tushar::collect
