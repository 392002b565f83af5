#include "core/input/xml_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "core/input/text.hpp"

namespace tushar::input {

namespace {

bool isDeclaredLatin1(std::string_view text) {
  std::string declaration(text.substr(0, text.find('>')));
  std::transform(declaration.begin(), declaration.end(), declaration.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return declaration.starts_with("<?xml") && declaration.find("iso-8859-1") != std::string::npos;
}

std::string latin1ToUtf8(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      out += c;
    } else {
      out += static_cast<char>(0xC0 | (byte >> 6));
      out += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return out;
}

/// The reason why the file at `path` cannot be opened; empty if it can.
std::string accessProblem(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return "this is a folder, not a file";
  if (!std::filesystem::exists(path, ignored)) return "there is no such file";
  return {};
}

/// Appends the content of the file to `text`; returns an error message, or an empty text.
std::string readAll(const std::string& path, std::string& text) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::array<char, 65536> chunk;
  while (file.read(chunk.data(), chunk.size()) || file.gcount() > 0) {
    text.append(chunk.data(), file.gcount());
  }
  if (file.is_open() && !file.bad()) return {};
  return "it cannot be read: " + std::generic_category().message(errno ? errno : EIO);
}

}  // namespace

std::optional<std::string> XmlFile::slurp(const std::string& path, const Location& where, Diagnostics& diagnostics) {
  std::string text;
  std::string problem = accessProblem(path);
  if (problem.empty()) problem = readAll(path, text);
  if (problem.empty() && trimmed(text).empty()) problem = "the file is empty";
  if (problem.empty()) return text;
  const std::string prefix = where.file == path ? "" : fmt::format("cannot include '{}': ", path);
  diagnostics.error(where, {}, prefix + problem);
  return std::nullopt;
}

XmlFile::XmlFile(std::string_view text, std::string name, Diagnostics& diagnostics)
    : name_(std::move(name)), text_(isDeclaredLatin1(text) ? latin1ToUtf8(text) : std::string(text)) {
  for (std::size_t i = 0; i < text_.size(); ++i) {
    if (text_[i] == '\n') lineStarts_.push_back(static_cast<std::ptrdiff_t>(i) + 1);
  }
  parse(diagnostics);
}

void XmlFile::parse(Diagnostics& diagnostics) {
  const std::optional<BadNesting> bad = findBadNesting(text_);
  if (bad && bad->tooDeep)
    return diagnostics.error(locate(bad->where), {},
                             fmt::format("tags are nested more than {} levels deep", mostNested));
  const unsigned options = pugi::parse_default | pugi::parse_comments;
  const pugi::xml_parse_result result = document_.load_buffer(text_.data(), text_.size(), options, pugi::encoding_utf8);
  if (!result) {
    const bool isNesting = bad && result.status == pugi::status_end_element_mismatch;
    const std::ptrdiff_t tag = isNesting ? bad->whereOpened : result.offset;
    if (isWithinText(text_, static_cast<std::size_t>(tag)))
      diagnostics.error(locate(static_cast<std::ptrdiff_t>(text_.rfind('<', static_cast<std::size_t>(tag)))), {},
                        "found < within a text: in a formula, write &lt; for 'less than'");
    else if (isNesting)
      diagnostics.error(locate(bad->where), {}, sentence(*bad));
    else
      diagnostics.error(locate(result.offset), {},
                        fmt::format("this is not well-formed XML: {}", result.description()));
    document_.reset();
  }
  for (auto next = root().next_sibling(); next; next = next.next_sibling()) {
    if (next.type() != pugi::node_element) continue;
    diagnostics.error(locate(next), {},
                      fmt::format("a second outermost tag <{}> after <{}>", next.name(), root().name()));
  }
}

std::string XmlFile::sentence(const BadNesting& bad) const {
  const std::string found = bad.closed.empty() ? "the end of the file" : "</" + bad.closed + ">";
  if (bad.open.empty()) return fmt::format("found {}, but no tag is open here", found);
  const std::string open = fmt::format("<{}> of {}", bad.open, locate(bad.whereOpened).text());
  if (bad.wasOpened || bad.closed.empty())
    return fmt::format("found {} while {} is still open; its </{}> may be missing", found, open, bad.open);
  return fmt::format("found {}, but no such tag is open; the open tag here is {}", found, open);
}

Location XmlFile::locate(std::ptrdiff_t offset) const {
  const auto after = std::upper_bound(lineStarts_.begin(), lineStarts_.end(), offset);
  const auto line = after - lineStarts_.begin();
  return {name_, static_cast<int>(line), static_cast<int>(offset - *std::prev(after)) + 1};
}

}  // namespace tushar::input
