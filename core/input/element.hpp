#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"
#include "core/input/node.hpp"

namespace tushar::input {

/// A tag of a scene: a handle that is cheap to copy and valid as long as its Document exists.
class Element {
 public:
  explicit Element(const Node& node) : node_(&node) {}

  const std::string& name() const { return node_->name; }
  /// The tag's own text, without leading and trailing blanks.
  const std::string& text() const { return node_->text; }
  /// The location of the tag's name, or of the option that overrides the tag.
  const Location& where() const { return node_->where; }
  /// The path of tags from the root (excluded) down to this one: `Grid/Level/Box/resolution`.
  std::string path() const;

  std::optional<std::string> attribute(std::string_view name) const;
  /// The location of an attribute, or of the tag if the attribute is not given.
  const Location& whereOf(std::string_view attribute) const;
  const std::vector<Attribute>& attributes() const { return node_->attributes; }

  /// The first child with this name, if any.
  std::optional<Element> child(std::string_view name) const;
  /// All children, in the order in which they appear in the file.
  std::vector<Element> children() const;
  std::vector<Element> children(std::string_view name) const;
  /// The tag that contains this one; none for the root.
  std::optional<Element> parent() const;
  /// Whether the tag is treated as if it were above its siblings (Document::readFirst).
  bool isReadFirst() const { return node_->isReadFirst; }

  /// Whether two handles refer to the same tag of the same document.
  friend bool operator==(const Element&, const Element&) = default;

 private:
  const Node* node_;
};

}  // namespace tushar::input
