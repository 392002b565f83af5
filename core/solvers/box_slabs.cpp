#include "core/solvers/box_slabs.hpp"

#include <numeric>

#include "core/base/mpi_together.hpp"

namespace tushar::solvers {

namespace {

/// The first planes of slabs that begin at multiples of `step`.
std::vector<int> bordersAt(int step, int planes, int ranks) {
  std::vector<int> borders;
  const int steps = planes / step;
  for (int rank = 0; rank < ranks; ++rank) borders.push_back(step * static_cast<int>(long{steps} * rank / ranks));
  borders.push_back(planes);
  return borders;
}

int thickest(const std::vector<int>& borders) {
  int most = 0;
  for (std::size_t rank = 0; rank + 1 < borders.size(); ++rank)
    most = std::max(most, borders[rank + 1] - borders[rank]);
  return most;
}

}  // namespace

// Slabs can be halved as often as possible without a rank that has much more to do than others.
std::vector<int> BoxSlabs::borders(int planes, int ranks) {
  constexpr double tolerable = 1.1;
  if (ranks == 1) return {0, planes};
  std::vector<int> found = bordersAt(2, planes, ranks);
  const int least = thickest(found);
  for (int step = 4; step * ranks <= planes; step *= 2) {
    std::vector<int> borders = bordersAt(step, planes, ranks);
    if (thickest(borders) <= tolerable * least) found = std::move(borders);
  }
  return found;
}

BoxSlabs::BoxSlabs(int planes, Threads* threads) : threads_(threads), borders_{0, planes} {}

BoxSlabs::BoxSlabs(int planes, const mpi::Communicator& ranks, Threads* threads)
    : ranks_(&ranks), threads_(threads), borders_(borders(planes, ranks.size())) {}

bool BoxSlabs::isEven() const {
  return std::all_of(borders_.begin(), borders_.end() - 1, [](int border) { return border % 2 == 0; });
}

BoxSlabs BoxSlabs::coarser(int ratio) const {
  BoxSlabs coarse = *this;
  for (int& border : coarse.borders_) border = (border + ratio - 1) / ratio;
  return coarse;
}

double BoxSlabs::sum(std::span<double> ofPlanes) const {
  complete(ofPlanes);
  return std::accumulate(ofPlanes.begin(), ofPlanes.end(), 0.0);
}

void BoxSlabs::completeBytes(std::span<std::byte> ofPlanes) const { mpi::complete(*ranks_, ofPlanes, borders_); }

void BoxSlabs::fillLayerBytes(std::span<std::byte> values, bool isPeriodic, bool alsoAbove) const {
  const std::size_t plane = values.size() / static_cast<std::size_t>(own() + 2);
  const std::span below = values.first(plane), lowest = values.subspan(plane, plane);
  const std::span highest = values.last(2 * plane).first(plane), above = values.last(plane);
  if (isWhole()) {
    if (isPeriodic) std::ranges::copy(highest, below.begin());
    if (isPeriodic && alsoAbove) std::ranges::copy(lowest, above.begin());
    return;
  }
  const int rank = ranks_->rank(), count = ranks_->size();
  const int up = rank + 1 < count ? rank + 1 : isPeriodic ? 0 : -1;
  const int down = rank > 0 ? rank - 1 : isPeriodic ? count - 1 : -1;
  mpi::pass(*ranks_, up, highest, down, below);
  if (alsoAbove) mpi::pass(*ranks_, down, lowest, up, above);
}

}  // namespace tushar::solvers
