#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"
#include "core/input/node.hpp"

namespace tushar::input {

/// A tag of a scene: a handle, cheap to copy, valid as long as its Document lives.
class Element {
 public:
  explicit Element(const Node& node) : node_(&node) {}

  const std::string& name() const { return node_->name; }
  /// The tag's own text, without blanks at its ends.
  const std::string& text() const { return node_->text; }
  /// The place of the tag's name, or the option that overrides it.
  const Location& where() const { return node_->where; }
  /// The path of tags from the root (excluded) down to this one: `Grid/Level/Box/resolution`.
  std::string path() const;

  std::optional<std::string> attribute(std::string_view name) const;
  /// The place of an attribute; that of the tag if the attribute is not given.
  const Location& whereOf(std::string_view attribute) const;
  const std::vector<Attribute>& attributes() const { return node_->attributes; }

  /// The first child of that name, if any.
  std::optional<Element> child(std::string_view name) const;
  /// All children, in the order of the file.
  std::vector<Element> children() const;
  std::vector<Element> children(std::string_view name) const;
  /// The tag that contains this one; none for the root.
  std::optional<Element> parent() const;
  /// Whether it is treated as if it were above its siblings (Document::readFirst).
  bool isReadFirst() const { return node_->isReadFirst; }

  /// Whether both are the same tag of the same document.
  friend bool operator==(const Element&, const Element&) = default;

 private:
  const Node* node_;
};

}  // namespace tushar::input
