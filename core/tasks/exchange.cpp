#include "core/tasks/exchange.hpp"

#include <algorithm>
#include <cstring>
#include <set>

namespace tushar::tasks {

using data::Generation;
using data::ParticleRange;
using data::ParticleSet;
using data::Variable;
using data::Warehouse;
using grid::Box;
using grid::Patch;
using mpi::Bytes;

namespace {

/// Calls `visit(first, length)` for each row of a box along the first axis.
template <class Visit>
void forEachRow(const Box& box, std::size_t bytes, Visit&& visit) {
  const std::size_t length = static_cast<std::size_t>(box.extent(0)) * bytes;
  grid::forEach<3>(box.rowStarts(), [&](const Index3& first) { visit(first, length); });
}

template <class Values>
std::byte* at(const Values& values, const Index3& place, std::size_t bytes) {
  return values.values + values.stored.offset(place) * bytes;
}

/// Moves positions to the image where they are ghosts.
void shiftPositions(const grid::Level& level, const Index3& shift, double* x, int count) {
  const int dimension = level.dimension();
  for (int d = 0; d < dimension; ++d) {
    const double by = shift[d] / level.cells().upper[d] * level.period(d);
    for (int k = 0; by != 0 && k < count; ++k) x[k * dimension + d] += by;
  }
}

/// The values of a copy that are means, one after the other.
void means(const grid::Grid& grid, const data::Label& label, const GhostCopy& copy, const Variable& from,
           std::byte* to) {
  if (copy.rim >= 0)
    return meanFluxes(grid, copy, label.components, reinterpret_cast<const double*>(from.values),
                      reinterpret_cast<double*>(to));
  restrictTo(label, grid.dimension(), copy.box.shifted(Index3{} - copy.shift), {from.values, from.stored}, to);
}

/// Appends to a message the values that another rank receives for one ghost fill.
class Packer {
 public:
  Packer(Warehouse& warehouse, const BoundGhostFill& fill, Bytes& message)
      : warehouse_(warehouse), fill_(fill), name_(warehouse.table()[fill.variable]), message_(message) {}

  void addGrid(const GhostCopy& copy) {
    const Variable from = variable(copy.from);
    if (copy.isMean) {  // in a message values stand at any byte: numbers are made elsewhere
      Bytes values(copy.box.size() * name_.label->bytes);
      means(warehouse_.grid(), *name_.label, copy, from, values.data());
      return mpi::append(message_, values.data(), values.size());
    }
    forEachRow(copy.box.shifted(Index3{} - copy.shift), name_.label->bytes,
               [&](const Index3& first, std::size_t length) {
                 mpi::append(message_, at(from, first, name_.label->bytes), length);
               });
  }
  /// How many particles each cell has.
  void addCounts(const GhostCopy& copy) {
    forEachCell(copy, [&](const ParticleRange& range) {
      const std::int32_t count = range.size();
      mpi::append(message_, &count, sizeof(count));
    });
  }
  void addParticles(const GhostCopy& copy) {
    const Variable from = variable(copy.from);
    forEachCell(copy, [&](const ParticleRange& range) {
      mpi::append(message_, from.values + static_cast<std::size_t>(range.first) * name_.label->bytes,
                  static_cast<std::size_t>(range.size()) * name_.label->bytes);
    });
  }

 private:
  Variable variable(int patch) { return warehouse_.variable(fill_.generation, fill_.variable, patch); }
  template <class Visit>
  void forEachCell(const GhostCopy& copy, Visit&& visit) {
    const ParticleSet& set = warehouse_.particles(fill_.set, name_.material, copy.from);
    grid::forEach<3>(copy.box.shifted(Index3{} - copy.shift), [&](const Index3& cell) { visit(set.in(cell)); });
  }

  Warehouse& warehouse_;
  const BoundGhostFill& fill_;
  const data::VariableName name_;
  Bytes& message_;
};

}  // namespace

/// The messages of the other ranks, read from front to back.
class Exchange::ReceivedMessages {
 public:
  void add(int from, Bytes bytes) { messages_[from] = {std::move(bytes), 0}; }
  /// The next `length` bytes of the message from a rank.
  const std::byte* next(int from, std::size_t length) {
    Message& message = messages_.at(from);
    const std::byte* here = message.bytes.data() + message.read;
    message.read += length;
    return here;
  }
  /// Particles of the next cell, of which the first stands at `place`.
  ParticleRange nextRange(int from, int place) {
    std::int32_t count = 0;
    std::memcpy(&count, next(from, sizeof(count)), sizeof(count));
    return {place, place + count};
  }
  /// Whether a rank says that it has stopped.
  bool readStopped(int from) { return *next(from, 1) != std::byte{0}; }

 private:
  struct Message {
    Bytes bytes;
    std::size_t read = 0;
  };
  std::map<int, Message> messages_;
};

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
  noteUnresolved();
  if (!warehouse_->ranks().isAlone()) threads_->alone([&] { post(hasStopped); }, trace::Kind::message, "send");
}

