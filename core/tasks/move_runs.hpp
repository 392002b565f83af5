#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

namespace tushar::tasks {

/// Calls `visit(bytes)` with the size of a value, as a constant for values of one, two, three, four, six and nine
/// numbers, which are the most frequent sizes.
template <class Visit>
inline void withSize(std::size_t bytes, Visit&& visit) {
  constexpr std::size_t number = sizeof(double);
  switch (bytes) {
    case number:
      return visit(std::integral_constant<std::size_t, number>());
    case 2 * number:
      return visit(std::integral_constant<std::size_t, 2 * number>());
    case 3 * number:
      return visit(std::integral_constant<std::size_t, 3 * number>());
    case 4 * number:
      return visit(std::integral_constant<std::size_t, 4 * number>());
    case 6 * number:
      return visit(std::integral_constant<std::size_t, 6 * number>());
    case 9 * number:
      return visit(std::integral_constant<std::size_t, 9 * number>());
    default:
      return visit(bytes);
  }
}

/// Moves `run.count` elements of `bytes` bytes from index `run.from` to index `run.to`.
template <class Run, class Bytes>
inline void moveRun(const Run& run, const std::byte* from, std::byte* to, Bytes bytes) {
  constexpr int few = 4;  // so few elements are moved faster than memmove begins
  to += static_cast<std::size_t>(run.to) * bytes;
  from += static_cast<std::size_t>(run.from) * bytes;
  const auto moveOne = [&](int k) {
    std::memcpy(to + static_cast<std::size_t>(k) * bytes, from + static_cast<std::size_t>(k) * bytes, bytes);
  };
  if (to == from) return;
  if (run.count > few)
    std::memmove(to, from, static_cast<std::size_t>(run.count) * bytes);
  else if (run.to < run.from)
    for (int k = 0; k < run.count; ++k) moveOne(k);
  else
    for (int k = run.count; k-- > 0;) moveOne(k);
}

/// Moves runs of elements of `size` bytes, possibly within the same memory if their order is preserved. Then runs that
/// move up are processed from the last to the first, so that none is overwritten before it has been moved; runs that
/// move down never overlap runs that move up.
template <class Run>
void moveRuns(const std::vector<Run>& runs, const std::byte* from, std::byte* to, std::size_t size) {
  const auto goesUp = [](const Run& run) { return run.to > run.from; };
  withSize(size, [&](auto bytes) {
    for (auto run = runs.begin(); run != runs.end();) {
      const auto next = std::find_if_not(run, runs.end(), goesUp);
      for (auto up = next; up != run;) moveRun(*--up, from, to, bytes);
      run = std::find_if(next, runs.end(), goesUp);
      for (auto down = next; down != run; ++down) moveRun(*down, from, to, bytes);
    }
  });
}

}  // namespace tushar::tasks
