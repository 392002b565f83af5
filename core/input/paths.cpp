#include "core/input/paths.hpp"

#include <fmt/format.h>

#include <map>

namespace tushar::input {

namespace {

void add(const Element& parent, const std::string& above, std::vector<std::string>& paths) {
  std::map<std::string, int> seen;
  for (const Element& child : parent.children()) {
    const int number = ++seen[child.name()];
    const bool isAlone = parent.children(child.name()).size() == 1;
    const std::string path = above + child.name() + (isAlone ? "" : fmt::format("[{}]", number));
    if (child.children().empty() && (child.attributes().empty() || !child.text().empty())) paths.push_back(path);
    for (const Attribute& attribute : child.attributes()) paths.push_back(path + "/@" + attribute.name);
    add(child, path + "/", paths);
  }
}

}  // namespace

std::vector<std::string> settablePaths(const Element& root) {
  std::vector<std::string> paths;
  add(root, "", paths);
  return paths;
}

}  // namespace tushar::input
