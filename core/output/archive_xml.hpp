#pragma once

#include <fmt/format.h>

#include <pugixml.hpp>
#include <sstream>
#include <string>

namespace tushar::output {

/// Sets attributes, name by value; numbers are written so that they read back exactly.
template <class Value, class... More>
void set(pugi::xml_node node, const char* name, const Value& value, const More&... more) {
  node.append_attribute(name) = fmt::format("{}", value).c_str();
  if constexpr (sizeof...(more) > 0) set(node, more...);
}

/// The document as text.
inline std::string textOf(const pugi::xml_document& document) {
  std::ostringstream out;
  document.save(out, " ");
  return out.str();
}

}  // namespace tushar::output
