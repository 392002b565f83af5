#pragma once

#include <ostream>
#include <pugixml.hpp>
#include <string>

namespace tushar::input {

/// Starts an XML file with a comment, and returns its root element.
inline pugi::xml_node startFile(pugi::xml_document& file, const char* root, const std::string& comment) {
  pugi::xml_node declaration = file.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  file.append_child(pugi::node_comment).set_value(comment.c_str());
  return file.append_child(root);
}

inline void writeFile(const pugi::xml_document& file, std::ostream& out) {
  file.save(out, " ", pugi::format_default, pugi::encoding_utf8);
}

/// Adds an element with the attribute `name`.
inline pugi::xml_node named(pugi::xml_node parent, const char* kind, const std::string& name) {
  pugi::xml_node child = parent.append_child(kind);
  child.append_attribute("name") = name.c_str();
  return child;
}

}  // namespace tushar::input
