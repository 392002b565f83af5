#include "core/input/diagnostics.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace tushar::input {

namespace {

/// Adds a message, unless it is already there: a section that several parts of a component read is checked by each.
void addOnce(std::vector<InputProblem>& list, InputProblem one) {
  const std::string text = one.text();
  const bool isThere = std::any_of(list.begin(), list.end(), [&](const auto& other) { return other.text() == text; });
  if (!isThere) list.push_back(std::move(one));
}

}  // namespace

void Diagnostics::error(const Location& where, std::string tagPath, std::string sentence) {
  ++reports_;
  addOnce(problems_, {where, std::move(tagPath), std::move(sentence)});
}

void Diagnostics::error(const Element& element, std::string sentence) {
  error(element.where(), element.path(), std::move(sentence));
}

void Diagnostics::note(const Element& element, std::string sentence) {
  note(element.where(), element.path(), std::move(sentence));
}

void Diagnostics::note(const Location& where, std::string tagPath, std::string sentence) {
  addOnce(notes_, {where, std::move(tagPath), std::move(sentence)});
}

std::vector<InputProblem> Diagnostics::sorted() const {
  std::map<std::string, std::size_t> order;
  for (const InputProblem& problem : problems_) order.emplace(problem.where.file, order.size());
  const auto key = [&](const InputProblem& problem) {
    return std::tuple(order.at(problem.where.file), problem.where.line, problem.where.column);
  };
  std::vector<InputProblem> out = problems_;
  std::stable_sort(out.begin(), out.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  return out;
}

void Diagnostics::throwIfAny() const {
  if (any()) throw InputError(sorted());
}

}  // namespace tushar::input
