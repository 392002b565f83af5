#include "core/tasks/relocation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/data/vanished.hpp"
#include "core/grid/passed_sides.hpp"
#include "core/tasks/broken_value.hpp"
#include "core/tasks/cell_bounds.hpp"
#include "core/tasks/outcome.hpp"

// How Relocation finds which particles leave their cells, and where to.

namespace tushar::tasks {

using data::Generation;
using data::ParticleRange;
using grid::Patch;

namespace {

template <int D>
Index3 widened(const Index<D>& cell) {
  Index3 wide;
  for (int d = 0; d < D; ++d) wide[d] = cell[d];
  return wide;
}

/// Whether a particle that moves between two cells leaves its row along the first axis.
template <int D>
bool leavesRow(const Index<D>& from, const Index<D>& to) {
  bool leaves = false;
  for (int d = 1; d < D; ++d) leaves |= to[d] != from[d];
  return leaves;
}

/// Does what grid::withUpperSides does; not inline, because hardly any grid has inner sides.
template <int D>
[[gnu::noinline]] Index<D> cellBesideInnerSides(const grid::Level& level, const Index<D>& from, const Vec<D>& x,
                                                const Index<D>& found) {
  return grid::withUpperSides<D>(level, from, x, found);
}

/// Brings a position back to the grid along periodic axes.
template <int D>
void wrap(const grid::Level& level, Vec<D>& x) {
  for (int d = 0; d < D; ++d) {
    if (!level.isPeriodic(d) || !std::isfinite(x[d])) continue;
    const double first = level.nodePosition(d, 0), last = level.nodePosition(d, level.cells().upper[d]);
    if (x[d] < first || x[d] > last) x[d] -= std::floor((x[d] - first) / level.period(d)) * level.period(d);
    x[d] = std::clamp(x[d], first, last);
  }
}

/// Whether a particle may leave the grid from a cell towards the cell `cell`: only through free faces.
template <int D>
bool mayLeave(const grid::Level& level, const Vec<D>& x, const Index<D>& from, const Index<D>& cell) {
  bool may = true;
  if (level.boxes())
    for (const auto& passed : grid::passedSides<D>(level, from, cell))
      may = may && !level.isSymmetry(passed.axis, passed.side);
  for (int d = 0; d < D; ++d) {
    const bool below = cell[d] < 0, above = cell[d] >= level.cells().upper[d];
    may = may && std::isfinite(x[d]) && !(below && level.isSymmetry(d, 0)) && !(above && level.isSymmetry(d, 1));
  }
  return may;
}

}  // namespace

void Relocation::forgetLayout() { moves_.clear(); }

Relocation::Moves& Relocation::movesOf(int material) {
  while (moves_.size() <= static_cast<std::size_t>(material)) moves_.emplace_back(*warehouse_);
  Moves& moves = moves_[material];
  moves.patches.resize(warehouse_->patches());
  return moves;
}

int Relocation::idOf(int material) {
  Moves& moves = movesOf(material);
  if (moves.id < 0) moves.id = warehouse_->table().find(data::particleId.name, material);
  return moves.id;
}

bool Relocation::find(int material, int position, bool hasStopped) {
  const int id = idOf(material);
  if (!hasStopped) switch (warehouse_->grid().dimension()) {
      case 1:
        findMoves<1>(material, position, id);
        break;
      case 2:
        findMoves<2>(material, position, id);
        break;
      default:
        findMoves<3>(material, position, id);
    }
  Verdict verdict = gather(movesOf(material), hasStopped);
  warehouse_->ranks().merge(verdict);
  if (verdict.hasStopped) return false;
  if (verdict.hasEscape) refuseEscape(position, verdict);
  losing_.removed += verdict.removed;
  movesOf(material).goFar = verdict.goFar;
  return true;
}

void Relocation::Verdict::merge(const Verdict& other) {
  hasStopped = hasStopped || other.hasStopped;
  goFar = goFar || other.goFar;
  removed += other.removed;
  if (!other.hasEscape || (hasEscape && escape < other.escape)) return;
  hasEscape = true;
  escape = other.escape;
  rank = other.rank;
}

template <int D>
void Relocation::findMoves(int material, int position, int id) {
  Moves& moves = movesOf(material);
  margin_ = warehouse_->table().reach(material) + 1;
  forEachPatch([&](const Patch& patch) {
    const auto values = [&](Generation generation, int number) {
      return warehouse_->variable(generation, number, patch.id()).values;
    };
    findMoves<D>(patch, warehouse_->particles(Generation::old, material, patch.id()),
                 reinterpret_cast<Vec<D>*>(values(Generation::fresh, position)),
                 reinterpret_cast<const ParticleId*>(values(Generation::old, id)), of(moves, patch.id()));
  });
}

/// Discards the records of the last relocation, even if its moves have not been made.
void Relocation::forgetIncoming(const Patch& patch, PatchMoves& moves) {
  const grid::Box& cells = patch.cells();
  const std::size_t length = cells.extent(0);
  if (moves.firstIncoming.hasOpenRows() || !moves.firstIncoming.isOf(cells.rows(), length))
    moves.firstIncoming.reset(cells.rows(), length);
  moves.departed.clear();
  moves.crossing = 0;
  moves.outgoing.clear();
  moves.incoming.clear();
  moves.arrivals.clear();
  moves.escape.reset();
  moves.losing = {};
}

template <int D>
void Relocation::findMoves(const Patch& patch, const data::ParticleSet& set, Vec<D>* x, const ParticleId* ids,
                           PatchMoves& moves) {
  forgetIncoming(patch, moves);
  if (set.owned() == 0) return;
  const grid::Level& level = warehouse_->grid().finest();
  const grid::Box& cells = patch.cells();
  const bool isPlain = !level.boxes() && warehouse_->grid().levels() == 1;
  if (moves.nodes.empty()) moves.nodes = CellBounds<D>::nodesAround(level, cells);
  CellBounds<D> bounds(level, cells, moves.nodes);
  const auto visitCell = [&](const Index<D>& cell, const ParticleRange& range) {
    bounds.choose(cell[0]);
    if (range.size() > 1 && bounds.areInside(x + range.first, range.size(), set.owned() - range.first)) return;
    for (const int p : range) {
      Index<D> step;
      const bool isNear = bounds.isNear(x[p], step);
      if (isNear && step == Index<D>()) continue;
      Index<D> to = isNear ? cell + step : level.cellOf<D>(x[p]);
      if (level.boxes()) to = cellBesideInnerSides<D>(level, cell, x[p], to);
      if (to == cell) continue;
      moves.departed.push_back(p);
      if (isNear && isPlain)
        enter(patch, widened(to), ids[p], moves);
      else
        move<D>(patch, {cell, to}, x[p], ids[p], moves);
    }
  };
  grid::forEach<D>(cells.rowStarts(), [&](Index<D> cell) {
    bounds.chooseRow(cell);
    const data::ParticleSet::Span span = set.occupied(cell, cells.upper[0]);
    cell[0] = span.first;
    for (const ParticleRange* range = set.row(cell); cell[0] < span.last;) {
      const int end = std::min(cell[0] + Lanes::count, span.last);
      Index<D> step;
      if (end == cell[0] + Lanes::count && bounds.moveTogether(cell[0], range, x, step) &&
          (step == Index<D>() || (isPlain && enterTogether<D>(patch, cell, step, {range->first, ids}, moves)))) {
        cell[0] = end;
        range += Lanes::count;
      } else {
        for (; cell[0] < end; ++cell[0], ++range) visitCell(cell, *range);
      }
    }
  });
}

template <int D>
bool Relocation::enterTogether(const Patch& patch, const Index<D>& cell, const Index<D>& step, const Column& particles,
                               PatchMoves& moves) {
  const Index3 first = widened(cell + step);
  Index3 last = first;
  last[0] += Lanes::count - 1;
  if (!patch.cells().contains(first) || !patch.cells().contains(last)) return false;
  int* links = moves.firstIncoming.open(patch.cells().rowOf(first)) + (first[0] - patch.cells().lower[0]);
  for (int k = 0; k < Lanes::count; ++k) {
    const int p = particles.first + k;
    moves.departed.push_back(p);
    link(links + k, {particles.ids[p], static_cast<int>(moves.departed.size()) - 1, -1}, moves);
  }
  if (leavesRow<D>(cell, cell + step)) moves.crossing += Lanes::count;
  return true;
}

template <int D>
void Relocation::move(const Patch& from, const Step<D>& step, Vec<D>& x, ParticleId id, PatchMoves& moves) {
  if (x[0] == data::removed) ++moves.losing.removed;
  if (x[0] == data::vanished || x[0] == data::removed) return;
  const grid::Level& level = warehouse_->grid().finest();
  Index<D> cell = step.to;
  if (level.isPeriodic() && !level.cells().contains(cell)) {
    wrap<D>(level, x);
    cell = level.cellOf<D>(x);
  }
  const Escape escape{level.cellNumber<D>(step.from), id, from.id(), moves.departed.back()};
  if (!level.isInside<D>(cell)) {
    ++moves.losing.left;
    if (!mayLeave<D>(level, x, step.from, cell) && (!moves.escape || escape < *moves.escape)) moves.escape = escape;
  } else if (isNearCoarser(from, widened(cell))) {  // it may be outside all patches of this level
    if (!moves.escape || escape < *moves.escape) moves.escape = escape;
  } else {
    enter(from, widened(cell), id, moves);
  }
}

inline void Relocation::enter(const Patch& from, const Index3& cell, ParticleId id, PatchMoves& moves) {
  const int departed = static_cast<int>(moves.departed.size()) - 1;
  if (from.cells().contains(cell))
    receive(from, cell, {id, departed, -1}, moves);
  else
    moves.outgoing.push_back({id, cell, moves.departed.back(), departed});
}

bool Relocation::isInOrNearCoarser(const Patch& from, const Index3& cell) const {
  const grid::Grid& grid = warehouse_->grid();
  const grid::Box around = grid::Box{cell, cell + Index3::filled(1)}.grown(margin_, grid.dimension());
  return !(around.intersect(from.cells()) == around) && !grid.isFinest(around);
}

void Relocation::receive(const Patch& patch, const Index3& cell, const Incoming& particle, PatchMoves& moves) {
  link(moves.firstIncoming.open(patch.cells().rowOf(cell)) + (cell[0] - patch.cells().lower[0]), particle, moves);
}

inline void Relocation::link(int* first, const Incoming& particle, PatchMoves& moves) {
  const int added = static_cast<int>(moves.incoming.size());
  moves.incoming.push_back(particle);
  while (*first >= 0 && moves.incoming[*first].id < particle.id) first = &moves.incoming[*first].next;
  moves.incoming.back().next = *first;
  *first = added;
}

Relocation::Verdict Relocation::gather(Moves& moves, bool hasStopped) {
  const grid::Grid& grid = warehouse_->grid();
  Verdict verdict{hasStopped, false, false, warehouse_->ranks().rank(), {}};
  moves.migration.start();
  for (const Patch& from : grid.patches()) {
    if (hasStopped) break;
    const PatchMoves& ofPatch = of(moves, from.id());
    losing_.left += ofPatch.losing.left;
    verdict.removed += ofPatch.losing.removed;
    if (ofPatch.escape) verdict.merge({false, true, false, verdict.rank, *ofPatch.escape});
    for (const Outgoing& one : ofPatch.outgoing)
      if (const int patch = grid.patchOf(one.cell, grid.finest().number()).id(); !grid.isMine(patch))
        moves.migration.add(grid.ownerOf(patch), {one.id, one.cell, from.id(), one.from});
  }
  verdict.goFar = moves.migration.goesFar();
  return verdict;
}

void Relocation::refuseEscape(int position, const Verdict& verdict) const {
  if (const auto broken = firstBroken(*warehouse_, {position, Generation::old}, data::Bound::finite))
    throw NumericalError(fmt::format("{}; patch {}", broken->sentence, broken->patch), "", broken->label);
  std::optional<NumericalError> mine;
  if (verdict.rank == warehouse_->ranks().rank()) {
    const int dimension = warehouse_->grid().dimension();
    mine = dimension == 1   ? refusal<1>(position, verdict.escape)
           : dimension == 2 ? refusal<2>(position, verdict.escape)
                            : refusal<3>(position, verdict.escape);
  }
  throw broadcastError(warehouse_->ranks(), mine, verdict.rank);
}

template <int D>
NumericalError Relocation::refusal(int position, const Escape& escape) const {
  const grid::Level& level = warehouse_->grid().finest();
  const auto at = [&](Generation generation) {
    const data::Variable x = warehouse_->variable(generation, position, escape.patch);
    return reinterpret_cast<const Vec<D>*>(x.values)[escape.place];
  };
  const Vec<D> x = at(Generation::fresh);
  if (const Index<D> cell = level.cellOf<D>(x); level.isInside<D>(cell))
    return {fmt::format("particle {} came within {} of coarser cells, where particles are not allowed; patch {}",
                        escape.id, counted(margin_, "cell"), escape.patch),
            advice_near_coarser_, "p.x", escape.cell};
  int through = 0, side = 0;
  for (int d = 0; d < D; ++d)
    for (const int s : {0, 1})
      if (level.isSymmetry(d, s) && level.cellAlong(d, x[d]) == (s == 0 ? -1 : level.cells().upper[d])) {
        through = d;
        side = s;
      }
  if (level.boxes())
    for (const auto& passed : grid::passedSides<D>(level, level.cellOf<D>(at(Generation::old)), level.cellOf<D>(x)))
      if (level.isSymmetry(passed.axis, passed.side)) {
        through = passed.axis;
        side = passed.side;
      }
  const char axis = "xyz"[level.axis(through)];
  return {fmt::format("particle {} passed through the symmetry plane {}{}, from {} = {:.6g} m to {:.6g} m; patch {}",
                      escape.id, axis, "-+"[side], axis, at(Generation::old)[through], x[through], escape.patch),
          "", "p.x", escape.cell};
}

}  // namespace tushar::tasks