void Exchange::begin(bool hasStopped) {
  has_stopped_ = hasStopped;
  senders_.clear();
  if (movesNothing()) return;
  for (const BoundGhostFill& fill : fills_) {
    const std::set<int>& incoming = planOf(fill).incoming;
    senders_.insert(incoming.begin(), incoming.end());
  }
  if (!hasStopped) fillFromHere();
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
    const auto at = static_cast<std::size_t>(place);
    const trace::Span span(trace::Kind::message, "fill ghosts", patches[at].id());
    for (std::size_t k = 0; k < fills_.size(); ++k) work(fills_[k], resolves_[k], patches[at], at);
  };
  threads_->forEach(static_cast<int>(patches.size()), workOn, trace::Kind::message);
}

/// Ghosts of patches of this rank are settled by all patches at once; copies then get their places one after the other.
void Exchange::fillFromHere() {
  if (std::find(resolves_.begin(), resolves_.end(), true) != resolves_.end())
    forEach([&](const BoundGhostFill& fill, bool resolves, const Patch& patch, std::size_t place) {
      if (resolves) linkLocalGhosts(fill, patch, planOf(fill).into[place]);
    });
  for (std::size_t k = 0; k < fills_.size(); ++k)
    if (resolves_[k]) placeGhostCopies(fills_[k], nullptr);
  for (const BoundGhostFill& fill : fills_)
    if (fill.particles) reserveCopies(fill);
  forEach([&](const BoundGhostFill& fill, bool, const Patch& patch, std::size_t place) {
    if (fill.particles) return fillCopies(fill, patch, nullptr);
    for (const GhostCopy& copy : planOf(fill).into[place])
      if (isHere(copy) && copy.coarse < 0) copyGrid(fill, copy);
    if (planOf(fill).isLocal[place]) fillFromCoarser(fill, place, nullptr);
  });
}

/// All patches of all ranks have settled a set, or none: what a stopped graph has settled is forgotten.
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
      Packer packer(*warehouse_, fills_[k], message);
      if (resolves_[k])
        for (const GhostCopy& copy : copies->second) packer.addCounts(copy);
      for (const GhostCopy& copy : copies->second)
        fills_[k].particles ? packer.addParticles(copy) : packer.addGrid(copy);
    }
    outbox_.send(rank, mpi::Tag::ghosts, std::move(message));
  }
}

void Exchange::copyGrid(const BoundGhostFill& fill, const GhostCopy& copy) {
  copyGridTo(fill, copy, valuesAt(fill, copy));
}

/// Where a copy goes: to the patch, or to the faces of its rim for what stands behind them.
CellValues Exchange::valuesAt(const BoundGhostFill& fill, const GhostCopy& copy) {
  const Variable to = warehouse_->variable(fill.generation, fill.variable, copy.to);
  if (copy.rim < 0) return {to.values, to.stored};
  const grid::RimPiece& piece = warehouse_->grid().rims(copy.to)[static_cast<std::size_t>(copy.rim)];
  const std::size_t bytes = warehouse_->table()[fill.variable].label->bytes;
  return {to.values + (piece.first + piece.cells.size()) * bytes, piece.cells};
}

void Exchange::copyGridTo(const BoundGhostFill& fill, const GhostCopy& copy, const CellValues& to) {
  const data::Label& label = *warehouse_->table()[fill.variable].label;
  const Variable from = warehouse_->variable(fill.generation, fill.variable, copy.from);
  if (!copy.isMean)
    return forEachRow(copy.box, label.bytes, [&](const Index3& first, std::size_t length) {
      std::memcpy(at(to, first, label.bytes), at(from, first - copy.shift, label.bytes), length);
    });
  Bytes values(copy.box.size() * label.bytes);
  means(warehouse_->grid(), label, copy, from, values.data());
  const std::byte* next = values.data();
  forEachRow(copy.box, label.bytes, [&](const Index3& first, std::size_t length) {
    std::memcpy(at(to, first, label.bytes), next, length);
    next += length;
  });
}

