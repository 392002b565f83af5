#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tushar::data {

/// A value for each cell of some rows. Rows that have not been opened share one piece of memory, so that a body in a
/// large grid takes memory for the rows that it occupies.
template <class T>
class RowTable {
 public:
  /// A table of cells whose value is `none`.
  explicit RowTable(const T& none = {}) : none_(none) {}

  /// Resets the table to `rows` rows of `length` cells, all closed.
  void reset(std::size_t rows, std::size_t length) {
    starts_.assign(rows, 0);
    const bool isFilled = length <= std::min(length_, values_.size());  // values of closed rows never change
    if (values_.size() < length) values_.resize(length);
    if (!isFilled) std::fill_n(values_.begin(), length, none_);
    length_ = end_ = length;
  }
  bool isOf(std::size_t rows, std::size_t length) const { return starts_.size() == rows && length_ == length; }
  /// The values of a row, for reading.
  const T* operator[](std::size_t row) const { return values_.data() + starts_[row]; }
  bool isOpen(std::size_t row) const { return starts_[row] > 0; }
  bool hasOpenRows() const { return end_ > length_; }
  /// The values of a row, for writing; valid until the next row is opened.
  T* open(std::size_t row) {
    if (starts_[row] == 0) append(row);
    return values_.data() + starts_[row];
  }
  /// Makes space for as many open rows as another table has, and some more.
  void makeSpaceFor(const RowTable& other) { makeSpaceFor(other.end_ + other.end_ / 8 + length_); }

 private:
  void makeSpaceFor(std::size_t values) {
    if (values > values_.capacity()) values_.reserve(values);
  }
  void append(std::size_t row) {
    const std::size_t start = end_;
    end_ += length_;
    if (end_ > values_.capacity()) makeSpaceFor(end_ + start / 4);
    if (end_ > values_.size()) values_.resize(end_);
    starts_[row] = start;
    std::copy_n(values_.begin(), length_, values_.begin() + start);  // faster than copies of a single value
  }

  std::vector<std::size_t> starts_;  ///< place of the first value of each row; 0 for closed rows, which share values
  std::vector<T> values_;            ///< those behind `end_` are unused
  std::size_t length_ = 0, end_ = 0;
  T none_;
};

}  // namespace tushar::data
