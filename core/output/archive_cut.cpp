#include "core/output/archive_cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <pugixml.hpp>
#include <system_error>
#include <vector>

#include "core/output/archive_files.hpp"

namespace tushar::output {

namespace fs = std::filesystem;

std::string linesUpTo(const std::string& lines, double time) {
  std::size_t kept = 0;
  for (std::size_t end; (end = lines.find('\n', kept)) != std::string::npos; kept = end + 1) {
    double at = time;
    const bool isHeader = lines[kept] == '#';
    if (!isHeader && std::from_chars(lines.data() + kept, lines.data() + end, at).ec != std::errc()) break;
    if (at > time) break;
  }
  return lines.substr(0, kept);
}

std::string damageBefore(const std::string& lines, const std::string& kept, double time) {
  double next = 0, last = -std::numeric_limits<double>::infinity();
  const char* const end = lines.data() + lines.size();
  if (lines.find('\n', kept.size()) != std::string::npos) {
    if (std::from_chars(lines.data() + kept.size(), end, next).ec == std::errc()) return "";
    return fmt::format("line {} is no sample, so this line and those after it are lost",
                       std::count(kept.begin(), kept.end(), '\n') + 1);
  }
  const std::size_t before = kept.size() > 1 ? kept.rfind('\n', kept.size() - 2) : std::string::npos;
  const std::size_t start = before == std::string::npos ? 0 : before + 1;
  if (std::from_chars(kept.data() + start, kept.data() + kept.size(), last).ec != std::errc()) return "has no samples";
  return last < time ? fmt::format("its samples after t = {:g} s are lost", last) : "";
}

void removeUnlisted(const fs::path& folder, const ArchiveIndex& index) {
  std::vector<fs::path> unlisted;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool isWhole = entry.path().extension() != ".tmp";
    const fs::path output = isWhole ? entry.path() : entry.path().stem();
    const auto step = stepOf(output.stem().string());
    if (output.extension() == ".h5" && step && !(isWhole && index.lists(*step))) unlisted.push_back(entry.path());
  }
  std::error_code ignored;
  for (const fs::path& output : unlisted) fs::remove(output, ignored);
}

std::string fullerIndex(const fs::path& file, const std::string& kept, int step) {
  std::string found = textOf(file).value_or("");
  pugi::xml_document document;
  const bool isWhole =
      document.load_string(found.c_str()) && document.document_element().name() == std::string(ArchiveIndex::rootName);
  return isWhole && ArchiveIndex::sizeOf(found, step) >= ArchiveIndex::sizeOf(kept, step) ? found : kept;
}

}  // namespace tushar::output
