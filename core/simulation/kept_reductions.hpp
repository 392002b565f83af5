#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/data/warehouse.hpp"

namespace tushar::simulation {

/// Copies of the values of reductions, made before a step that overwrites the originals and may fail.
class KeptReductions {
 public:
  KeptReductions(data::Warehouse& warehouse, const std::vector<int>& numbers) : warehouse_(&warehouse) {
    for (const int number : numbers) {
      const std::span<const std::byte> bytes = warehouse.reductionBytes(number);
      kept_.emplace_back(number, std::vector<std::byte>(bytes.begin(), bytes.end()));
    }
  }
  /// Restores these values; reductions that had no value become empty.
  void restore() const {
    for (const auto& [number, bytes] : kept_)
      bytes.empty() ? warehouse_->resetReduction(number) : warehouse_->restoreReduction(number, bytes);
  }

 private:
  data::Warehouse* warehouse_;
  std::vector<std::pair<int, std::vector<std::byte>>> kept_;  ///< index and bytes of each reduction
};

}  // namespace tushar::simulation
