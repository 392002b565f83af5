#include "core/tasks/exchange.hpp"

#include <cstring>

namespace tushar::tasks {

using data::Generation;
using data::ParticleSet;
using data::Variable;
using data::Warehouse;
using grid::Box;
using grid::Patch;

namespace {

/// Copies to a box, row by row, the values of the box `shift` cells before it.
void copyBox(const Variable& from, Variable& to, const Box& box, const Index3& shift, std::size_t bytes) {
  if (box.empty()) return;
  Box rows = box;
  rows.upper[0] = rows.lower[0] + 1;
  const std::size_t length = static_cast<std::size_t>(box.extent(0)) * bytes;
  grid::forEach<3>(rows, [&](const Index3& at) {
    std::memcpy(to.values.data() + to.stored.offset(at) * bytes, from.values.data() + from.stored.offset(at - shift) * bytes,
                length);
  });
}

/// The parts of `box` outside `hole`: below and above it, axis by axis.
template <class Visit>
void forEachPartOutside(Box box, const Box& hole, Visit&& visit) {
  for (int d = 2; d >= 0; --d) {
    Box below = box, above = box;
    below.upper[d] = std::min(box.upper[d], hole.lower[d]);
    above.lower[d] = std::max(box.lower[d], hole.upper[d]);
    if (!below.empty()) visit(below);
    if (!above.empty()) visit(above);
    box.lower[d] = std::max(box.lower[d], hole.lower[d]);
    box.upper[d] = std::min(box.upper[d], hole.upper[d]);
  }
}

/// Calls `visit(patch, shift)` for each patch and each of its images that holds cells of a box.
template <class Visit>
void forEachSource(const grid::Level& level, const Box& cells, Visit&& visit) {
  for (const Index3& shift : level.imagesOverlapping(cells))
    for (const Patch* patch : level.patchesOverlapping(cells.shifted(Index3{} - shift))) visit(*patch, shift);
}

void fillPatch(Warehouse& warehouse, int number, Generation generation, const Patch& patch) {
  const data::VariableName& name = warehouse.table()[number];
  const bool nodes = name.label->centring == data::Centring::node;
  const int width = warehouse.table().ghost(number);
  Variable& here = warehouse.variable(generation, number, patch.id());
  const Box own = nodes ? patch.nodes() : patch.cells();
  // The last node of a periodic axis is the image of the first, with other rounding: a node of the grid is never taken
  // from an image, whatever the patches.
  const Box grid = nodes ? warehouse.level().nodes() : warehouse.level().cells();
  forEachSource(warehouse.level(), patch.cellsWithin(width + (nodes ? 1 : 0)), [&](const Patch& other, const Index3& shift) {
    if (&other == &patch && shift == Index3{}) return;
    const Variable& there = warehouse.variable(generation, number, other.id());
    const Box theirs = (nodes ? other.nodes() : other.cells()).shifted(shift).intersect(here.stored);
    if (theirs.empty()) return;
    forEachPartOutside(theirs, own, [&](const Box& part) {
      if (shift == Index3{}) return copyBox(there, here, part, shift, name.label->bytes);
      forEachPartOutside(part, grid, [&](const Box& beyond) { copyBox(there, here, beyond, shift, name.label->bytes); });
    });
  });
}

/// Appends the particles of the cells around the patch to its set.
void addGhosts(Warehouse& warehouse, Generation generation, int material, const Patch& patch) {
  ParticleSet& set = warehouse.particles(generation, material, patch.id());
  const grid::Level& level = warehouse.level();
  forEachPartOutside(set.cells(), set.ownedCells(), [&](const Box& part) {
    forEachSource(level, part, [&](const Patch& other, const Index3& shift) {
      const ParticleSet& theirs = warehouse.particles(generation, material, other.id());
      grid::forEach<3>(part.intersect(other.cells().shifted(shift)), [&](const Index3& cell) {
        set.addGhostCell(cell, other.id(), theirs.in(cell - shift), shift);
      });
    });
  });
  set.markGhosts();
}

/// Moves positions to the image where they are ghosts.
void shiftPositions(const grid::Level& level, const Index3& shift, double* x, int count) {
  const int dimension = level.dimension();
  for (int d = 0; d < dimension; ++d) {
    const double by = shift[d] / level.cells().upper[d] * level.period(d);
    for (int k = 0; by != 0 && k < count; ++k) x[k * dimension + d] += by;
  }
}

/// Gives the particle set of a patch its ghosts, and makes room for their values.
void makeRoom(Warehouse& warehouse, const NumberedFill& fill, const Patch& patch) {
  const auto [label, material] = warehouse.table()[fill.variable];
  const ParticleSet& set = warehouse.particles(fill.set, material, patch.id());
  if (!set.hasGhosts()) addGhosts(warehouse, fill.set, material, patch);
  Variable& here = warehouse.variable(fill.generation, fill.variable, patch.id());
  warehouse.allocateParticles(here, *label, set.total(), set.owned());
}

void fillParticles(Warehouse& warehouse, const NumberedFill& fill, const Patch& patch) {
  const auto [label, material] = warehouse.table()[fill.variable];
  const ParticleSet& set = warehouse.particles(fill.set, material, patch.id());
  Variable& here = warehouse.variable(fill.generation, fill.variable, patch.id());
  std::byte* to = here.values.data() + static_cast<std::size_t>(set.owned()) * label->bytes;
  for (const data::GhostRun& run : set.ghostRuns()) {
    const Variable& there = warehouse.variable(fill.generation, fill.variable, run.patch);
    const std::size_t length = static_cast<std::size_t>(run.count) * label->bytes;
    std::memcpy(to, there.values.data() + static_cast<std::size_t>(run.first) * label->bytes, length);
    if (label->name == data::positionName && !(run.shift == Index3{}))
      shiftPositions(warehouse.level(), run.shift, reinterpret_cast<double*>(to), run.count);
    to += length;
  }
}

}  // namespace

void fillGhosts(Warehouse& warehouse, const std::vector<NumberedFill>& fills, Threads& threads) {
  if (warehouse.patches() == 1 && !warehouse.level().isPeriodic()) return;
  const std::vector<Patch>& patches = warehouse.level().patches();
  const auto forEachPatch = [&](const auto& work) {
    const auto workOn = [&](int k) {
      const Patch& patch = patches[static_cast<std::size_t>(k)];
      const trace::Span span(trace::Kind::message, "fill ghosts", patch.id());
      for (const NumberedFill& fill : fills) work(fill, patch);
    };
    threads.forEach(static_cast<int>(patches.size()), workOn, trace::Kind::message);
  };
  // A patch reads of others only what they own, and that stands still once all have made room.
  forEachPatch([&](const NumberedFill& fill, const Patch& patch) {
    if (fill.particles) makeRoom(warehouse, fill, patch);
  });
  forEachPatch([&](const NumberedFill& fill, const Patch& patch) {
    if (fill.particles)
      fillParticles(warehouse, fill, patch);
    else
      fillPatch(warehouse, fill.variable, fill.generation, patch);
  });
}

}  // namespace tushar::tasks
