#include "core/base/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>

namespace tushar {

namespace {

std::string linesOf(const std::vector<InputProblem>& problems) {
  std::string text;
  for (const InputProblem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += problem.text();
  }
  return text;
}

std::string lower(std::string_view word) {
  std::string out(word);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::tolower(c); });
  return out;
}

/// Returns the number of insertions, deletions, substitutions and exchanges of neighbouring letters that turn `a` into
/// `b` (Damerau, 1964).
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, above, row(b.size() + 1);  // the rows of i - 2, i - 1 and i letters of `a`
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = std::exchange(above, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, substituted});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

const Location& placeOf(std::initializer_list<const Location*> parts, const Location& tag) {
  const auto found = std::find_if(parts.begin(), parts.end(), [](const Location* where) { return where->isOption(); });
  return found == parts.end() ? tag : **found;
}

std::string Location::text() const {
  if (line <= 0) return file;
  return column > 0 ? fmt::format("{}:{}:{}", file, line, column) : fmt::format("{}:{}", file, line);
}

std::string InputProblem::text() const {
  std::string prefix = where.text();
  if (!tagPath.empty()) prefix += (prefix.empty() ? "" : ": ") + tagPath;
  return prefix.empty() ? sentence : prefix + ": " + sentence;
}

InputError::InputError(std::vector<InputProblem> problems)
    : std::runtime_error(linesOf(problems)), problems_(std::move(problems)) {}

std::string didYouMean(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string wanted = lower(word);
  std::size_t best = std::max<std::size_t>(2, wanted.size() / 3) + 1;
  const std::string* nearest = nullptr;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = editDistance(wanted, lower(candidate));
    if (distance < best && distance < candidate.size()) {
      best = distance;
      nearest = &candidate;
    }
  }
  return nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : std::string();
}

namespace {

std::string quoted(const std::vector<std::string>& words, const char* last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? last : ", ";
    text += "'" + words[i] + "'";
  }
  return text;
}

}  // namespace

std::string alternatives(const std::vector<std::string>& words) { return quoted(words, " or "); }
std::string allOf(const std::vector<std::string>& words) { return quoted(words, " and "); }

std::string counted(long count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace tushar
