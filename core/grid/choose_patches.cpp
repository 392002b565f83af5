#include "core/grid/choose_patches.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

namespace tushar::grid {

namespace {

/// Patches per worker: several, so that a thread that finishes early can start another one.
constexpr int patchesPerWorker = 4;

/// What the beginning of a row of cells costs, in cells: patches that are short along x have more rows.
constexpr int costOfRow = 5;

double countOf(const Index3& cells) { return static_cast<double>(cells[0]) * cells[1] * cells[2]; }

/// Cost of the largest patch of a division: its cells with one layer of ghosts at its cuts, and its rows.
double costOf(const Index3& cells, const Index3& patches) {
  double cost = 1;
  for (int d = 0; d < 3; ++d) {
    const int largest = (cells[d] + patches[d] - 1) / patches[d];
    cost *= largest + std::min(2, patches[d] - 1) + (d == 0 ? costOfRow : 0);
  }
  return cost;
}

}  // namespace

int usefulThreads(double cells, int cellsOfThread, int most) {
  return std::max(1, static_cast<int>(std::min<double>(cells / cellsOfThread, most)));
}

int Workers::threadsFor(const Index3& cells) const {
  if (!mayBeFewer) return threads;
  return usefulThreads(countOf(cells) / ranks, cellsPerThread, threads);
}

int Workers::patchesFor(const Index3& cells) const {
  const double workers = static_cast<double>(ranks) * threadsFor(cells);
  return workers > 1 ? static_cast<int>(std::min(patchesPerWorker * workers, countOf(cells))) : 1;
}

Index3 choosePatches(const Index3& cells, int count) {
  const int wanted = std::max(1, static_cast<int>(std::min<double>(count, countOf(cells))));
  const int most = wanted + wanted / 4;
  Index3 best = cells;
  double least = std::numeric_limits<double>::infinity();
  for (int x = 1; x <= std::min(cells[0], most); ++x)
    for (int y = 1; y <= std::min(cells[1], most / x); ++y) {
      const int z = (wanted + x * y - 1) / (x * y);
      if (z > cells[2] || x * y * z > most) continue;
      const int turns = x * y * z == wanted ? wanted : most;  // if there are more than wanted, a worker has one more
      if (const double cost = turns * costOf(cells, {{x, y, z}}); cost < least) {
        least = cost;
        best = {{x, y, z}};
      }
    }
  return best;
}

std::optional<Index3> parseLayout(std::string_view text) {
  Index3 layout;
  const char *from = text.data(), *const end = from + text.size();
  for (int d = 0; d < 3; ++d) {
    if (d > 0 && (from == end || *from++ != 'x')) return std::nullopt;
    const auto [after, error] = std::from_chars(from, end, layout[d]);
    if (error != std::errc() || layout[d] < 1) return std::nullopt;
    from = after;
  }
  return from == end ? std::optional(layout) : std::nullopt;
}

}  // namespace tushar::grid
