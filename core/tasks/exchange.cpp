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

std::byte* at(Variable& variable, const Index3& place, std::size_t bytes) {
  return variable.values.data() + variable.stored.offset(place) * bytes;
}

/// Moves positions to the image where they are ghosts.
void shiftPositions(const grid::Level& level, const Index3& shift, double* x, int count) {
  const int dimension = level.dimension();
  for (int d = 0; d < dimension; ++d) {
    const double by = shift[d] / level.cells().upper[d] * level.period(d);
    for (int k = 0; by != 0 && k < count; ++k) x[k * dimension + d] += by;
  }
}

/// Adds what a rank is to have for one fill to the message for it.
class Packer {
 public:
  Packer(Warehouse& warehouse, const NumberedFill& fill, Bytes& message)
      : warehouse_(warehouse), fill_(fill), name_(warehouse.table()[fill.variable]), message_(message) {}

  void addGrid(const GhostCopy& copy) {
    Variable& from = variable(copy.from);
    forEachRow(copy.box.shifted(Index3{} - copy.shift), name_.label->bytes, [&](const Index3& first, std::size_t length) {
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
    Variable& from = variable(copy.from);
    forEachCell(copy, [&](const ParticleRange& range) {
      mpi::append(message_, from.values.data() + static_cast<std::size_t>(range.first) * name_.label->bytes,
             static_cast<std::size_t>(range.size()) * name_.label->bytes);
    });
  }

 private:
  Variable& variable(int patch) { return warehouse_.variable(fill_.generation, fill_.variable, patch); }
  template <class Visit>
  void forEachCell(const GhostCopy& copy, Visit&& visit) {
    const ParticleSet& set = warehouse_.particles(fill_.set, name_.material, copy.from);
    grid::forEach<3>(copy.box.shifted(Index3{} - copy.shift), [&](const Index3& cell) {
      visit(set.in(cell));
    });
  }

  Warehouse& warehouse_;
  const NumberedFill& fill_;
  const data::VariableName name_;
  Bytes& message_;
};

}  // namespace

/// The messages of the other ranks, read from front to back.
class Exchange::Letters {
 public:
  void add(int from, Bytes bytes) { letters_[from] = {std::move(bytes), 0}; }
  /// The next `length` bytes of the message from a rank.
  const std::byte* next(int from, std::size_t length) {
    Letter& letter = letters_.at(from);
    const std::byte* here = letter.bytes.data() + letter.read;
    letter.read += length;
    return here;
  }
  /// Whether a rank says that it has stopped.
  bool readStopped(int from) { return *next(from, 1) != std::byte{0}; }

