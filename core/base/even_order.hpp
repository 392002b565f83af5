#pragma once

#include <vector>

namespace tushar {

/// An order of the iterations of a loop for threads that get equal numbers of them, one thread after the other, so that
/// the sums of their costs are similar. From the most expensive iteration to the cheapest, each is given to the thread
/// that has least to do so far, among those that may get more (R. L. Graham, SIAM J. Appl. Math. 17 (1969) 416, without
/// the equal numbers). So each thread begins with its most expensive iteration.
std::vector<int> evenOrder(const std::vector<double>& costs, int threads);

/// The greatest sum of costs of any thread, with this order of the iterations.
double greatestLoad(const std::vector<double>& costs, const std::vector<int>& order, int threads);

}  // namespace tushar
