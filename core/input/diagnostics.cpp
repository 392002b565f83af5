#include "core/input/diagnostics.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace tushar::input {

void Diagnostics::error(const Location& where, std::string tagPath, std::string sentence) {
  problems_.push_back({where, std::move(tagPath), std::move(sentence)});
}

void Diagnostics::error(const Element& element, std::string sentence) {
  error(element.where(), element.path(), std::move(sentence));
}

void Diagnostics::note(const Element& element, std::string sentence) {
  note(element.where(), element.path(), std::move(sentence));
}

void Diagnostics::note(const Location& where, std::string tagPath, std::string sentence) {
  notes_.push_back({where, std::move(tagPath), std::move(sentence)});
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
