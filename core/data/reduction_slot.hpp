#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "core/base/merge.hpp"

namespace tushar::data {

/// A reduction of any type: the reducer and, while a task runs, one partial result per patch.
class ReductionSlot {
 public:
  virtual ~ReductionSlot() = default;
  virtual void reset() = 0;
  virtual std::vector<double> values() const = 0;
  /// The bytes of the reducer.
  virtual std::span<std::byte> bytes() = 0;
  /// Merges one reducer into another; both are given by their bytes.
  virtual void merge(const std::byte* from, std::byte* into) const = 0;
  /// Creates `parts` empty partial results.
  virtual void divide(std::size_t parts) = 0;
  /// Adds the partial results to the reducer in a fixed order and empties them.
  virtual void gather() = 0;
};

template <class R>
class TypedReduction : public ReductionSlot {
  static_assert(std::is_trivially_copyable_v<R>, "checkpoints and messages copy the bytes of a reducer");

 public:
  R reducer;
  R& part(std::size_t k) { return parts_[k].reducer; }

  void reset() override { reducer = R{}; }
  std::vector<double> values() const override { return reducer.values(); }
  std::span<std::byte> bytes() override { return std::as_writable_bytes(std::span(&reducer, 1)); }
  void merge(const std::byte* from, std::byte* into) const override { mergeInMemory<R>(from, into); }
  void divide(std::size_t parts) override { parts_.assign(parts, {}); }
  void gather() override {
    for (Part& part : parts_) {
      reducer.merge(part.reducer);
      part.reducer = R{};
    }
  }

 private:
  /// A partial result in its own cache line, because threads write to neighbouring results at the same time.
  struct alignas(64) Part {
    R reducer;
  };
  std::vector<Part> parts_;
};

using MakeReduction = std::unique_ptr<ReductionSlot> (*)();

template <class R>
std::unique_ptr<ReductionSlot> makeReduction() {
  return std::make_unique<TypedReduction<R>>();
}

}  // namespace tushar::data
