#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <vector>

namespace tushar::tasks {

/// Copies one value; optimised for values of one, two, three, four, six and nine numbers, which are the most frequent
/// sizes.
inline void copyValue(const std::byte* from, std::byte* to, std::size_t bytes) {
  constexpr std::size_t number = sizeof(double);
  switch (bytes) {
    case number:
      std::memcpy(to, from, number);
      break;
    case 2 * number:
      std::memcpy(to, from, 2 * number);
      break;
    case 3 * number:
      std::memcpy(to, from, 3 * number);
      break;
    case 4 * number:
      std::memcpy(to, from, 4 * number);
      break;
    case 6 * number:
      std::memcpy(to, from, 6 * number);
      break;
    case 9 * number:
      std::memcpy(to, from, 9 * number);
      break;
    default:
      std::memcpy(to, from, bytes);
  }
}

/// Moves `run.count` elements of `bytes` bytes from index `run.from` to index `run.to`.
template <class Run>
inline void moveRun(const Run& run, const std::byte* from, std::byte* to, std::size_t bytes) {
  to += static_cast<std::size_t>(run.to) * bytes;
  from += static_cast<std::size_t>(run.from) * bytes;
  if (to == from) return;
  if (run.count == 1)
    copyValue(from, to, bytes);
  else
    std::memmove(to, from, static_cast<std::size_t>(run.count) * bytes);
}

/// Moves runs of elements of `bytes` bytes, possibly within the same memory. Runs that move up are processed from the
/// last to the first, so that none is overwritten before it has been moved. The order of runs is preserved, so runs
/// that move down never overlap runs that move up.
template <class Run>
void moveRuns(const std::vector<Run>& runs, const std::byte* from, std::byte* to, std::size_t bytes) {
  const auto goesUp = [](const Run& run) { return run.to > run.from; };
  for (auto run = runs.begin(); run != runs.end();) {
    const auto next = std::find_if_not(run, runs.end(), goesUp);
    for (auto up = next; up != run;) moveRun(*--up, from, to, bytes);
    run = std::find_if(next, runs.end(), goesUp);
    for (auto down = next; down != run; ++down) moveRun(*down, from, to, bytes);
  }
}

}  // namespace tushar::tasks
