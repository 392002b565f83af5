#include "core/input/nesting.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace tushar::input {

namespace {

constexpr std::size_t npos = std::string_view::npos;

/// The position after the `>` that ends the tag at `at`; a `>` within quotes does not count.
std::size_t endOfTag(std::string_view text, std::size_t at) {
  char quote = 0;
  for (; at < text.size(); ++at) {
    if (quote == 0 && text[at] == '>') return at + 1;
    if (quote == 0 && (text[at] == '"' || text[at] == '\''))
      quote = text[at];
    else if (text[at] == quote)
      quote = 0;
  }
  return npos;
}

/// The position after a comment, CDATA section or declaration at `at`; `at` itself if the tag of an element begins
/// there.
std::size_t pastOther(std::string_view text, std::size_t at) {
  const std::pair<std::string_view, std::string_view> others[] = {
      {"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}, {"<!", ">"}};
  for (const auto& [start, end] : others) {
    if (!text.substr(at).starts_with(start)) continue;
    const std::size_t found = text.find(end, at + start.size());
    return found == npos ? npos : found + end.size();
  }
  return at;
}

std::string nameAt(std::string_view text, std::size_t at) {
  return std::string(text.substr(at, std::min(text.find_first_of(" \t\r\n/>", at), text.size()) - at));
}

}  // namespace

std::optional<BadNesting> findBadNesting(std::string_view text) {
  std::vector<std::pair<std::string, std::size_t>> open;
  const auto bad = [&](std::size_t at, const std::string& closed) {
    BadNesting found{static_cast<std::ptrdiff_t>(at), closed, "", 0, false, false};
    if (!open.empty()) found.open = open.back().first;
    if (!open.empty()) found.whereOpened = static_cast<std::ptrdiff_t>(open.back().second);
    found.wasOpened = std::any_of(open.begin(), open.end(), [&](const auto& tag) { return tag.first == closed; });
    return found;
  };
  for (std::size_t at = text.find('<'), end = 0; at != npos; at = text.find('<', end)) {
    const std::size_t past = pastOther(text, at);
    end = past == at ? endOfTag(text, at) : past;
    if (end == npos) return std::nullopt;
    if (past != at) continue;
    const std::size_t start = at + (text[at + 1] == '/' ? 2 : 1);
    const std::string name = nameAt(text, start);
    if (start == at + 2 && (open.empty() || open.back().first != name)) return bad(start, name);
    if (start == at + 2) {
      open.pop_back();
    } else if (text[end - 2] != '/') {
      if (open.size() == mostNested) return BadNesting{static_cast<std::ptrdiff_t>(start), "", "", 0, false, true};
      open.emplace_back(name, start);
    }
  }
  if (open.empty()) return std::nullopt;
  return bad(text.size(), "");
}

bool isWithinText(std::string_view xml, std::size_t at) {
  const std::size_t less = xml.rfind('<', at);
  if (less == npos || less == 0) return false;
  const std::size_t before = xml.find_last_not_of(" \t\r\n", less - 1);
  const std::size_t bracket = xml.find_last_of("<>", less - 1);
  return before != npos && bracket != npos && xml[bracket] == '>' && before != bracket;
}

}  // namespace tushar::input
