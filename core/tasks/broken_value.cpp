#include "core/tasks/broken_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tushar::tasks {

using data::Bound;
using data::Centring;
using data::Generation;
using data::Label;
using data::ParticleSet;
using data::Variable;
using data::Warehouse;
using grid::Box;
using grid::Level;
using grid::Patch;

namespace {

const double* numbersOf(const Variable& variable) { return reinterpret_cast<const double*>(variable.values.data()); }

Box boxOf(const Label& label, const Patch& patch) {
  return label.centring == Centring::node ? patch.nodes() : patch.cells();
}

bool keepsBound(Warehouse& warehouse, const Bounded& written, const Patch& patch) {
  const auto [label, material] = warehouse.table()[written.variable];
  const Variable& variable = warehouse.variable(Generation::fresh, written.variable, patch.id());
  const auto components = static_cast<std::size_t>(label->components);
  if (label->centring == Centring::particle) {
    const int owned = warehouse.particles(written.set, material, patch.id()).owned();
    return holds(label->bound, numbersOf(variable), static_cast<std::size_t>(owned) * components);
  }
  const Box box = boxOf(*label, patch);
  Box rows = box;
  rows.upper[0] = rows.lower[0] + 1;
  bool kept = true;
  grid::forEach<3>(rows, [&](const Index3& first) {
    kept = kept && holds(label->bound, numbersOf(variable) + variable.stored.offset(first) * components,
                         static_cast<std::size_t>(box.extent(0)) * components);
  });
  return kept;
}

/// `0.3`, or `(0.3, 0.1)`.
std::string textOf(const double* numbers, int count) {
  std::string text;
  for (int k = 0; k < count; ++k)
    text += (k ? ", " : "") + (std::isnan(numbers[k]) ? std::string("nan") : fmt::format("{:.6g}", numbers[k]));
  return count == 1 ? text : "(" + text + ")";
}

/// Looks through a variable for broken values, on all patches.
class Search {
 public:
  Search(Warehouse& warehouse, const Bounded& written, Bound bound)
      : warehouse_(warehouse),
        level_(warehouse.level()),
        written_(written),
        bound_(bound),
        label_(*warehouse.table()[written.variable].label),
        material_(warehouse.table()[written.variable].material) {}

  std::optional<BrokenValue> run() {
    for (const Patch& patch : level_.patches()) isParticle() ? lookAtParticles(patch) : lookAtGrid(patch);
    if (broken_ == 0) return std::nullopt;
    return BrokenValue{std::string(label_.name), patch_, isParticle() ? particleSentence() : gridSentence()};
  }

 private:
  bool isParticle() const { return label_.centring == Centring::particle; }

  const double* numbers(Generation generation, int patch, std::size_t place) {
    return numbersOf(warehouse_.variable(generation, written_.variable, patch)) +
           place * static_cast<std::size_t>(label_.components);
  }
  const ParticleSet& set(Generation generation, int patch) {
    return warehouse_.particles(generation, material_, patch);
  }
  const ParticleId* ids(Generation generation, int patch) {
    const int number = warehouse_.table().find(data::particleId.name, material_);
    return reinterpret_cast<const ParticleId*>(warehouse_.variable(generation, number, patch).values.data());
  }
  std::size_t gridPlace(int patch, const Index3& at) {
    return warehouse_.variable(Generation::fresh, written_.variable, patch).stored.offset(at);
  }
  /// The patch that a cell, or the node at its lower corner, belongs to.
  const Patch& ownerOf(Index3 at) const {
    for (int d = 0; d < 3; ++d) at[d] = std::min(at[d], level_.cells().upper[d] - 1);
    return level_.patchOf(at);
  }
  Box gridBox() const { return label_.centring == Centring::node ? level_.nodes() : level_.cells(); }

  /// Counts a value, and remembers it if it is broken and comes before those seen so far.
  void look(const double* values, const std::pair<std::uint64_t, ParticleId>& order, int patch, const Index3& at,
            std::size_t place) {
    ++seen_;
    if (holds(bound_, values, static_cast<std::size_t>(label_.components))) return;
    if (++broken_ > 1 && first_ < order) return;
    first_ = order;
    patch_ = patch;
    at_ = at;
    place_ = place;
  }
  void lookAtParticles(const Patch& patch) {
    grid::forEach<3>(patch.cells(), [&](const Index3& cell) {
      for (const int p : set(written_.set, patch.id()).in(cell)) {
        const auto place = static_cast<std::size_t>(p);
        look(numbers(Generation::fresh, patch.id(), place),
             {level_.cellNumber(cell), ids(written_.set, patch.id())[p]}, patch.id(), cell, place);
      }
    });
  }
  void lookAtGrid(const Patch& patch) {
    const Box all = gridBox();
    grid::forEach<3>(boxOf(label_, patch), [&](const Index3& at) {
      if (ownerOf(at).id() != patch.id()) return;
      const std::size_t place = gridPlace(patch.id(), at);
      look(numbers(Generation::fresh, patch.id(), place), {all.offset(at), 0}, patch.id(), at, place);
    });
  }

