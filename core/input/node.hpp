#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/error.hpp"

namespace tushar::input {

/// An XML attribute and its place: that of its tag, or the option that overrides it.
struct Attribute {
  std::string name;
  std::string value;
  Location where;
};

/// A tag or comment in a Document; to be read through Element.
struct Node {
  enum class Kind { tag, comment };

  Kind kind = Kind::tag;
  std::string name;  ///< empty for a comment
  std::string text;  ///< text of the tag or comment, without blanks at its ends
  Location where;
  std::vector<Attribute> attributes;
  std::vector<std::unique_ptr<Node>> children;
  const Node* parent = nullptr;
  bool isReadFirst = false;  ///< is treated as if it were above its siblings

  /// Appends a child and returns it; the pointer stays valid for the life of this node.
  Node& append(std::unique_ptr<Node> child) {
    child->parent = this;
    children.push_back(std::move(child));
    return *children.back();
  }
};

}  // namespace tushar::input
