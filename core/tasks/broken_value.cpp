#include "core/tasks/broken_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/mpi.hpp"
#include "core/data/bound_rows.hpp"

namespace tushar::tasks {

using data::Bound;
using data::Centring;
using data::Generation;
using data::Label;
using data::ParticleSet;
using data::Variable;
using data::Warehouse;
using grid::Box;
using grid::Grid;
using grid::Level;
using grid::Patch;

namespace {

const double* numbersOf(const Variable& variable) { return reinterpret_cast<const double*>(variable.values); }

bool keepsBound(Warehouse& warehouse, const Bounded& written, const Patch& patch) {
  const auto [label, material] = warehouse.table()[written.variable];
  const Variable variable = warehouse.variable(Generation::fresh, written.variable, patch.id());
  const std::size_t components = label->components;
  if (label->centring == Centring::particle) {
    const int owned = warehouse.particles(written.set, material, patch.id()).owned();
    return holds(label->bound, numbersOf(variable), static_cast<std::size_t>(owned) * components);
  }
  const Box box = ownBox(patch, *label);
  if (box.empty()) return true;
  const auto stride = static_cast<std::ptrdiff_t>(variable.stored.extent(0)) * label->components;
  bool kept = true;
  for (Index3 first = box.lower; first[2] < box.upper[2]; ++first[2])
    kept = kept && holds(label->bound, {numbersOf(variable) + variable.stored.offset(first) * components,
                                        static_cast<std::size_t>(box.extent(0)) * components,
                                        static_cast<std::size_t>(box.extent(1)), stride});
  return kept;
}

bool isOfLevel(const Patch& patch, int level) { return level < 0 || patch.level().number() == level; }

/// Numbers as text: `0.3`, or `(0.3, 0.1)`.
std::string textOf(const double* numbers, int count) {
  std::string text;
  for (int k = 0; k < count; ++k)
    text += (k ? ", " : "") + (std::isnan(numbers[k]) ? std::string("nan") : fmt::format("{:.6g}", numbers[k]));
  return count == 1 ? text : "(" + text + ")";
}

/// The order in which values are compared: by index of the cell or node, then by id.
using Order = std::array<std::uint64_t, 2>;

/// The result of a search through all values of a variable.
struct Found {
  long seen = 0, broken = 0;
  Order first{};  ///< position in the order of the first invalid value
  int patch = 0;
  Index3 at;

  void merge(const Found& other) {
    const bool isLater = other.broken == 0 || (broken > 0 && first < other.first);
    const long all = seen + other.seen, bad = broken + other.broken;
    if (!isLater) *this = other;
    seen = all;
    broken = bad;
  }
};

/// Searches a variable for invalid values, on all patches of all ranks.
class Search {
 public:
  Search(Warehouse& warehouse, const Bounded& written, Bound bound, int ofLevel)
      : warehouse_(warehouse),
        grid_(warehouse.grid()),
        written_(written),
        bound_(bound),
        of_level_(ofLevel),
        label_(*warehouse.table()[written.variable].label),
        material_(warehouse.table()[written.variable].material) {}

  std::optional<BrokenValue> run() {
    for (const Patch& patch : grid_.patches())
      if (isOfLevel(patch, of_level_)) isParticle() ? lookAtParticles(patch) : lookAtGrid(patch);
    warehouse_.ranks().merge(found_);
    if (found_.broken == 0) return std::nullopt;
    return BrokenValue{std::string(label_.name), found_.patch, isParticle() ? particleSentence() : gridSentence()};
  }

 private:
  bool isParticle() const { return label_.centring == Centring::particle; }

  const double* numbers(Generation generation, int patch, std::size_t place) const {
    return numbersOf(warehouse_.variable(generation, written_.variable, patch)) +
           place * static_cast<std::size_t>(label_.components);
  }
  const ParticleSet& set(Generation generation, int patch) const {
    return warehouse_.particles(generation, material_, patch);
  }
  const ParticleId* ids(Generation generation, int patch) const {
    const int number = warehouse_.table().find(data::particleId.name, material_);
    return reinterpret_cast<const ParticleId*>(warehouse_.variable(generation, number, patch).values);
  }
  std::size_t gridPlace(int patch, const Index3& at) const {
    return warehouse_.variable(Generation::fresh, written_.variable, patch).stored.offset(at);
  }
  /// The patch to which a cell, or the node at its lower corner, belongs. If the cell at the upper side of the node is
  /// on another level, returns the patch of one of the cells at its lower sides, or a patch with index -1 if there is
  /// none.
  Patch ownerOf(Index3 at, const Level& level) const {
    for (int d = 0; d < 3; ++d) at[d] = std::min(at[d], level.cells().upper[d] - 1);
    for (int corner = 0; isNode() && corner < 1 << level.dimension(); ++corner) {
      Index3 cell = at;
      for (int d = 0; d < level.dimension(); ++d) cell[d] = std::max(0, at[d] - (corner >> d & 1));
      if (const Patch patch = grid_.patchOf(cell, level.number()); patch.id() >= 0) return patch;
    }
    return grid_.patchOf(at, level.number());
  }
  bool isNode() const { return label_.centring == Centring::node; }
  Box boxOf(const Level& level) const { return isNode() ? level.nodes() : level.cells(); }
  /// The level of the first invalid value.
  const Level& level() const { return grid_.patch(found_.patch).level(); }