  std::string became(const double* before) {
    std::string text =
        fmt::format("{} became {} {}", label_.name,
                    textOf(numbers(Generation::fresh, patch_, place_), label_.components), label_.unit);
    if (before) text += fmt::format(" from {}", textOf(before, label_.components));
    return text + fmt::format(", but must be {}", data::textOf(bound_));
  }
  std::string howMany(const char* what) const {
    return broken_ == 1 ? fmt::format("no other of {} {} is broken", seen_, what)
                        : fmt::format("{} of {} {} are broken", broken_, seen_, what);
  }

  /// The value that the particle had at the start of the step; none for one that is new.
  const double* before(ParticleId id) {
    if (!warehouse_.variable(Generation::old, written_.variable, 0).held) return nullptr;
    for (const Patch& patch : level_.patches())
      for (int p = 0; p < set(Generation::old, patch.id()).owned(); ++p)
        if (ids(Generation::old, patch.id())[p] == id)
          return numbers(Generation::old, patch.id(), static_cast<std::size_t>(p));
    return nullptr;
  }
  std::string positionOfParticle() {
    const int number = warehouse_.table().find("p.x", material_);
    if (number < 0 || !warehouse_.variable(written_.set, number, patch_).held) return "";
    const double* x = numbersOf(warehouse_.variable(written_.set, number, patch_)) +
                      place_ * static_cast<std::size_t>(level_.dimension());
    return fmt::format(" at x = {} m", textOf(x, level_.dimension()));
  }
  /// The values in a cell but that of the particle itself, at most four.
  std::string valuesIn(const Index3& cell) {
    const int patch = level_.patchOf(cell).id();
    std::string text;
    int count = 0;
    for (const int p : set(written_.set, patch).in(cell)) {
      const auto place = static_cast<std::size_t>(p);
      if (patch == patch_ && place == place_) continue;
      if (++count <= 4)
        text += (count > 1 ? ", " : "") + textOf(numbers(Generation::fresh, patch, place), label_.components);
    }
    if (count > 4) text += fmt::format(", ... ({} particles)", count);
    return count == 0 ? "none" : text;
  }
  std::string particleSentence() {
    std::string text = fmt::format("{}: particle {} in {}{}; around it: {} in its cell", became(before(first_.second)),
                                   first_.second, nameOf(level_, at_), positionOfParticle(), valuesIn(at_));
    for (int d = 0; d < level_.dimension(); ++d)
      for (const int side : {-1, 1}) {
        Index3 cell = at_;
        cell[d] += side;
        if (level_.cells().contains(cell)) text += fmt::format(", {} in {}", valuesIn(cell), nameOf(level_, cell));
      }
    return text + "; " + howMany("particles");
  }

  std::string gridSentence() {
    const bool nodes = label_.centring == Centring::node;
    const char* what = nodes ? "node" : "cell";
    const double* old = warehouse_.variable(Generation::old, written_.variable, patch_).held
                            ? numbers(Generation::old, patch_, place_)
                            : nullptr;
    std::array<double, 3> x{};
    for (int d = 0; d < level_.dimension(); ++d)
      x[static_cast<std::size_t>(d)] = level_.nodePosition(d, at_[d]) + (nodes ? 0 : 0.5 * level_.spacing(d));
    std::string text = fmt::format("{}: {} at x = {} m; around it:", became(old), nameOf(level_, at_, what),
                                   textOf(x.data(), level_.dimension()));
    for (int d = 0; d < level_.dimension(); ++d)
      for (const int side : {-1, 1}) {
        Index3 at = at_;
        at[d] += side;
        if (!gridBox().contains(at)) continue;
        const int patch = ownerOf(at).id();
        text += fmt::format(" {} in {},", textOf(numbers(Generation::fresh, patch, gridPlace(patch, at)), label_.components),
                            nameOf(level_, at, what));
      }
    text.back() = ';';
    return text + " " + howMany(nodes ? "nodes" : "cells");
  }

  Warehouse& warehouse_;
  const Level& level_;
  Bounded written_;
  Bound bound_;
  const Label& label_;
  int material_;
  long seen_ = 0, broken_ = 0;
  std::pair<std::uint64_t, ParticleId> first_;  ///< number of cell or node, and id, of the first broken value
  int patch_ = 0;
  Index3 at_;
  std::size_t place_ = 0;
};

}  // namespace

bool keepsBounds(Warehouse& warehouse, const std::vector<Bounded>& written, const Patch& patch) {
  bool kept = true;
  for (const Bounded& variable : written) kept = kept && keepsBound(warehouse, variable, patch);
  return kept;
}

std::optional<BrokenValue> firstBroken(Warehouse& warehouse, const Bounded& written, Bound bound) {
  return Search(warehouse, written, bound).run();
}

std::optional<BrokenValue> firstBroken(Warehouse& warehouse, const std::vector<Bounded>& written) {
  for (const Bounded& variable : written) {
    const Bound bound = warehouse.table()[variable.variable].label->bound;
    if (auto broken = firstBroken(warehouse, variable, bound)) return broken;
  }
  return std::nullopt;
}

std::string nameOf(const Level& level, const Index3& at, const char* what) {
  std::string text;
  for (int d = 0; d < level.dimension(); ++d) text += fmt::format("{}{}", d ? ", " : "", at[d]);
  return fmt::format("{} ({})", what, text);
}

}  // namespace tushar::tasks
