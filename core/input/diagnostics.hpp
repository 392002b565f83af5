#pragma once

#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/input/element.hpp"

namespace tushar::input {

/// Collects all problems of a scene, so that the user sees all of them together.
class Diagnostics {
 public:
  /// Reports a problem at a location; `tagPath` may be empty.
  void error(const Location& where, std::string tagPath, std::string sentence);
  /// Reports a problem with a tag or its value.
  void error(const Element& element, std::string sentence);

  /// Reports an accepted setting that has no effect.
  void note(const Element& element, std::string sentence);
  void note(const Location& where, std::string tagPath, std::string sentence);
  const std::vector<InputProblem>& notes() const { return notes_; }

  bool any() const { return !problems_.empty(); }
  /// Number of problems that have been reported, including those that had been reported before: whoever compares two
  /// sizes learns whether the code between them found a problem.
  std::size_t size() const { return reports_; }
  /// All problems, grouped by file in the order of each file's first problem, then by line and column.
  std::vector<InputProblem> sorted() const;
  /// Throws InputError with all problems, sorted, if there is any.
  void throwIfAny() const;

 private:
  std::vector<InputProblem> problems_, notes_;
  std::size_t reports_ = 0;
};

}  // namespace tushar::input