  /// Checks the values at one position; counts the invalid ones, and records the first.
  void look(const double* values, const Order& order, int patch, const Index3& at, std::size_t place) {
    ++found_.seen;
    if (holds(bound_, values, static_cast<std::size_t>(label_.components))) return;
    if (++found_.broken > 1 && found_.first < order) return;
    found_.first = order;
    found_.patch = patch;
    found_.at = at;
    place_ = place;
  }
  void lookAtParticles(const Patch& patch) {
    grid::forEach<3>(patch.cells(), [&](const Index3& cell) {
      for (const int p : set(written_.set, patch.id()).in(cell)) {
        const std::size_t place = p;
        look(numbers(Generation::fresh, patch.id(), place),
             {patch.level().cellNumber(cell), ids(written_.set, patch.id())[p]}, patch.id(), cell, place);
      }
    });
  }
  void lookAtGrid(const Patch& patch) {
    const Level& level = patch.level();
    const Box all = boxOf(level);
    grid::forEach<3>(ownBox(patch, label_), [&](const Index3& at) {
      if (ownerOf(at, level).id() != patch.id()) return;
      const std::size_t place = gridPlace(patch.id(), at);
      look(numbers(Generation::fresh, patch.id(), place), {isNode() ? all.offset(at) : level.cellNumber(at), 0},
           patch.id(), at, place);
    });
  }

  /// Broadcasts the text of the only rank that passes one; the other ranks pass empty texts. Collective.
  std::string said(const std::string& mine) const {
    if (warehouse_.ranks().isAlone()) return mine;
    for (const std::string& text : warehouse_.ranks().gather(mine))
      if (!text.empty()) return text;
    return "";
  }
  bool isHere() const { return grid_.isMine(found_.patch); }
  bool wasHeld() const {
    return !grid_.patches().empty() && warehouse_.variable(Generation::old, written_.variable, grid_.firstPatch()).held;
  }

  std::string became(const std::string& before) const {
    const std::string now =
        said(isHere() ? textOf(numbers(Generation::fresh, found_.patch, place_), label_.components) : "");
    std::string text = fmt::format("{} became {} {}", label_.name, now, label_.unit);
    if (!before.empty()) text += fmt::format(" (was {})", before);
    return text + fmt::format(", but must be {}", data::textOf(bound_));
  }
  std::string howMany(const char* what) const {
    return fmt::format("{} of {} {} {} out of bounds", found_.broken, found_.seen, what,
                       found_.broken == 1 ? "is" : "are");
  }

