#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/error.hpp"

namespace tushar::input {

/// An XML attribute, and the location of its tag or of the option that overrides the attribute.
struct Attribute {
  std::string name;
  std::string value;
  Location where;
};

/// A tag or comment in a Document; it is read through Element.
struct Node {
  enum class Kind { tag, comment };

  Kind kind = Kind::tag;
  std::string name;  ///< name of the tag; empty for a comment
  std::string text;  ///< text of the tag or comment, without leading and trailing blanks
  Location where;
  std::vector<Attribute> attributes;
  std::vector<std::unique_ptr<Node>> children;
  const Node* parent = nullptr;
  bool isReadFirst = false;  ///< whether the tag is treated as if it were above its siblings

  /// Appends a child and returns it; the pointer stays valid as long as this node exists.
  Node& append(std::unique_ptr<Node> child) {
    child->parent = this;
    children.push_back(std::move(child));
    return *children.back();
  }
};

}  // namespace tushar::input
