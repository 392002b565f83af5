#include "core/tasks/ghost_messages.hpp"

#include <cstdint>
#include <cstring>

#include "core/tasks/rim_fluxes.hpp"

namespace tushar::tasks {

using data::ParticleRange;
using data::Variable;

namespace {

/// A row of nodes, or the particles of a cell, in a message: their position and their number.
struct PackedRun {
  Index3 first;
  std::int32_t count;
};

void writeMeans(const grid::Grid& grid, const data::Label& label, const GhostCopy& copy, const Variable& from,
                std::byte* to) {
  if (copy.rim >= 0)
    return meanFluxes(grid, copy, label.components, reinterpret_cast<const double*>(from.values),
                      reinterpret_cast<double*>(to));
  const grid::Box box = copy.box.shifted(Index3{} - copy.shift);
  restrictTo(label, grid.dimension(), box, {from.values, from.stored}, {to, box});
}

/// Writes old + part (new - old) for the cells of a copy; both generations have the same ghosts.
void writeBetween(const data::Label& label, const GhostCopy& copy, const Variable& before, const Variable& after,
                  double part, double* to) {
  const std::size_t components = label.components;
  const auto* old = reinterpret_cast<const double*>(before.values);
  const auto* fresh = reinterpret_cast<const double*>(after.values);
  const grid::Box box = copy.box.shifted(Index3{} - copy.shift);
  grid::forEach<3>(box.rowStarts(), [&](const Index3& first) {
    const std::size_t start = before.stored.offset(first) * components;
    const std::size_t end = start + static_cast<std::size_t>(box.extent(0)) * components;
    for (std::size_t k = start; k < end; ++k) *to++ = old[k] + part * (fresh[k] - old[k]);
  });
}

}  // namespace

bool computeValues(data::Warehouse& warehouse, const BoundGhostFill& fill, const GhostCopy& copy, double part,
                   mpi::Bytes& values) {
  const data::Label& label = *warehouse.table()[fill.variable].label;
  const Variable from = warehouse.variable(fill.generation, fill.variable, copy.from);
  const auto makeRoom = [&] { values.resize(copy.box.size() * label.bytes); };
  if (copy.isMean) {
    makeRoom();
    writeMeans(warehouse.grid(), label, copy, from, values.data());
    return true;
  }
  if (part == 0 || copy.coarse < 0 || fill.generation != data::Generation::old || label.number != data::Number::real)
    return false;
  const Variable after = warehouse.variable(data::Generation::fresh, fill.variable, copy.from);
  if (!after.held) return false;  // no step changes it
  makeRoom();
  writeBetween(label, copy, from, after, part, reinterpret_cast<double*>(values.data()));
  return true;
}

void Packer::addGrid(const GhostCopy& copy) {
  const Variable from = variable(copy.from);
  const std::size_t bytes = name_.label->bytes;
  mpi::Bytes values;  // values in a message need not be aligned, so numbers are computed here first
  if (computeValues(warehouse_, fill_, copy, part_, values)) return mpi::append(message_, values.data(), values.size());
  forEachRowOf(copy.box.shifted(Index3{} - copy.shift), bytes, [&](const Index3& first, std::size_t length) {
    mpi::append(message_, valueAt(from, first, bytes), length);
  });
}

void Packer::addNear(const GhostCopy& copy, const data::TouchedRows& rows) {
  const Variable from = variable(copy.from);
  const std::size_t bytes = name_.label->bytes;
  const std::size_t start = message_.size();
  std::int32_t count = 0;
  mpi::append(message_, &count, sizeof(count));
  rows.forEachRow(copy.box.shifted(Index3{} - copy.shift), [&](const Index3& first, int end) {
    const PackedRun piece{first + copy.shift, end - first[0]};
    mpi::append(message_, &piece, sizeof(piece));
    mpi::append(message_, valueAt(from, first, bytes), static_cast<std::size_t>(piece.count) * bytes);
    ++count;
  });
  std::memcpy(message_.data() + start, &count, sizeof(count));
}

void Packer::addCounts(const GhostCopy& copy) {
  const std::size_t start = message_.size();
  std::int32_t cells = 0;
  mpi::append(message_, &cells, sizeof(cells));
  forEachCell(copy, [&](const Index3& cell, const ParticleRange& range) {
    const PackedRun piece{cell + copy.shift, range.size()};
    mpi::append(message_, &piece, sizeof(piece));
    ++cells;
  });
  std::memcpy(message_.data() + start, &cells, sizeof(cells));
}

void Packer::addParticles(const GhostCopy& copy) {
  const Variable from = variable(copy.from);
  const std::size_t bytes = name_.label->bytes;
  ParticleRange run;  // of cells that are consecutive in memory
  const auto appendRun = [&] {
    mpi::append(message_, from.values + static_cast<std::size_t>(run.first) * bytes,
                static_cast<std::size_t>(run.size()) * bytes);
  };
  forEachCell(copy, [&](const Index3&, const ParticleRange& range) {
    if (range.first != run.last) {
      appendRun();
      run = range;
    }
    run.last = range.last;
  });
  appendRun();
}

template <class Visit>
void Packer::forEachCell(const GhostCopy& copy, Visit&& visit) {
  const data::ParticleSet& set = warehouse_.particles(fill_.set, name_.material, copy.from);
  set.forEachOccupied<3>(copy.box.shifted(Index3{} - copy.shift), std::forward<Visit>(visit));
}

const std::byte* ReceivedMessages::next(int from, std::size_t length) {
  Message& message = messages_.at(from);
  const std::byte* here = message.bytes.data() + message.read;
  message.read += length;
  return here;
}

template <class T>
T ReceivedMessages::nextNumber(int from) {
  T number{};
  std::memcpy(&number, next(from, sizeof(number)), sizeof(number));
  return number;
}

std::vector<std::pair<Index3, ParticleRange>> ReceivedMessages::takeCounts(const GhostCopy& copy) {
  std::vector<std::pair<Index3, ParticleRange>> cells(nextNumber<std::int32_t>(copy.rank));
  int place = 0;
  for (auto& [cell, range] : cells) {
    const auto piece = nextNumber<PackedRun>(copy.rank);
    cell = piece.first;
    range = {place, place + piece.count};
    place = range.last;
  }
  return cells;
}

void ReceivedMessages::takeGrid(const GhostCopy& copy, std::size_t bytes, const CellValues& to) {
  forEachRowOf(copy.box, bytes, [&](const Index3& first, std::size_t length) {
    std::memcpy(valueAt(to, first, bytes), next(copy.rank, length), length);
  });
}

void ReceivedMessages::takeNear(const GhostCopy& copy, std::size_t bytes, const CellValues& to) {
  for (auto left = nextNumber<std::int32_t>(copy.rank); left > 0; --left) {
    const auto piece = nextNumber<PackedRun>(copy.rank);
    const std::size_t length = static_cast<std::size_t>(piece.count) * bytes;
    std::memcpy(valueAt(to, piece.first, bytes), next(copy.rank, length), length);
  }
}

}  // namespace tushar::tasks
