#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace tushar::data {

/// A reduction of some type.
class ReductionSlot {
 public:
  virtual ~ReductionSlot() = default;
  virtual void reset() = 0;
  virtual std::vector<double> values() const = 0;
  /// The reducer as it lies in memory.
  virtual std::span<std::byte> bytes() = 0;
  /// Adds a reducer to another, both as they lie in memory.
  virtual void merge(const std::byte* from, std::byte* into) const = 0;
};

template <class R>
class TypedReduction : public ReductionSlot {
  static_assert(std::is_trivially_copyable_v<R>, "a checkpoint and a message keep a reducer as bytes");

 public:
  R reducer;
  void reset() override { reducer = R{}; }
  std::vector<double> values() const override { return reducer.values(); }
  std::span<std::byte> bytes() override { return std::as_writable_bytes(std::span(&reducer, 1)); }
  void merge(const std::byte* from, std::byte* into) const override {
    R one, other;
    std::memcpy(&one, into, sizeof(R));
    std::memcpy(&other, from, sizeof(R));
    one.merge(other);
    std::memcpy(into, &one, sizeof(R));
  }
};

using MakeReduction = std::unique_ptr<ReductionSlot> (*)();

template <class R>
std::unique_ptr<ReductionSlot> makeReduction() {
  return std::make_unique<TypedReduction<R>>();
}

}  // namespace tushar::data