 private:
  struct Letter {
    Bytes bytes;
    std::size_t read = 0;
  };
  std::map<int, Letter> letters_;
};

GhostReach reachOf(const data::VariableTable& table, const NumberedFill& fill) {
  const auto [label, material] = table[fill.variable];
  return {label->centring == data::Centring::node, fill.particles ? table.reach(material) : table.ghost(fill.variable)};
}

bool Exchange::movesNothing() const {
  return warehouse_->level().patchCount() == 1 && !warehouse_->level().isPeriodic();
}

void Exchange::send(std::span<const NumberedFill> fills, bool hasStopped) {
  fills_ = fills;
  if (movesNothing()) return;
  noteUnsettled();
  if (!warehouse_->ranks().isAlone())
    threads_->alone([&] { post(hasStopped); }, trace::Kind::message, "send");
}

void Exchange::begin(bool hasStopped) {
  has_stopped_ = hasStopped;
  senders_.clear();
  if (movesNothing()) return;
  for (const NumberedFill& fill : fills_) {
    const std::set<int>& incoming = planOf(fill).incoming;
    senders_.insert(incoming.begin(), incoming.end());
  }
  if (!hasStopped) fillFromHere();
}

bool Exchange::finish() {
  Letters letters;
  for (const int rank : senders_) {
    const trace::Span span(trace::Kind::wait, "receive");
    letters.add(rank, warehouse_->ranks().receive(rank, mpi::Tag::ghosts));
    has_stopped_ = letters.readStopped(rank) || has_stopped_;
  }
  outbox_.wait();
  const bool hasLetters = !senders_.empty();
  senders_.clear();
  if (has_stopped_ || !hasLetters) return !has_stopped_;
  const auto unpack = [&] {
    for (std::size_t k = 0; k < fills_.size(); ++k) fillFromElsewhere(fills_[k], settles_[k], letters);
  };
  threads_->alone(unpack, trace::Kind::message, "unpack");
  return true;
}

bool Exchange::isReady(std::size_t place) {
  return std::all_of(fills_.begin(), fills_.end(), [&](const NumberedFill& fill) { return planOf(fill).isClosed[place]; });
}

template <class Work>
void Exchange::forEach(const Work& work) {
  const std::vector<Patch>& patches = warehouse_->level().patches();
  const auto workOn = [&](int place) {
    const auto at = static_cast<std::size_t>(place);
    const trace::Span span(trace::Kind::message, "fill ghosts", patches[at].id());
    for (std::size_t k = 0; k < fills_.size(); ++k) work(fills_[k], settles_[k], patches[at], at);
  };
  threads_->forEach(static_cast<int>(patches.size()), workOn, trace::Kind::message);
}

/// A patch reads of others only what they own, and that stands still once all have made room.
void Exchange::fillFromHere() {
  forEach([&](const NumberedFill& fill, bool settles, const Patch& patch, std::size_t place) {
    if (!fill.particles || !planOf(fill).isClosed[place]) return;
    if (settles) settleGhosts(fill, patch, nullptr);
    makeRoom(fill, patch);
  });
  forEach([&](const NumberedFill& fill, bool, const Patch& patch, std::size_t place) {
    if (fill.particles && planOf(fill).isClosed[place]) return fillParticles(fill, patch, nullptr);
    if (fill.particles) return;
    for (const GhostCopy& copy : planOf(fill).into[place])
      if (copy.rank == warehouse_->ranks().rank()) copyGrid(fill, copy);
  });
}

/// All patches of all ranks have settled a set, or none: what a stopped graph has settled is forgotten.
void Exchange::noteUnsettled() {
  settles_.assign(fills_.size(), false);
  std::set<std::pair<Generation, int>> settled;
  for (std::size_t k = 0; k < fills_.size(); ++k) {
    const int material = warehouse_->table()[fills_[k].variable].material;
    if (!fills_[k].particles || warehouse_->level().patches().empty()) continue;
    const int patch = warehouse_->level().firstPatch();
    settles_[k] = !warehouse_->particles(fills_[k].set, material, patch).hasGhosts() &&
                  settled.emplace(fills_[k].set, material).second;
  }
}

void Exchange::post(bool hasStopped) {
  std::set<int> receivers;
  for (const NumberedFill& fill : fills_)
    for (const auto& copies : planOf(fill).outgoing) receivers.insert(copies.first);
  for (const int rank : receivers) {
    Bytes message = outbox_.buffer();
    message.push_back(std::byte{hasStopped});
    for (std::size_t k = 0; k < fills_.size() && !hasStopped; ++k) {
      const auto copies = planOf(fills_[k]).outgoing.find(rank);
      if (copies == planOf(fills_[k]).outgoing.end()) continue;
      Packer packer(*warehouse_, fills_[k], message);
      if (settles_[k])
        for (const GhostCopy& copy : copies->second) packer.addCounts(copy);
      for (const GhostCopy& copy : copies->second) fills_[k].particles ? packer.addParticles(copy) : packer.addGrid(copy);
    }
    outbox_.send(rank, mpi::Tag::ghosts, std::move(message));
  }
}

void Exchange::copyGrid(const NumberedFill& fill, const GhostCopy& copy) {
  const std::size_t bytes = warehouse_->table()[fill.variable].label->bytes;
  Variable& from = warehouse_->variable(fill.generation, fill.variable, copy.from);
  Variable& to = warehouse_->variable(fill.generation, fill.variable, copy.to);
  forEachRow(copy.box, bytes, [&](const Index3& first, std::size_t length) {
    std::memcpy(at(to, first, bytes), at(from, first - copy.shift, bytes), length);
  });
}

void Exchange::fillFromElsewhere(const NumberedFill& fill, bool settles, Letters& letters) {
  const GhostPlan& plan = planOf(fill);
  const std::vector<Patch>& patches = warehouse_->level().patches();
  const std::size_t bytes = warehouse_->table()[fill.variable].label->bytes;
  for (std::size_t place = 0; place < patches.size(); ++place) {
    if (plan.isClosed[place]) continue;
    if (fill.particles && settles) settleGhosts(fill, patches[place], &letters);
    if (fill.particles) makeRoom(fill, patches[place]);
  }
  for (std::size_t place = 0; place < patches.size(); ++place) {
    if (plan.isClosed[place]) continue;
    if (fill.particles) {
      fillParticles(fill, patches[place], &letters);
      continue;
    }
    for (const GhostCopy& copy : plan.into[place]) {
      if (copy.rank == warehouse_->ranks().rank()) continue;
      Variable& to = warehouse_->variable(fill.generation, fill.variable, copy.to);
      forEachRow(copy.box, bytes, [&](const Index3& first, std::size_t length) {
        std::memcpy(at(to, first, bytes), letters.next(copy.rank, length), length);
      });
    }
  }
}

/// Appends the particles of the cells around the patch to its set.
void Exchange::settleGhosts(const NumberedFill& fill, const Patch& patch, Letters* letters) {
  const int material = warehouse_->table()[fill.variable].material;
  ParticleSet& set = warehouse_->particles(fill.set, material, patch.id());
  const auto place = static_cast<std::size_t>(patch.id() - warehouse_->level().firstPatch());
  for (const GhostCopy& copy : planOf(fill).into[place]) {
    if (copy.rank == warehouse_->ranks().rank()) {
      const ParticleSet& theirs = warehouse_->particles(fill.set, material, copy.from);
      grid::forEach<3>(copy.box, [&](const Index3& cell) {
        set.addGhostCell(cell, copy.from, theirs.in(cell - copy.shift), copy.shift);
      });
      continue;
    }
    int there = 0;  // place in the message, among those of this copy
    grid::forEach<3>(copy.box, [&](const Index3& cell) {
      std::int32_t count = 0;
      std::memcpy(&count, letters->next(copy.rank, sizeof(count)), sizeof(count));
      set.addGhostCell(cell, copy.from, {there, there + count}, copy.shift);
      there += count;
    });
  }
  set.markGhosts();
}

void Exchange::makeRoom(const NumberedFill& fill, const Patch& patch) {
  const auto [label, material] = warehouse_->table()[fill.variable];
  const ParticleSet& set = warehouse_->particles(fill.set, material, patch.id());
  Variable& here = warehouse_->variable(fill.generation, fill.variable, patch.id());
  warehouse_->allocateParticles(here, *label, set.total(), set.owned());
}

void Exchange::fillParticles(const NumberedFill& fill, const Patch& patch, Letters* letters) {
  const auto [label, material] = warehouse_->table()[fill.variable];
  const grid::Level& level = warehouse_->level();
  const ParticleSet& set = warehouse_->particles(fill.set, material, patch.id());
  Variable& here = warehouse_->variable(fill.generation, fill.variable, patch.id());
  std::byte* to = here.values.data() + static_cast<std::size_t>(set.owned()) * label->bytes;
  for (const data::GhostRun& run : set.ghostRuns()) {
    const std::size_t length = static_cast<std::size_t>(run.count) * label->bytes;
    const std::byte* from = nullptr;
    if (level.isMine(run.patch))
      from = warehouse_->variable(fill.generation, fill.variable, run.patch).values.data() +
             static_cast<std::size_t>(run.first) * label->bytes;
    else
      from = letters->next(level.ownerOf(run.patch), length);
    std::memcpy(to, from, length);
    if (label->name == data::positionName && !(run.shift == Index3{}))
      shiftPositions(level, run.shift, reinterpret_cast<double*>(to), run.count);
    to += length;
  }
}

}  // namespace tushar::tasks