/// Ghosts in coarser cells, once these are complete. With messages, all that the patch has of other ranks.
void Exchange::fillFromCoarser(const BoundGhostFill& fill, std::size_t place, ReceivedMessages* messages) {
  const GhostPlan& plan = planOf(fill);
  const data::Label& label = *warehouse_->table()[fill.variable].label;
  const Variable own = warehouse_->variable(fill.generation, fill.variable, warehouse_->grid().patches()[place].id());
  std::vector<Bytes> coarse;
  for (const CoarseGhosts& part : plan.coarse[place]) coarse.emplace_back(part.cells.size() * label.bytes);
  for (const GhostCopy& copy : plan.into[place]) {
    if (isHere(copy) && copy.coarse < 0) continue;  // is there already
    const CellValues to = copy.coarse < 0
                              ? valuesAt(fill, copy)
                              : CellValues{coarse[copy.coarse].data(), plan.coarse[place][copy.coarse].cells};
    isHere(copy) ? copyGridTo(fill, copy, to) : takeGrid(fill, copy, to, *messages);
  }
  for (std::size_t k = 0; k < coarse.size(); ++k) {
    const CoarseGhosts& part = plan.coarse[place][k];
    prolong(label, warehouse_->grid().dimension(), {coarse[k].data(), part.cells}, part.ghosts,
            {own.values, own.stored});
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
    else if (!plan.isLocal[place])
      fillFromCoarser(fill, place, &messages);
}

void Exchange::shareFaces(int variable) {
  const std::vector<Patch>& patches = warehouse_->grid().patches();
  if (patches.size() < 2) return;
  if (faces_.empty()) faces_ = planFaces(warehouse_->grid());
  const BoundGhostFill fill{variable, Generation::fresh, Generation::fresh, false};
  threads_->forEach(static_cast<int>(patches.size()), [&](int place) {
    for (const GhostCopy& copy : faces_[place]) copyGrid(fill, copy);
  });
}

void Exchange::takeGrid(const BoundGhostFill& fill, const GhostCopy& copy, const CellValues& to,
                        ReceivedMessages& messages) {
  const std::size_t bytes = warehouse_->table()[fill.variable].label->bytes;
  forEachRow(copy.box, bytes, [&](const Index3& first, std::size_t length) {
    std::memcpy(at(to, first, bytes), messages.next(copy.rank, length), length);
  });
}

/// The set of a patch has the particles around it that other patches of this rank have.
void Exchange::linkLocalGhosts(const BoundGhostFill& fill, const Patch& patch, const std::vector<GhostCopy>& copies) {
  const int material = warehouse_->table()[fill.variable].material;
  ParticleSet& set = warehouse_->particles(fill.set, material, patch.id());
  for (const GhostCopy& copy : copies)
    if (isHere(copy) && copy.shift == Index3{})
      set.addGhosts(copy.box, warehouse_->particles(fill.set, material, copy.from),
                    warehouse_->distance(fill.set, material, patch.id(), copy.from));
  set.markGhosts();
}

/// Copies of ghosts have their places: of periodic images on this rank, or of what other ranks have sent.
void Exchange::placeGhostCopies(const BoundGhostFill& fill, ReceivedMessages* messages) {
  const int material = warehouse_->table()[fill.variable].material;
  const std::vector<Patch>& patches = warehouse_->grid().patches();
  for (std::size_t place = 0; place < patches.size(); ++place) {
    ParticleSet& set = warehouse_->particles(fill.set, material, patches[place].id());
    for (const GhostCopy& copy : planOf(fill).into[place]) {
      if (isHere(copy) ? messages || copy.shift == Index3{} : !messages) continue;
      int there = 0;  // place in the message, among those of this copy
      grid::forEach<3>(copy.box, [&](const Index3& cell) {
        const ParticleRange range = messages
                                        ? messages->nextRange(copy.rank, there)
                                        : warehouse_->particles(fill.set, material, copy.from).in(cell - copy.shift);
        there = range.last;
        if (range.empty()) return;
        set.addCopies(cell, copy.from, range, copy.shift,
                      warehouse_->placeCopies(fill.set, material, patches[place].id(), range.size()));
      });
    }
  }
}

void Exchange::reserveCopies(const BoundGhostFill& fill) {
  warehouse_->reserveCopies(fill.generation, fill.variable, fill.set);
}

/// The copies that a patch has of particles of this rank, or of others from their messages.
void Exchange::fillCopies(const BoundGhostFill& fill, const Patch& patch, ReceivedMessages* messages) {
  const auto [label, material] = warehouse_->table()[fill.variable];
  const grid::Grid& grid = warehouse_->grid();
  const Variable here = warehouse_->variable(fill.generation, fill.variable, patch.id());
  for (const data::GhostRun& run : warehouse_->particles(fill.set, material, patch.id()).ghostRuns()) {
    if (grid.isMine(run.patch) == (messages != nullptr)) continue;
    const std::size_t length = static_cast<std::size_t>(run.count) * label->bytes;
    const std::byte* from = messages ? messages->next(grid.ownerOf(run.patch), length)
                                     : warehouse_->variable(fill.generation, fill.variable, run.patch).values +
                                           static_cast<std::size_t>(run.first) * label->bytes;
    std::byte* to = here.values + static_cast<std::size_t>(run.to) * label->bytes;
    std::memcpy(to, from, length);
    if (label->name == data::positionName && !(run.shift == Index3{}))
      shiftPositions(patch.level(), run.shift, reinterpret_cast<double*>(to), run.count);
  }
}

}  // namespace tushar::tasks