  /// The value of the particle at the start of the step, and its position at that time; empty for a new particle.
  std::string particleBefore(ParticleId id) const {
    if (!wasHeld()) return "";
    for (const Patch& patch : grid_.patches())
      for (int p = 0; p < set(Generation::old, patch.id()).owned(); ++p)
        if (ids(Generation::old, patch.id())[p] == id)
          return textOf(numbers(Generation::old, patch.id(), static_cast<std::size_t>(p)), label_.components);
    return "";
  }
  std::string positionOfParticle() const {
    const int number = warehouse_.table().find("p.x", material_);
    if (!isHere() || number < 0 || !warehouse_.variable(written_.set, number, found_.patch).held) return "";
    const double* x = numbersOf(warehouse_.variable(written_.set, number, found_.patch)) +
                      place_ * static_cast<std::size_t>(grid_.dimension());
    return fmt::format(" at x = {} m", textOf(x, grid_.dimension()));
  }
  /// Up to four values of particles in a cell, except the particle itself.
  std::string valuesIn(const Index3& cell) const {
    const int patch = grid_.patchOf(cell, level().number()).id();
    if (!grid_.isMine(patch)) return "";
    std::string text;
    int count = 0;
    for (const int p : set(written_.set, patch).in(cell)) {
      const std::size_t place = p;
      if (patch == found_.patch && place == place_) continue;
      if (++count <= 4)
        text += (count > 1 ? ", " : "") + textOf(numbers(Generation::fresh, patch, place), label_.components);
    }
    if (count > 4) text += fmt::format(", ... ({} particles)", count);
    return count == 0 ? "none" : text;
  }
  std::string particleSentence() const {
    const ParticleId id = found_.first[1];
    std::string text = became(said(particleBefore(id)));
    text += fmt::format(": particle {} in {}", id, nameOf(level(), found_.at)) + said(positionOfParticle());
    text += fmt::format("; around it: {} in its cell", said(valuesIn(found_.at)));
    for (int d = 0; d < grid_.dimension(); ++d)
      for (const int side : {-1, 1}) {
        Index3 cell = found_.at;
        cell[d] += side;
        if (level().cells().contains(cell) && grid_.patchOf(cell, level().number()).id() >= 0)
          text += fmt::format(", {} in {}", said(valuesIn(cell)), nameOf(level(), cell));
      }
    return text + "; " + howMany("particles");
  }

  std::string gridBefore() const {
    if (!isHere() || !wasHeld()) return "";
    return textOf(numbers(Generation::old, found_.patch, place_), label_.components);
  }
  std::string valueAt(const Index3& at) const {
    const int patch = ownerOf(at, level()).id();
    if (!grid_.isMine(patch)) return "";
    return textOf(numbers(Generation::fresh, patch, gridPlace(patch, at)), label_.components);
  }
  std::string gridSentence() const {
    const bool nodes = isNode();
    const Level& level = this->level();
    const char* what = nodes ? "node" : "cell";
    std::array<double, 3> x{};
    for (int d = 0; d < level.dimension(); ++d)
      x[d] = level.nodePosition(d, found_.at[d]) + (nodes ? 0 : 0.5 * level.spacing(d));
    std::string text = fmt::format("{}: {} at x = {} m; around it:", became(said(gridBefore())),
                                   nameOf(level, found_.at, what), textOf(x.data(), level.dimension()));
    for (int d = 0; d < level.dimension(); ++d)
      for (const int side : {-1, 1}) {
        Index3 at = found_.at;
        at[d] += side;
        if (boxOf(level).contains(at) && ownerOf(at, level).id() >= 0)
          text += fmt::format(" {} in {},", said(valueAt(at)), nameOf(level, at, what));
      }
    text.back() = ';';
    return text + " " + howMany(nodes ? "nodes" : "cells");
  }

  Warehouse& warehouse_;
  const Grid& grid_;
  Bounded written_;
  Bound bound_;
  int of_level_;  ///< the level to check; -1: all levels
  const Label& label_;
  int material_;
  Found found_;
  std::size_t place_ = 0;  ///< index of the value in memory, on the rank that has it
};

}  // namespace

bool keepsBounds(Warehouse& warehouse, const std::vector<Bounded>& written, const Patch& patch) {
  bool kept = true;
  for (const Bounded& variable : written) kept = kept && keepsBound(warehouse, variable, patch);
  return kept;
}

std::size_t firstThatBreaks(Warehouse& warehouse, const std::vector<Bounded>& written, int level) {
  const auto& patches = warehouse.grid().patches();
  const auto breaks = [&](const Bounded& variable) {
    return std::any_of(patches.begin(), patches.end(), [&](const Patch& patch) {
      return isOfLevel(patch, level) && !keepsBound(warehouse, variable, patch);
    });
  };
  return static_cast<std::size_t>(std::find_if(written.begin(), written.end(), breaks) - written.begin());
}

std::optional<BrokenValue> firstBroken(Warehouse& warehouse, const Bounded& written, Bound bound, int level) {
  return Search(warehouse, written, bound, level).run();
}

std::optional<BrokenValue> firstBroken(Warehouse& warehouse, const std::vector<Bounded>& written, int level) {
  for (const Bounded& variable : written) {
    const Bound bound = warehouse.table()[variable.variable].label->bound;
    if (auto broken = firstBroken(warehouse, variable, bound, level)) return broken;
  }
  return std::nullopt;
}

std::string nameOf(const Level& level, const Index3& at, const char* what) {
  std::string text;
  for (int d = 0; d < level.dimension(); ++d) text += fmt::format("{}{}", d ? ", " : "", at[d]);
  return fmt::format("{} ({})", what, text);
}

}  // namespace tushar::tasks
