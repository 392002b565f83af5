#include "core/input/element.hpp"

namespace tushar::input {

std::string Element::path() const {
  if (!node_->parent) return {};
  const std::string above = Element(*node_->parent).path();
  return above.empty() ? name() : above + "/" + name();
}

std::optional<std::string> Element::attribute(std::string_view wanted) const {
  for (const Attribute& attribute : node_->attributes) {
    if (attribute.name == wanted) return attribute.value;
  }
  return std::nullopt;
}

const Location& Element::whereOf(std::string_view wanted) const {
  for (const Attribute& attribute : node_->attributes) {
    if (attribute.name == wanted) return attribute.where;
  }
  return where();
}

std::optional<Element> Element::child(std::string_view wanted) const {
  for (const auto& node : node_->children) {
    if (node->name == wanted) return Element(*node);
  }
  return std::nullopt;
}

std::vector<Element> Element::children() const {
  std::vector<Element> found;
  for (const auto& node : node_->children) {
    if (node->kind == Node::Kind::tag) found.emplace_back(*node);
  }
  return found;
}

std::vector<Element> Element::children(std::string_view wanted) const {
  std::vector<Element> found;
  for (const auto& node : node_->children) {
    if (node->name == wanted) found.emplace_back(*node);
  }
  return found;
}

std::optional<Element> Element::parent() const {
  if (!node_->parent) return std::nullopt;
  return Element(*node_->parent);
}

}  // namespace tushar::input
