#include "core/base/even_order.hpp"

#include <algorithm>
#include <numeric>

namespace tushar {

namespace {

/// The first place in the order that belongs to a thread.
std::size_t firstOf(int thread, int threads, std::size_t times) { return thread * times / threads; }

}  // namespace

double greatestLoad(const std::vector<double>& costs, const std::vector<int>& order, int threads) {
  double greatest = 0;
  for (int t = 0; t < threads; ++t) {
    double load = 0;
    for (std::size_t k = firstOf(t, threads, costs.size()); k < firstOf(t + 1, threads, costs.size()); ++k)
      load += costs[order[k]];
    greatest = std::max(greatest, load);
  }
  return greatest;
}

std::vector<int> evenOrder(const std::vector<double>& costs, int threads) {
  std::vector<int> falling(costs.size()), order(costs.size());
  std::iota(falling.begin(), falling.end(), 0);
  std::stable_sort(falling.begin(), falling.end(), [&](int a, int b) { return costs[a] > costs[b]; });
  std::vector<double> load(threads, 0.0);
  std::vector<std::size_t> next;
  for (int t = 0; t < threads; ++t) next.push_back(firstOf(t, threads, costs.size()));
  for (const int k : falling) {
    int least = -1;
    for (int t = 0; t < threads; ++t)
      if (next[t] < firstOf(t + 1, threads, costs.size()) && (least < 0 || load[t] < load[least])) least = t;
    order[next[least]++] = k;
    load[least] += costs[k];
  }
  return order;
}

}  // namespace tushar
