#include "core/report/problems.hpp"

#include <nlohmann/json.hpp>
#include <optional>

namespace tushar::report {

namespace {

/// The word x if a sentence ends with ` (did you mean 'x'?)`.
std::optional<std::string> suggestionIn(const std::string& sentence) {
  constexpr std::string_view before = "(did you mean '", after = "'?)";
  const std::size_t start = sentence.find(before);
  if (start == std::string::npos) return {};
  const std::size_t first = start + before.size(), end = sentence.find(after, first);
  return end == std::string::npos ? std::nullopt : std::optional(sentence.substr(first, end - first));
}

}  // namespace

std::string toJson(const std::vector<InputProblem>& problems,
                   const std::function<std::string(const InputProblem&)>& numberOf) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const InputProblem& problem : problems) {
    nlohmann::ordered_json one;
    one["file"] = problem.where.file;
    one["line"] = problem.where.line;
    one["column"] = problem.where.column;
    one["path"] = problem.tagPath;
    one["message"] = problem.sentence;
    if (const std::string number = numberOf ? numberOf(problem) : ""; !number.empty()) one["number"] = number;
    if (const auto suggestion = suggestionIn(problem.sentence)) one["suggestion"] = *suggestion;
    list.push_back(std::move(one));
  }
  return list.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace tushar::report
