#pragma once

#include <fmt/format.h>

#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace tushar::output {

/// Sets attributes, given as alternating names and values; numbers are written so that they are read back exactly.
template <class Value, class... More>
void set(pugi::xml_node node, const char* name, const Value& value, const More&... more) {
  node.append_attribute(name) = fmt::format("{}", value).c_str();
  if constexpr (sizeof...(more) > 0) set(node, more...);
}

/// A node as text, indented for its depth in the document.
inline std::string textOf(const pugi::xml_node& node, unsigned depth) {
  struct Text : pugi::xml_writer {
    std::string all;
    void write(const void* data, std::size_t size) override { all.append(static_cast<const char*>(data), size); }
  } text;
  node.print(text, " ", pugi::format_default, pugi::encoding_utf8, depth);
  return std::move(text.all);
}

/// The first line of the XML files of an archive.
constexpr std::string_view xmlDeclaration = "<?xml version=\"1.0\"?>\n";

}  // namespace tushar::output
