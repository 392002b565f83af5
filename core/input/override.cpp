#include "core/input/override.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "core/input/text.hpp"

namespace tushar::input {

namespace {

bool isName(std::string_view text) {
  const auto starts = [](unsigned char c) { return std::isalpha(c) || c == '_'; };
  const auto continues = [&](unsigned char c) {
    return starts(c) || std::isdigit(c) || c == '-' || c == '.' || c == ':';
  };
  return !text.empty() && starts(static_cast<unsigned char>(text[0])) &&
         std::all_of(text.begin(), text.end(), continues);
}

/// The position of the first character `wanted` outside square brackets.
std::size_t findOutside(std::string_view text, char wanted) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == wanted && depth == 0) return i;
    if (text[i] == '[') ++depth;
    if (text[i] == ']') --depth;
  }
  return std::string_view::npos;
}

std::vector<std::string> splitPath(std::string_view path) {
  std::vector<std::string> parts;
  for (std::size_t end; (end = findOutside(path, '/')) != std::string_view::npos; path.remove_prefix(end + 1)) {
    parts.push_back(trimmed(path.substr(0, end)));
  }
  parts.push_back(trimmed(path));
  return parts;
}

/// Reads `@label='left'`, with either kind of quotes or none.
bool readSelector(std::string_view inside, OverrideStep& step) {
  const std::size_t equals = inside.find('=');
  if (inside.empty() || inside[0] != '@' || equals == std::string_view::npos) return false;
  step.attribute = trimmed(inside.substr(1, equals - 1));
  step.value = trimmed(inside.substr(equals + 1));
  const auto isQuote = [](char c) { return c == '\'' || c == '"'; };
  if (step.value.size() >= 2 && isQuote(step.value.front()) && step.value.front() == step.value.back()) {
    step.value = step.value.substr(1, step.value.size() - 2);
  }
  return isName(step.attribute);
}

bool readIndex(std::string_view inside, OverrideStep& step) {
  const auto [end, error] = std::from_chars(inside.data(), inside.data() + inside.size(), step.index);
  return error == std::errc() && end == inside.data() + inside.size() && step.index >= 1;
}

std::optional<OverrideStep> readStep(std::string_view part) {
  const std::size_t open = part.find('[');
  OverrideStep step;
  step.name = trimmed(part.substr(0, open));
  if (!isName(step.name)) return std::nullopt;
  if (open == std::string_view::npos) return step;
  if (part.back() != ']') return std::nullopt;
  const std::string inside = trimmed(part.substr(open + 1, part.size() - open - 2));
  if (readIndex(inside, step)) return step;
  step.index = 0;
  return readSelector(inside, step) ? std::optional(step) : std::nullopt;
}

Attribute* findAttribute(Node& node, std::string_view name) {
  const auto found =
      std::find_if(node.attributes.begin(), node.attributes.end(), [&](const Attribute& a) { return a.name == name; });
  return found == node.attributes.end() ? nullptr : &*found;
}

std::vector<Node*> matches(const Node& parent, const OverrideStep& step) {
  std::vector<Node*> found;
  for (const auto& child : parent.children) {
    if (child->name != step.name) continue;
    const Attribute* selected = step.attribute.empty() ? nullptr : findAttribute(*child, step.attribute);
    if (step.attribute.empty() || (selected && selected->value == step.value)) found.push_back(child.get());
  }
  return found;
}

Node& create(Node& parent, const std::string& name, const Location& where) {
  auto node = std::make_unique<Node>();
  node->name = name;
  node->where = where;
  return parent.append(std::move(node));
}

/// The reason why `step` does not match exactly one tag among `found`; empty if it does.
std::string stepProblem(const Node& parent, const OverrideStep& step, std::size_t found) {
  if (step.index > 0) {
    if (static_cast<std::size_t>(step.index) <= found + 1) return {};
    return fmt::format("there is no {}[{}]: <{}> has {} of them", step.name, step.index, parent.name, found);
  }
  if (!step.attribute.empty() && found == 0) {
    return fmt::format("there is no <{}> in <{}> with {}='{}'", step.name, parent.name, step.attribute, step.value);
  }
  if (found <= 1) return {};
  return fmt::format("{} tags <{}> in <{}> match; choose one, such as {}[1] or {}[@label='…']", found, step.name,
                     parent.name, step.name, step.name);
}

/// The only child that `step` matches, created if it is missing; null after an error.
Node* follow(Node& parent, const OverrideStep& step, const Location& where, Diagnostics& diagnostics) {
  const std::vector<Node*> found = matches(parent, step);
  const std::string problem = stepProblem(parent, step, found.size());
  if (!problem.empty()) {
    diagnostics.error(where, {}, problem);
    return nullptr;
  }
  const std::size_t chosen = step.index > 0 ? step.index - 1 : 0;
  return chosen < found.size() ? found[chosen] : &create(parent, step.name, where);
}

void setAttribute(Node& node, const std::string& name, const std::string& value, const Location& where) {
  if (Attribute* attribute = findAttribute(node, name)) {
    *attribute = {name, value, where};
  } else {
    node.attributes.push_back({name, value, where});
  }
}

}  // namespace

std::optional<Override> parseOverride(std::string_view text, const Location& where, Diagnostics& diagnostics) {
  const std::size_t equals = findOutside(text, '=');
  if (equals == std::string_view::npos || trimmed(text.substr(0, equals)).empty()) {
    diagnostics.error(where, {}, "expected PATH=VALUE, such as Time/maxTime=0.2");
    return std::nullopt;
  }
  std::vector<std::string> parts = splitPath(text.substr(0, equals));
  Override change;
  change.value = trimmed(text.substr(equals + 1));
  if (parts.back().starts_with('@') && isName(parts.back().substr(1))) {
    change.attribute = parts.back().substr(1);
    parts.pop_back();
  }
  for (const std::string& part : parts) {
    const std::optional<OverrideStep> step = readStep(part);
    if (!step) {
      diagnostics.error(where, {}, fmt::format("found '{}', expected Tag, Tag[2] or Tag[@label='…']", part));
      return std::nullopt;
    }
    change.steps.push_back(*step);
  }
  return change;
}

void apply(const Override& change, Node& root, const Location& where, Diagnostics& diagnostics) {
  Node* node = &root;
  for (const OverrideStep& step : change.steps) {
    node = follow(*node, step, where, diagnostics);
    if (!node) return;
  }
  if (change.attribute.empty()) {
    node->text = change.value;
    node->where = where;
  } else {
    setAttribute(*node, change.attribute, change.value, where);
  }
}

}  // namespace tushar::input
