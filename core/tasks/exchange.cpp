#include "core/tasks/exchange.hpp"

#include <algorithm>
#include <cstring>
#include <set>

#include "core/tasks/copy_cells.hpp"
#include "core/tasks/rim_fluxes.hpp"

namespace tushar::tasks {

using data::Generation;
using data::ParticleRange;
using data::ParticleSet;
using data::Variable;
using grid::Patch;
using mpi::Bytes;

namespace {

/// Shifts positions of ghosts to their periodic image.
void shiftPositions(const grid::Level& level, const Index3& shift, double* x, int count) {
  const int dimension = level.dimension();
  for (int d = 0; d < dimension; ++d) {
    const double by = shift[d] / level.cells().upper[d] * level.period(d);
    for (int k = 0; by != 0 && k < count; ++k) x[k * dimension + d] += by;
  }
}

/// Asks for the first cache lines of some bytes, which are soon to be read.
void prefetch(const std::byte* from, std::size_t bytes) {
  constexpr std::size_t line = 64, most = 6 * line;
  for (std::size_t k = 0; k < std::min(bytes, most); k += line) __builtin_prefetch(from + k);
}

}  // namespace

GhostReach reachOf(const data::VariableTable& table, const BoundGhostFill& fill) {
  const auto [label, material] = table[fill.variable];
  return {label->centring, fill.particles ? table.reach(material) : table.ghost(fill.variable)};
}

bool Exchange::movesNothing() const {
  return warehouse_->grid().patchCount() == 1 && !warehouse_->grid().level().isPeriodic();
}

void Exchange::send(std::span<const BoundGhostFill> fills, bool hasStopped) {
  fills_ = fills;
  if (movesNothing()) return;
  findPlans();
  noteUnresolved();
  if (!hasStopped) settleNear();
  if (!warehouse_->ranks().isAlone()) threads_->alone([&] { post(hasStopped); }, trace::Kind::message, "send");
}

void Exchange::findPlans() {
  plans_of_fills_.clear();
  for (const BoundGhostFill& fill : fills_) {
    GhostReach reach = reachOf(warehouse_->table(), fill);
    reach.level = level_;
    plans_of_fills_.push_back(&plans_.of(warehouse_->grid(), reach));
  }
  findJoints();
}

void Exchange::begin(bool hasStopped) {
  has_stopped_ = hasStopped;
  senders_.clear();
  if (movesNothing()) return;
  for (const BoundGhostFill& fill : fills_) {
    const std::set<int>& incoming = planOf(fill).incoming;
    senders_.insert(incoming.begin(), incoming.end());
  }
  if (hasStopped) return;
  settleNear();
  fillFromHere();
}

/// Finds the nodes near particles. Must run before the exchange determines ghost particles, because the nodes were
/// computed without them.
void Exchange::settleNear() {
  for (const BoundGhostFill& fill : fills_)
    if (isNear(fill)) near_.settle(fill.set, warehouse_->table()[fill.variable].material);
}

bool Exchange::finish() {
  ReceivedMessages messages;
  for (const int rank : senders_) {
    const trace::Span span(trace::Kind::wait, "receive");
    messages.add(rank, warehouse_->ranks().receive(rank, mpi::Tag::ghosts));
    has_stopped_ = messages.readStopped(rank) || has_stopped_;
  }
  outbox_.wait();
  const bool hasMessages = !senders_.empty();
  senders_.clear();
  if (has_stopped_ || !hasMessages) return !has_stopped_;
  const auto unpack = [&] {
    for (std::size_t k = 0; k < fills_.size(); ++k) fillFromElsewhere(fills_[k], resolves_[k], messages);
    fillTogetherFromElsewhere();
  };
  threads_->alone(unpack, trace::Kind::message, "unpack");
  return true;
}

bool Exchange::isReady(std::size_t place) {
  return std::all_of(fills_.begin(), fills_.end(),
                     [&](const BoundGhostFill& fill) { return planOf(fill).isLocal[place]; });
}

template <class Work>
void Exchange::forEach(const Work& work) {
  const std::vector<Patch>& patches = warehouse_->grid().patches();
  const auto workOn = [&](int place) {
    const std::size_t at = place;
    if (level_ >= 0 && patches[at].level().number() != level_) return;
    const trace::Span span(trace::Kind::message, "fill ghosts", patches[at].id());
    work(patches[at], at);
  };
  threads_->forEach(static_cast<int>(patches.size()), workOn, trace::Kind::message);
}

/// Fills ghosts from this rank. All patches determine their ghost particles in parallel; then copies get their indices
/// patch by patch.
void Exchange::fillFromHere() {
  for (std::size_t k = 0; k < fills_.size(); ++k)
    if (resolves_[k]) linkLocalGhosts(fills_[k]);
  for (std::size_t k = 0; k < fills_.size(); ++k)
    if (resolves_[k]) placeGhostCopies(fills_[k], nullptr);
  for (const BoundGhostFill& fill : fills_)
    if (fill.particles) reserveCopies(fill);
  const bool copies = warehouse_->grid().level().isPeriodic();  // otherwise particles of this rank are read in place
  if (!copies && std::all_of(fills_.begin(), fills_.end(), [](const BoundGhostFill& fill) { return fill.particles; }))
    return;
  forEach([&](const Patch& patch, std::size_t place) {
    for (const BoundGhostFill& fill : fills_) {
      if (fill.particles && copies) fillCopies(fill, patch, nullptr);
      if (fill.particles) continue;
      const FilledValues values(*warehouse_, fill);
      for (const GhostCopy& copy : planOf(fill).into[place])
        if (isHere(copy) && copy.coarse < 0) copyGrid(fill, copy, values);
      if (planOf(fill).isLocal[place] && !jointOf(fill)) fillFromCoarser(fill, place, nullptr);
    }
    for (const JointFill& joint : joints_)
      if (isLocal(joint, place)) fillTogether(joint, place);
  });
}

/// Records for which particle sets the ghosts have not been determined yet. They are determined on all patches of all
/// ranks or on none, so ghosts determined by a graph that has stopped are discarded.
void Exchange::noteUnresolved() {
  resolves_.assign(fills_.size(), false);
  std::set<std::pair<Generation, int>> settled;
  for (std::size_t k = 0; k < fills_.size(); ++k) {
    const int material = warehouse_->table()[fills_[k].variable].material;
    if (!fills_[k].particles || warehouse_->grid().patches().empty()) continue;
    const int patch = warehouse_->grid().firstPatch();
    resolves_[k] = !warehouse_->particles(fills_[k].set, material, patch).hasGhosts() &&
                   settled.emplace(fills_[k].set, material).second;
  }
}

void Exchange::post(bool hasStopped) {
  std::set<int> receivers;
  for (const BoundGhostFill& fill : fills_)
    for (const auto& copies : planOf(fill).outgoing) receivers.insert(copies.first);
  for (const int rank : receivers) {
    Bytes message = outbox_.buffer();
    message.push_back(std::byte{hasStopped});
    for (std::size_t k = 0; k < fills_.size() && !hasStopped; ++k) {
      const auto copies = planOf(fills_[k]).outgoing.find(rank);
      if (copies == planOf(fills_[k]).outgoing.end()) continue;
      Packer packer(*warehouse_, fills_[k], part_, message);
      if (resolves_[k])
        for (const GhostCopy& copy : copies->second) packer.addCounts(copy);
      for (const GhostCopy& copy : copies->second) {
        if (fills_[k].particles)
          packer.addParticles(copy);
        else if (isNear(fills_[k]))
          packer.addNear(copy, nearRows(fills_[k], copy.from));
        else
          packer.addGrid(copy);
      }
    }
    outbox_.send(rank, mpi::Tag::ghosts, std::move(message));
  }
}

void Exchange::copyGrid(const BoundGhostFill& fill, const GhostCopy& copy, const FilledValues& values) {
  if (isNear(fill)) return copyNear(fill, copy);
  copyGridTo(fill, copy, values, targetOf(values, copy));
}

void Exchange::copyNear(const BoundGhostFill& fill, const GhostCopy& copy) {
  const data::TouchedRows& rows = nearRows(fill, copy.from);
  if (rows.empty()) return;
  const std::size_t bytes = warehouse_->table()[fill.variable].label->bytes;
  const Variable from = warehouse_->variable(fill.generation, fill.variable, copy.from);
  const Variable to = warehouse_->variable(fill.generation, fill.variable, copy.to);
  rows.forEachRow(copy.box.shifted(Index3{} - copy.shift), [&](const Index3& first, int end) {
    std::memcpy(valueAt(to, first + copy.shift, bytes), valueAt(from, first, bytes),
                static_cast<std::size_t>(end - first[0]) * bytes);
  });
}

/// The destination of a copy: the values of the patch or, for fluxes, the second values of its rim faces, which contain
/// the means from the finer side.
CellValues Exchange::targetOf(const FilledValues& values, const GhostCopy& copy) const {
  const CellValues to = values.on(copy.to);
  if (copy.rim < 0) return to;
  const grid::RimPiece& piece = warehouse_->grid().rims(copy.to)[copy.rim];
  return {to.values + (piece.first + piece.cells.size()) * values.label.bytes, piece.cells};
}

void Exchange::copyGridTo(const BoundGhostFill& fill, const GhostCopy& copy, const FilledValues& values,
                          const CellValues& to) {
  const data::Label& label = values.label;
  const CellValues from = values.on(copy.from);
  if (copy.isMean && copy.rim < 0)
    return restrictTo(label, warehouse_->grid().dimension(), copy.box.shifted(Index3{} - copy.shift), from,
                      {to.values, to.stored.shifted(Index3{} - copy.shift)});
  if (copy.isMean)  // the cells of a copy are those of its piece
    return meanFluxes(warehouse_->grid(), copy, label.components, reinterpret_cast<const double*>(from.values),
                      reinterpret_cast<double*>(to.values));
  Bytes computed;
  if (part_ != 0 && computeValues(*warehouse_, fill, copy, part_, computed))
    copyCells(copy.box, {}, label.bytes, {computed.data(), copy.box}, to);
  else
    copyCells(copy.box, copy.shift, label.bytes, from, to);
}

/// Interpolates ghosts in coarser cells once the values of these cells are complete. If `messages` is given, also fills
/// all other ghosts that the patch gets from other ranks.
void Exchange::fillFromCoarser(const BoundGhostFill& fill, std::size_t place, ReceivedMessages* messages) {
  const std::vector<CoarseGhosts>& parts = planOf(fill).coarse[place];
  if (parts.empty() && !messages) return;
  thread_local Bytes coarse;
  gatherCoarse(fill, place, messages, coarse);
  const FilledValues values(*warehouse_, fill);
  const CellValues own = values.on(warehouse_->grid().patches()[place].id());
  std::byte* from = coarse.data();
  for (const CoarseGhosts& part : parts) {
    prolong(values.label, warehouse_->grid().dimension(), {from, part.cells}, part.ghosts, own);
    from += part.cells.size() * values.label.bytes;
  }
}

/// Puts the values of the coarser cells from which ghosts of a patch are interpolated into `coarse`, one part after the
/// other. If `messages` is given, also fills all other ghosts that the patch gets from other ranks.
void Exchange::gatherCoarse(const BoundGhostFill& fill, std::size_t place, ReceivedMessages* messages, Bytes& coarse) {
  const GhostPlan& plan = planOf(fill);
  const std::vector<CoarseGhosts>& parts = plan.coarse[place];
  const FilledValues values(*warehouse_, fill);
  const std::size_t bytes = values.label.bytes;
  thread_local std::vector<std::size_t> first;  // of each part in `coarse`
  first.assign(1, 0);
  for (const CoarseGhosts& part : parts) first.push_back(first.back() + part.cells.size() * bytes);
  if (coarse.size() < first.back()) coarse.resize(first.back());
  for (const GhostCopy& copy : plan.into[place]) {
    if (isHere(copy) && copy.coarse < 0) continue;  // is there already
    const CellValues to = copy.coarse < 0 ? targetOf(values, copy)
                                          : CellValues{coarse.data() + first[copy.coarse], parts[copy.coarse].cells};
    if (isHere(copy))
      copyGridTo(fill, copy, values, to);
    else
      isNear(fill) ? messages->takeNear(copy, bytes, to) : messages->takeGrid(copy, bytes, to);
  }
}

void Exchange::fillFromElsewhere(const BoundGhostFill& fill, bool resolves, ReceivedMessages& messages) {
  if (resolves) placeGhostCopies(fill, &messages);
  if (fill.particles) reserveCopies(fill);
  const GhostPlan& plan = planOf(fill);
  const std::vector<Patch>& patches = warehouse_->grid().patches();
  for (std::size_t place = 0; place < patches.size(); ++place)
    if (fill.particles)
      fillCopies(fill, patches[place], &messages);
    else if (!plan.isLocal[place] && !jointOf(fill))
      fillFromCoarser(fill, place, &messages);
    else if (const JointFill* joint = jointOf(fill); joint && !isLocal(*joint, place))
      gatherCoarse(fill, place, &messages, of_coarser_[&fill - fills_.data()][place]);
}

void Exchange::shareFaces(int variable, Generation set) {
  const std::vector<Patch>& patches = warehouse_->grid().patches();
  if (patches.size() < 2) return;
  if (faces_.empty()) faces_ = planFaces(warehouse_->grid());
  const BoundGhostFill fill{variable, Generation::fresh, set, false};
  if (isNear(fill)) near_.settle(set, warehouse_->table()[variable].material);
  threads_->forEach(static_cast<int>(patches.size()), [&](int place) {
    const FilledValues values(*warehouse_, fill);
    for (const GhostCopy& copy : faces_[place]) copyGrid(fill, copy, values);
  });
}

/// Links the sets of all patches to the particles around them that belong to other patches of this rank.
void Exchange::linkLocalGhosts(const BoundGhostFill& fill) {
  const int material = warehouse_->table()[fill.variable].material;
  const std::vector<Patch>& patches = warehouse_->grid().patches();
  const int first = warehouse_->grid().firstPatch();
  std::vector<char> hasSome;  // by place: most patches may be empty, and their neighbours need not visit their sets
  for (const Patch& patch : patches)
    hasSome.push_back(warehouse_->particles(fill.set, material, patch.id()).owned() > 0);
  const GhostPlan& plan = planOf(fill);
  const auto forEachCopy = [&](int place, const auto& visit) {
    for (const GhostCopy& copy : plan.into[place])
      if (isHere(copy) && hasSome[copy.from - first] && copy.shift == Index3{})
        visit(copy, warehouse_->particles(fill.set, material, copy.from));
  };
  const auto setOf = [&](int place) -> ParticleSet& {
    return warehouse_->particles(fill.set, material, patches[place].id());
  };
  const auto open = [&](int place) {
    forEachCopy(place,
                [&](const GhostCopy& copy, const ParticleSet& from) { setOf(place).openGhostRows(copy.box, from); });
  };
  const auto link = [&](int place) {
    const trace::Span span(trace::Kind::message, "link ghosts", patches[place].id());
    forEachCopy(place, [&](const GhostCopy& copy, const ParticleSet& from) {
      setOf(place).addGhosts(copy.box, from, warehouse_->distance(fill.set, material, patches[place].id(), copy.from));
    });
    setOf(place).markGhosts();
  };
  const int count = static_cast<int>(patches.size());
  if (threads_->count() > 1) threads_->forEach(count, open, trace::Kind::message);
  threads_->forEach(count, link, trace::Kind::message);
}

/// Assigns indices to copies of ghosts: of periodic images on this rank, and of particles from other ranks.
void Exchange::placeGhostCopies(const BoundGhostFill& fill, ReceivedMessages* messages) {
  if (!messages && !warehouse_->grid().level().isPeriodic()) return;
  const int material = warehouse_->table()[fill.variable].material;
  const std::vector<Patch>& patches = warehouse_->grid().patches();
  for (std::size_t place = 0; place < patches.size(); ++place) {
    ParticleSet& set = warehouse_->particles(fill.set, material, patches[place].id());
    for (const GhostCopy& copy : planOf(fill).into[place]) {
      if (isHere(copy) ? messages || copy.shift == Index3{} : !messages) continue;
      const auto add = [&](const Index3& cell, const ParticleRange& range) {
        set.addCopies(cell, copy.from, range, copy.shift,
                      warehouse_->placeCopies(fill.set, material, patches[place].id(), range.size()));
      };
      if (messages) {
        for (const auto& [cell, range] : messages->takeCounts(copy)) add(cell, range);
        continue;
      }
      const ParticleSet& from = warehouse_->particles(fill.set, material, copy.from);  // may be the same set
      set.openGhostRows(copy.box, from, copy.shift);
      from.forEachOccupied<3>(copy.box.shifted(Index3{} - copy.shift),
                              [&](const Index3& cell, const ParticleRange& range) { add(cell + copy.shift, range); });
    }
  }
}

void Exchange::reserveCopies(const BoundGhostFill& fill) {
  warehouse_->reserveCopies(fill.generation, fill.variable, fill.set);
}

/// Fills a patch's copies of particles: from this rank, or from the messages of others.
void Exchange::fillCopies(const BoundGhostFill& fill, const Patch& patch, ReceivedMessages* messages) {
  const auto [label, material] = warehouse_->table()[fill.variable];
  const std::vector<data::GhostRun>& runs = warehouse_->particles(fill.set, material, patch.id()).ghostRuns();
  if (runs.empty()) return;
  const grid::Grid& grid = warehouse_->grid();
  const FilledValues values(*warehouse_, fill);
  const std::size_t bytes = label->bytes;
  const bool shifts = label->name == data::positionName;
  std::byte* const here = values.on(patch.id()).values;
  const auto original = [&](const data::GhostRun& run) { return values.on(run.patch).values + run.first * bytes; };
  constexpr std::size_t ahead = 12;  // short runs are far from one another in memory
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const data::GhostRun& run = runs[k];
    if (grid.isMine(run.patch) == (messages != nullptr)) continue;
    if (!messages && k + ahead < runs.size() && grid.isMine(runs[k + ahead].patch))
      prefetch(original(runs[k + ahead]), runs[k + ahead].count * bytes);
    const std::size_t length = run.count * bytes;
    const std::byte* from = messages ? messages->next(grid.ownerOf(run.patch), length) : original(run);
    std::byte* to = here + run.to * static_cast<std::ptrdiff_t>(bytes);
    std::memcpy(to, from, length);
    if (shifts && !(run.shift == Index3{}))
      shiftPositions(patch.level(), run.shift, reinterpret_cast<double*>(to), run.count);
  }
}

}  // namespace tushar::tasks
