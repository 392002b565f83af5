#include "tools/messages.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

namespace tushar {

extern const char* const messageFamilies;  // the files of tools/manual_pages/messages, one after the other

namespace {

constexpr std::string_view gap = "…";  // in words: what a run fills in

struct Family {
  std::string number;
  std::vector<std::string> words;
};

/// The quoted texts in `list`, up to the bracket that closes the list.
std::vector<std::string> textsIn(std::string_view list) {
  std::vector<std::string> texts;
  bool isQuoted = false;
  for (std::size_t at = 0; at < list.size() && (isQuoted || list[at] != ']'); ++at) {
    const bool isQuote = list[at] == '"';
    if (isQuote && !isQuoted) texts.emplace_back();
    if (isQuote) isQuoted = !isQuoted;
    if (isQuote || !isQuoted) continue;
    if (list[at] == '\\') ++at;
    texts.back() += list[at];
  }
  return texts;
}

std::vector<Family> readFamilies(std::string_view toml) {
  constexpr std::string_view head = "[[family]]", number = "\nid = ", words = "\nwords = [";
  std::vector<Family> families;
  for (std::size_t at = toml.find(head); at != std::string_view::npos; at = toml.find(head, at + 1)) {
    const std::string_view entry = toml.substr(at, toml.find(head, at + 1) - at);
    families.push_back({textsIn(entry.substr(entry.find(number), entry.find('\n', entry.find(number) + 1))).front(),
                        textsIn(entry.substr(entry.find(words) + words.size()))});
  }
  return families;
}

/// Number of letters of the fixed parts of `words` if they occur in a message in this order, otherwise 0.
std::size_t lettersIn(const std::string& message, std::string_view words) {
  std::size_t letters = 0, at = 0;
  while (true) {
    const std::string_view part = words.substr(0, words.find(gap));
    at = message.find(part, at);
    if (at == std::string::npos) return 0;
    at += part.size();
    letters += part.size();
    if (part.size() == words.size()) return letters;
    words.remove_prefix(part.size() + gap.size());
  }
}

}  // namespace

std::string messageNumber(const std::string& message) {
  static const std::vector<Family> families = readFamilies(messageFamilies);
  std::size_t most = 0;
  std::string number;
  for (const Family& family : families)
    for (const std::string& words : family.words)
      if (const std::size_t letters = lettersIn(message, words); letters > most) {
        most = letters;
        number = family.number;
      }
  return number;
}

std::string withNumber(const std::string& message) {
  const std::string number = messageNumber(message);
  return number.empty() ? message : message + " [" + number + "]";
}

}  // namespace tushar
