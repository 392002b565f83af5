#pragma once

#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/input/diagnostics.hpp"
#include "core/input/nesting.hpp"

namespace tushar::input {

/// One parsed XML file with the line and column of each node.
class XmlFile {
 public:
  /// Reads the file into memory; on failure, returns none and reports an error at `where`, the tag that names the file.
  static std::optional<std::string> slurp(const std::string& path, const Location& where, Diagnostics& diagnostics);

  /// Parses `text`; messages refer to it by `name`. Text declared to be ISO-8859-1 is converted to UTF-8.
  XmlFile(std::string_view text, std::string name, Diagnostics& diagnostics);

  /// The outermost tag; empty if the file is malformed.
  pugi::xml_node root() const { return document_.document_element(); }
  const std::string& name() const { return name_; }
  Location locate(const pugi::xml_node& node) const { return locate(node.offset_debug()); }

 private:
  Location locate(std::ptrdiff_t offset) const;
  void parse(Diagnostics& diagnostics);
  std::string sentence(const BadNesting& bad) const;

  std::string name_;
  std::string text_;
  std::vector<std::ptrdiff_t> lineStarts_{0};
  pugi::xml_document document_;
};

}  // namespace tushar::input
