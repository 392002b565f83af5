#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "components/analysis/moments.hpp"
#include "core/core.hpp"

// The tasks of statistics over time.

namespace tushar::analysis {

/// The names of what is computed for a variable, other than mean_X, sum_X and variance_X; empty: it is not computed.
struct NamesOfSums {
  std::string variable;                                 ///< name of the variable in the scene, without `c.`
  std::string meanSquare, sumOfSquares;                 ///< of squares
  std::string covariance, meanProducts, sumOfProducts;  ///< of products with the velocity
};

/// A mean or a moment, from the sums over samples.
struct Derived {
  int power = 1;          ///< 1: the mean, 2 to 4: central moments, 0: products with the velocity
  bool isCentral = true;  ///< whether it is that of deviations from the mean
  bool isTotal = false;   ///< whether it is multiplied by the number of samples
};

/// The times of samples [s].
struct SamplesBetween {
  double start = 0, stop = 0;
  bool contains(double time) const { return start <= time && time <= stop; }
};

/// Counts the samples.
template <int D>
void countSample(const Patch& patch, const SamplesBetween& between, double time, CellView<const double> before,
                 CellView<double> after) {
  const double more = between.contains(time) ? 1 : 0;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { after[cell] = before[cell] + more; });
}

/// A value of a cell as a vector of its N numbers.
inline Vec<1> numbersOf(double value) { return Vec<1>(value); }
template <int N>
Vec<N> numbersOf(const Vec<N>& value) {
  return value;
}
/// The same as a number, or as a vector along x, y, z.
template <int D>
double alongXyz(const Level&, double value) {
  return value;
}
template <int D>
Vec3 alongXyz(const Level& level, const Vec<D>& value) {
  return level.expandDirection<D>(value);
}

template <int D, class T, int K>
void addSample(const Patch& patch, const SamplesBetween& between, double time, CellView<const T> value,
               CellView<const double> count, CellView<const Moments<data::Stored<T>::components, K>> before,
               CellView<Moments<data::Stored<T>::components, K>> after) {
  const bool isSample = between.contains(time);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    after[cell] = before[cell];
    if (isSample)
      after[cell] = withSample<data::Stored<T>::components, K>(before[cell], numbersOf(value[cell]), count[cell] + 1);
  });
}

/// The mean of a variable from its sums, as a value.
template <class T, int K>
T meanOf(const Moments<data::Stored<T>::components, K>& sums) {
  if constexpr (data::Stored<T>::isVector)
    return sums.col(0);
  else
    return sums(0, 0);
}

/// A sampled variable or velocity, and its sums so far.
template <class T, int K>
struct Summed {
  CellView<const T> value;
  CellView<const Moments<data::Stored<T>::components, K>> sums;

  template <int D>
  auto deviation(const Level& level, const Index<D>& cell) const {
    return alongXyz<D>(level, T(value[cell] - meanOf<T, K>(sums[cell])));
  }
};

template <int D, class T, int K>
void addProducts(const Patch& patch, const SamplesBetween& between, double time, const Summed<T, K>& one,
                 const Summed<Vec<D>, K>& velocity, CellView<const double> count, CellView<const Vec3> before,
                 CellView<Vec3> after) {
  const bool isSample = between.contains(time);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    after[cell] = before[cell];
    if (isSample)
      after[cell] = withProducts(before[cell], one.deviation(patch.level(), cell),
                                 velocity.deviation(patch.level(), cell), count[cell] + 1);
  });
}

/// Computes a mean or a moment; 0 if there are no samples.
template <int D, class T, int K>
void deriveMoment(const Patch& patch, const Derived& which, CellView<const double> count,
                  CellView<const Moments<data::Stored<T>::components, K>> sums, CellView<T> result) {
  constexpr int N = data::Stored<T>::components;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const double n = count[cell];
    const Vec<N> mean = sums[cell].col(0);
    Vec<N> value = Vec<N>::Zero();
    if (n > 0) value = which.power == 1 ? mean : Vec<N>(sums[cell].col(which.power - 1) / n);
    if (which.power == 2 && !which.isCentral) value += mean.cwiseProduct(mean);
    if (which.isTotal) value *= n;
    if constexpr (data::Stored<T>::isVector)
      result[cell] = std::move(value);
    else
      result[cell] = value[0];
  });
}

/// The sums of a variable and those of the velocity.
template <int D, class T, int K>
struct SumsOfBoth {
  CellView<const Moments<data::Stored<T>::components, K>> one;
  CellView<const Moments<D, K>> velocity;
};

template <int D, class T, int K>
void deriveProducts(const Patch& patch, const Derived& which, CellView<const double> count,
                    const SumsOfBoth<D, T, K>& means, CellView<const Vec3> products, CellView<Vec3> result) {
  const Level& level = patch.level();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const double n = count[cell];
    Vec3 value = n > 0 ? Vec3(products[cell] / n) : Vec3(Vec3::Zero());
    if (!which.isCentral)
      value += productsWith(alongXyz<D>(level, T(meanOf<T, K>(means.one[cell]))),
                            level.expandDirection<D>(means.velocity[cell].col(0)));
    result[cell] = which.isTotal ? n * value : value;
  });
}

}  // namespace tushar::analysis
