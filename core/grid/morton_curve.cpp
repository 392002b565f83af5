#include "core/grid/morton_curve.hpp"

#include <bit>

namespace tushar::grid {

MortonCurve::MortonCurve(Cuts cuts) : cuts_(std::move(cuts)) {
  for (int d = 0; d < 3; ++d) {
    all_.upper[d] = static_cast<int>(cuts_[d].size()) - 1;
    bits_ = std::max(bits_, static_cast<int>(std::bit_width(static_cast<unsigned>(all_.upper[d] - 1))));
  }
}

std::uint64_t MortonCurve::cellsOf(const Box& blocks) const {
  std::uint64_t cells = 1;
  for (int d = 0; d < 3; ++d) {
    const auto& cuts = cuts_[d];
    cells *= static_cast<std::uint64_t>(cuts[blocks.upper[d]] - cuts[blocks.lower[d]]);
  }
  return cells;
}

template <class IsUpper>
Index3 MortonCurve::descend(IsUpper&& isUpper) const {
  Box part = all_;
  for (int bit = bits_ - 1; bit >= 0; --bit)
    for (int axis = 2; axis >= 0; --axis) {
      const int middle = part.lower[axis] + (1 << bit);
      if (middle >= part.upper[axis]) continue;
      Box lower = part;
      lower.upper[axis] = middle;
      if (isUpper(lower, axis))
        part.lower[axis] = middle;
      else
        part = lower;
    }
  return part.lower;
}

int MortonCurve::placeOf(const Index3& block) const {
  std::size_t place = 0;
  descend([&](const Box& lower, int axis) {
    const bool isUpper = block[axis] >= lower.upper[axis];
    if (isUpper) place += lower.size();
    return isUpper;
  });
  return static_cast<int>(place);
}

Index3 MortonCurve::blockAt(int place) const {
  auto left = static_cast<std::size_t>(place);
  return descend([&](const Box& lower, int) {
    const bool isUpper = left >= lower.size();
    if (isUpper) left -= lower.size();
    return isUpper;
  });
}

Box MortonCurve::cellsAt(const Index3& block) const {
  Box cells;
  for (int d = 0; d < 3; ++d) {
    const int* cut = &cuts_[d][block[d]];
    cells.lower[d] = cut[0];
    cells.upper[d] = cut[1];
  }
  return cells;
}

std::uint64_t MortonCurve::cellsBefore(int place) const {
  if (place >= blocks()) return cells();
  auto left = static_cast<std::size_t>(place);
  std::uint64_t before = 0;
  descend([&](const Box& lower, int) {
    if (left < lower.size()) return false;
    left -= lower.size();
    before += cellsOf(lower);
    return true;
  });
  return before;
}

int MortonCurve::placeAfter(std::uint64_t cells) const {
  if (cells >= this->cells()) return blocks();
  std::uint64_t left = cells;
  std::size_t place = 0;
  descend([&](const Box& lower, int) {
    if (left < cellsOf(lower)) return false;
    left -= cellsOf(lower);
    place += lower.size();
    return true;
  });
  return static_cast<int>(place) + (left > 0 ? 1 : 0);
}

int MortonCurve::blockAlong(int axis, int cell) const {
  const auto& cuts = cuts_[axis];
  return static_cast<int>(std::upper_bound(cuts.begin(), cuts.end() - 1, cell) - cuts.begin() - 1);
}

}  // namespace tushar::grid
