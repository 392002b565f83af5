#include "core/tasks/relocation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/base/error.hpp"
#include "core/tasks/broken_value.hpp"
#include "core/tasks/outcome.hpp"

namespace tushar::tasks {

using data::Generation;
using data::ParticleRange;
using data::ParticleSet;
using data::Variable;
using grid::Patch;

namespace {

template <int D>
Index3 widened(const Index<D>& cell) {
  Index3 wide;
  for (int d = 0; d < D; ++d) wide[d] = cell[d];
  return wide;
}

template <std::size_t Words>
void gatherWords(const std::byte* from, std::byte* to, const int* source, int count) {
  const auto* in = reinterpret_cast<const std::uint64_t*>(from);
  auto* out = reinterpret_cast<std::uint64_t*>(to);
  for (int k = 0; k < count; ++k)
    for (std::size_t w = 0; w < Words; ++w)
      out[static_cast<std::size_t>(k) * Words + w] = in[static_cast<std::size_t>(source[k]) * Words + w];
}

/// to[k] = from[source[k]] for `count` elements of `bytes` bytes.
void gather(const std::byte* from, std::byte* to, const int* source, int count, std::size_t bytes) {
  switch (bytes) {  // numbers, vectors, tensors: no call for each of them
    case 8: return gatherWords<1>(from, to, source, count);
    case 16: return gatherWords<2>(from, to, source, count);
    case 24: return gatherWords<3>(from, to, source, count);
    case 72: return gatherWords<9>(from, to, source, count);
    default: break;
  }
  for (int k = 0; k < count; ++k)
    std::memcpy(to + static_cast<std::size_t>(k) * bytes, from + static_cast<std::size_t>(source[k]) * bytes, bytes);
}

/// Whether a position lies in the cell with these bounds.
template <int D>
bool isInside(const Vec<D>& x, const Vec<D>& lower, const Vec<D>& upper) {
  bool inside = true;
  for (int d = 0; d < D; ++d) inside &= (x[d] >= lower[d]) & (x[d] < upper[d]);
  return inside;
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

/// Whether a particle may leave the grid to `cell`: yes through a free face.
template <int D>
bool mayLeave(const grid::Level& level, const Vec<D>& x, const Index<D>& cell) {
  bool may = true;
  for (int d = 0; d < D; ++d) {
    const bool below = cell[d] < 0, above = cell[d] >= level.cells().upper[d];
    may = may && std::isfinite(x[d]) && !(below && level.isSymmetry(d, 0)) && !(above && level.isSymmetry(d, 1));
  }
  return may;
}

}  // namespace

void Relocation::forgetLayout() {
  moves_.clear();
  spare_.clear();
  emigration_.forgetLayout();
}

template <class Work>
void Relocation::forEachPatch(const Work& work) {
  const std::vector<Patch>& patches = warehouse_->level().patches();
  threads_->forEach(static_cast<int>(patches.size()), [&](int k) {
    const Patch& patch = patches[static_cast<std::size_t>(k)];
    const trace::Span span(trace::Kind::task, "relocate", patch.id());
    work(patch);
  });
}

bool Relocation::run(int material, int position, const std::vector<Carried>& carried, bool hasStopped) {
  moves_.resize(static_cast<std::size_t>(warehouse_->patches()));
  spare_.resize(moves_.size());
  for (std::size_t patch = 0; patch < spare_.size(); ++patch) spare_[patch].pool = static_cast<int>(patch);
  const int id = warehouse_->table().find(data::particleId.name, material);
  if (!hasStopped) switch (warehouse_->level().dimension()) {
      case 1: findMoves<1>(material, position, id); break;
      case 2: findMoves<2>(material, position, id); break;
      default: findMoves<3>(material, position, id);
    }
  Verdict verdict = gatherMoves(hasStopped);
  warehouse_->ranks().merge(verdict);
  if (verdict.hasStopped) return false;
  if (verdict.hasEscape) refuseEscape(position, verdict);
  emigration_.run(carried, verdict.goFar);
  receiveAll();
  forEachPatch([&](const Patch& patch) { rebuild(patch, material, id); });
  for (std::size_t place = 0; place < carried.size(); ++place) carry(carried[place], place);
  return true;
}

void Relocation::Verdict::merge(const Verdict& other) {
  hasStopped = hasStopped || other.hasStopped;
  goFar = goFar || other.goFar;
  if (!other.hasEscape || (hasEscape && escape < other.escape)) return;
  hasEscape = true;
  escape = other.escape;
  rank = other.rank;
}

template <int D>
void Relocation::findMoves(int material, int position, int id) {
  forEachPatch([&](const Patch& patch) {
    const auto values = [&](Generation generation, int number) {
      return warehouse_->variable(generation, number, patch.id()).values.data();
    };
    findMoves<D>(patch, warehouse_->particles(Generation::old, material, patch.id()),
                 reinterpret_cast<Vec<D>*>(values(Generation::fresh, position)),
                 reinterpret_cast<const ParticleId*>(values(Generation::old, id)));
  });
}

template <int D>
void Relocation::findMoves(const Patch& patch, const ParticleSet& set, Vec<D>* x, const ParticleId* ids) {
  const grid::Level& level = warehouse_->level();
  PatchMoves& moves = movesOf(patch);
  moves.departed.clear();
  moves.outgoing.clear();
  moves.incoming.clear();
  moves.firstIncoming.assign(patch.cells().size(), -1);
  moves.isEntered.assign(patch.cells().rows(), false);
  moves.escape.reset();
  moves.leaving = 0;
  set.forEachOccupied<D>(patch.cells(), [&](const Index<D>& cell, const ParticleRange& range) {
    Vec<D> lower, upper;
    for (int d = 0; d < D; ++d) {
      lower[d] = level.nodePosition(d, cell[d]);
      upper[d] = level.nodePosition(d, cell[d] + 1);
    }
    for (const int p : range)
      if (!isInside<D>(x[p], lower, upper) && level.cellOf<D>(x[p]) != cell) move<D>(patch, cell, x[p], ids[p], p);
  });
}

template <int D>
void Relocation::move(const Patch& from, const Index<D>& fromCell, Vec<D>& x, ParticleId id, int place) {
  const grid::Level& level = warehouse_->level();
  PatchMoves& moves = movesOf(from);
  moves.departed.push_back(place);
  if (level.isPeriodic()) wrap<D>(level, x);
  const Index<D> cell = level.cellOf<D>(x);
  if (!level.cells().contains(cell)) {
    ++moves.leaving;
    const Escape escape{level.cellNumber<D>(fromCell), id, from.id(), place};
    if (!mayLeave<D>(level, x, cell) && (!moves.escape || escape < *moves.escape)) moves.escape = escape;
    return;
  }
  const Index3 wide = widened(cell);
  const Incoming particle{id, from.id(), place, -1};
  if (from.cells().contains(wide))
    receive(from, wide, particle);
  else
    moves.outgoing.push_back({wide, particle});
}

Relocation::Verdict Relocation::gatherMoves(bool hasStopped) {
  const grid::Level& level = warehouse_->level();
  Verdict verdict{hasStopped, false, false, warehouse_->ranks().rank(), {}};
  emigration_.start();
  for (const PatchMoves& moves : moves_) {
    if (hasStopped) break;
    leaving_ += moves.leaving;
    if (moves.escape) verdict.merge({false, true, false, verdict.rank, *moves.escape});
    for (const Outgoing& one : moves.outgoing)
      if (const int patch = level.patchOf(one.cell).id(); !level.isMine(patch))
        emigration_.add(level.ownerOf(patch), {one.particle.id, one.cell, one.particle.patch, one.particle.place});
  }
  verdict.goFar = emigration_.goesFar();
  return verdict;
}

void Relocation::refuseEscape(int position, const Verdict& verdict) const {
  if (const auto broken = firstBroken(*warehouse_, {position, Generation::old}, data::Bound::finite))
    throw NumericalError(fmt::format("{}; patch {}", broken->sentence, broken->patch), "", broken->label);
  std::optional<NumericalError> mine;
  if (verdict.rank == warehouse_->ranks().rank()) {
    const int dimension = warehouse_->level().dimension();
    const std::string what = dimension == 1   ? sentence<1>(position, verdict.escape)
                             : dimension == 2 ? sentence<2>(position, verdict.escape)
                                              : sentence<3>(position, verdict.escape);
    mine.emplace(what, "", "p.x", verdict.escape.cell);
  }
  throw told(warehouse_->ranks(), mine, verdict.rank);
}

template <int D>
std::string Relocation::sentence(int position, const Escape& escape) const {
  const grid::Level& level = warehouse_->level();
  const auto at = [&](Generation generation) {
    const Variable& x = warehouse_->variable(generation, position, escape.patch);
    return reinterpret_cast<const Vec<D>*>(x.values.data())[escape.place];
  };
  const Vec<D> x = at(Generation::fresh);
  int through = 0, side = 0;
  for (int d = 0; d < D; ++d)
    for (const int s : {0, 1})
      if (level.isSymmetry(d, s) && level.cellAlong(d, x[d]) == (s == 0 ? -1 : level.cells().upper[d])) {
        through = d;
        side = s;
      }
  const char axis = "xyz"[level.axis(through)];
  return fmt::format("particle {} passed through the symmetry plane {}{}, from {} = {:.6g} m to {:.6g} m; patch {}",
                     escape.id, axis, "-+"[side], axis, at(Generation::old)[through], x[through], escape.patch);
}

void Relocation::receiveAll() {
  const grid::Level& level = warehouse_->level();
  for (const PatchMoves& moves : moves_)
    for (const Outgoing& one : moves.outgoing)
      if (const Patch to = level.patchOf(one.cell); level.isMine(to.id())) receive(to, one.cell, one.particle);
  const std::vector<Emigrant>& arrived = emigration_.arrived();
  for (std::size_t k = 0; k < arrived.size(); ++k)
    receive(level.patchOf(arrived[k].cell), arrived[k].cell, {arrived[k].id, -1, static_cast<int>(k), -1});
}

void Relocation::receive(const Patch& patch, const Index3& cell, const Incoming& particle) {
  PatchMoves& moves = movesOf(patch);
  const int added = static_cast<int>(moves.incoming.size());
  moves.incoming.push_back(particle);
  int* link = &moves.firstIncoming[patch.cells().offset(cell)];
  while (*link >= 0 && moves.incoming[static_cast<std::size_t>(*link)].id < particle.id)
    link = &moves.incoming[static_cast<std::size_t>(*link)].next;
  moves.incoming.back().next = *link;
  *link = added;
  moves.isEntered[patch.cells().rowOf(cell)] = true;
}

void Relocation::rebuild(const Patch& patch, int material, int id) {
  PatchMoves& moves = movesOf(patch);
  const ParticleSet& before = warehouse_->particles(Generation::old, material, patch.id());
  ParticleSet& after = warehouse_->particles(Generation::fresh, material, patch.id());
  const auto* ids =
      reinterpret_cast<const ParticleId*>(warehouse_->variable(Generation::old, id, patch.id()).values.data());
  after.reset(patch, warehouse_->table().reach(material));
  moves.foreign.clear();
  moves.pieces.clear();
  moves.source.resize(static_cast<std::size_t>(before.owned()) + moves.incoming.size());
  moves.count = 0;
  std::size_t nextDeparted = 0;
  const int* firstIncoming = moves.firstIncoming.data();
  const int rowLength = patch.cells().extent(0);
  grid::forEach<3>(patch.cells().rowStarts(), [&](const Index3& cell) {
    const ParticleRange* from = before.row(cell);
    ParticleRange* to = after.row(cell);
    if (!moves.isEntered[patch.cells().rowOf(cell)] && before.occupied(cell, patch.cells().upper[0]).empty()) {
      std::fill_n(to, rowLength, ParticleRange{moves.count, moves.count});
      firstIncoming += rowLength;
      return;
    }
    for (int k = 0; k < rowLength; ++k, ++from, ++to, ++firstIncoming) {
      const int first = moves.count;
      const bool stays = nextDeparted == moves.departed.size() || moves.departed[nextDeparted] >= from->last;
      if (stays && *firstIncoming < 0)
        keepCell(moves, *from);
      else
        mergeCell(patch.id(), moves, *from, *firstIncoming, ids, nextDeparted);
      *to = {first, moves.count};
    }
  });
  after.setOwned(moves.count);
  gatherShortCopies(moves);
}

/// Appends a cell that nobody leaves and nobody enters.
void Relocation::keepCell(PatchMoves& moves, const ParticleRange& before) {
  if (before.empty()) return;
  Piece* last = moves.pieces.empty() ? nullptr : &moves.pieces.back();
  if (last && last->from >= 0 && last->from + last->count == before.first)
    last->count += before.size();
  else
    moves.pieces.push_back({moves.count, before.size(), before.first});
  moves.count += before.size();
}

/// Turns copies too short to be worth a call into gathers, and joins neighbouring gathers.
void Relocation::gatherShortCopies(PatchMoves& moves) {
  constexpr int worthwhile = 32;
  std::size_t kept = 0;
  for (Piece piece : moves.pieces) {
    if (piece.from >= 0 && piece.count < worthwhile) {
      for (int k = 0; k < piece.count; ++k) moves.source[static_cast<std::size_t>(piece.to + k)] = piece.from + k;
      piece.from = -1;
    }
    if (kept > 0 && piece.from < 0 && moves.pieces[kept - 1].from < 0)
      moves.pieces[kept - 1].count += piece.count;
    else
      moves.pieces[kept++] = piece;
  }
  moves.pieces.resize(kept);
}

/// Appends the particles of one cell: those that stay, in their order, and those that come in between by id.
void Relocation::mergeCell(int patch, PatchMoves& moves, const ParticleRange& before, int firstIncoming,
                           const ParticleId* ids, std::size_t& nextDeparted) {
  int* source = moves.source.data();
  int next = moves.count, waiting = firstIncoming;
  const auto isDeparted = [&](int p) {
    return nextDeparted < moves.departed.size() && moves.departed[nextDeparted] == p;
  };
  const auto letInOne = [&] {
    const Incoming& particle = moves.incoming[static_cast<std::size_t>(waiting)];
    if (particle.patch != patch) moves.foreign.emplace_back(next, waiting);
    source[next++] = particle.patch == patch ? particle.place : 0;
    waiting = particle.next;
  };
  for (int p = before.first; p < before.last; ++p) {
    if (isDeparted(p)) {
      ++nextDeparted;
      continue;
    }
    while (waiting >= 0 && moves.incoming[static_cast<std::size_t>(waiting)].id < ids[p]) letInOne();
    source[next++] = p;
  }
  while (waiting >= 0) letInOne();
  if (next > moves.count) moves.pieces.push_back({moves.count, next - moves.count, -1});
  moves.count = next;
}

void Relocation::carry(const Carried& carried, std::size_t place) {
  forEachPatch([&](const Patch& patch) { carry(carried, place, patch); });
  std::size_t k = 0;
  for (const Patch& patch : warehouse_->level().patches()) {
    std::swap(warehouse_->variable(Generation::fresh, carried.variable, patch.id()), spare_[k]);
    warehouse_->free(spare_[k++]);
  }
}

void Relocation::carry(const Carried& carried, std::size_t place, const Patch& patch) {
  const data::Label& label = *warehouse_->table()[carried.variable].label;
  const PatchMoves& moves = movesOf(patch);
  const Variable& from = warehouse_->variable(carried.from, carried.variable, patch.id());
  Variable& spare = spare_[static_cast<std::size_t>(patch.id() - warehouse_->level().firstPatch())];
  warehouse_->allocateParticles(spare, label, moves.count);
  std::byte* to = spare.values.data();
  for (const Piece& piece : moves.pieces) {
    std::byte* there = to + static_cast<std::size_t>(piece.to) * label.bytes;
    if (piece.from >= 0)
      std::memcpy(there, from.values.data() + static_cast<std::size_t>(piece.from) * label.bytes,
                  static_cast<std::size_t>(piece.count) * label.bytes);
    else if (from.held && from.values.data())
      gather(from.values.data(), there, moves.source.data() + piece.to, piece.count, label.bytes);
  }
  for (const auto& [newPlace, index] : moves.foreign) {
    const Incoming& particle = moves.incoming[static_cast<std::size_t>(index)];
    const std::byte* values =
        particle.patch < 0 ? emigration_.values(place)
                           : warehouse_->variable(carried.from, carried.variable, particle.patch).values.data();
    std::memcpy(to + static_cast<std::size_t>(newPlace) * label.bytes,
                values + static_cast<std::size_t>(particle.place) * label.bytes, label.bytes);
  }
}

}  // namespace tushar::tasks
