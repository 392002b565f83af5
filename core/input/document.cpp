#include "core/input/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "core/input/override.hpp"
#include "core/input/text.hpp"
#include "core/input/xml_file.hpp"

namespace tushar::input {

namespace {

constexpr const char* rootName = "Uintah_specification";

/// Builds one tree from parsed files and the files that they include.
class TreeBuilder {
 public:
  explicit TreeBuilder(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  std::unique_ptr<Node> build(const XmlFile& file) {
    including_.push_back(file.name());
    auto root = makeTag(file, file.root());
    including_.pop_back();
    return root;
  }

 private:
  std::unique_ptr<Node> makeTag(const XmlFile& file, const pugi::xml_node& xml);
  void resolvePath(const XmlFile& file, Node& node);
  void addChildren(const XmlFile& file, const pugi::xml_node& xml, Node& parent);
  void addChild(const XmlFile& file, const pugi::xml_node& xml, Node& parent);
  void addAttributes(const pugi::xml_node& xml, Node& node);
  void addInclude(const XmlFile& file, const pugi::xml_node& xml, Node& parent);
  void addSection(const XmlFile& file, const pugi::xml_node& include, const Location& where, Node& parent);
  bool isCycle(const std::string& path, const Location& where);
  void checkAttributesOfInclude(const pugi::xml_node& xml, const Location& where);

  Diagnostics& diagnostics_;
  std::vector<std::string> including_;
};

/// The path of a file that is named in a tag.
struct FoundFile {
  std::string path;
  bool hasMoved = false;  ///< whether the file was found elsewhere than its path says
};

bool isFile(const std::filesystem::path& path) {
  std::error_code unreadable;
  return std::filesystem::is_regular_file(path, unreadable);
}

/// Whether there is a pair of files NAME.pts and NAME.tri, which describe a surface of triangles.
bool isPair(const std::filesystem::path& path) {
  return isFile(path.string() + ".pts") && isFile(path.string() + ".tri");
}

bool isThere(const std::filesystem::path& path) {
  std::error_code unreadable;
  return std::filesystem::exists(path, unreadable) || isPair(path);
}

/// Finds the file whose name a tag of `scene` gives: next to the scene, in a folder above it, in the folder where the
/// run is started or, finally, next to the scene without the folders in the tag.
FoundFile findFile(const std::string& path, const std::string& scene) {
  const std::filesystem::path beside = std::filesystem::absolute(scene).parent_path();
  const auto at = [&](const std::filesystem::path& folder) { return (folder / path).lexically_normal(); };
  std::error_code unreadable;
  for (std::filesystem::path folder = beside; folder.has_relative_path(); folder = folder.parent_path())
    if (isThere(at(folder))) return {at(folder).string()};
  const std::filesystem::path here = at(std::filesystem::current_path(unreadable));
  if (isThere(here)) return {here.string()};
  const std::filesystem::path moved = beside / std::filesystem::path(path).filename();
  if (isFile(moved) || isPair(moved)) return {moved.string(), true};
  return {at(beside).string()};
}

/// Whether the text of a tag is the path of a file, which must also be valid in the archive's copy of the scene.
bool isPath(const pugi::xml_node& xml) {
  const std::string_view name = xml.name(), parent = xml.parent().name();
  return name == "file" || name == "PrescribedDeformationFile" || name == "InsertParticlesFile" ||
         name == "cz_filename" || ((parent == "contact" || parent == "c2") && name == "filename") ||
         ((parent == "tri" || parent == "line_segment" || parent == "file") && name == "name");
}

/// Replaces the text of a tag by the absolute path of the file that it names. A scene that has been moved together with
/// its files may still name the old folder of the files.
void TreeBuilder::resolvePath(const XmlFile& file, Node& node) {
  const FoundFile found = findFile(node.text, file.name());
  if (found.hasMoved)
    diagnostics_.note(
        node.where, node.name,
        fmt::format("there is no '{}', so the file of the same name next to the scene is used", node.text));
  node.text = found.path;
}

std::unique_ptr<Node> TreeBuilder::makeTag(const XmlFile& file, const pugi::xml_node& xml) {
  auto node = std::make_unique<Node>();
  node->name = xml.name();
  node->where = file.locate(xml);
  addAttributes(xml, *node);
  addChildren(file, xml, *node);
  node->text = trimmed(node->text);
  if (isPath(xml) && !node->text.empty()) resolvePath(file, *node);
  return node;
}

void TreeBuilder::addChildren(const XmlFile& file, const pugi::xml_node& xml, Node& parent) {
  for (const pugi::xml_node& child : xml.children()) addChild(file, child, parent);
}

void TreeBuilder::addChild(const XmlFile& file, const pugi::xml_node& xml, Node& parent) {
  if (xml.type() == pugi::node_pcdata || xml.type() == pugi::node_cdata) {
    parent.text += xml.value();
  } else if (xml.type() == pugi::node_comment) {
    auto comment = std::make_unique<Node>();
    comment->kind = Node::Kind::comment;
    comment->text = xml.value();
    parent.append(std::move(comment));
  } else if (xml.type() == pugi::node_element && std::string_view(xml.name()) == "include") {
    addInclude(file, xml, parent);
  } else if (xml.type() == pugi::node_element) {
    parent.append(makeTag(file, xml));
  }
}

void TreeBuilder::addAttributes(const pugi::xml_node& xml, Node& node) {
  for (const pugi::xml_attribute& attribute : xml.attributes()) {
    if (xml.attribute(attribute.name()) != attribute) {
      diagnostics_.error(node.where, {},
                         fmt::format("attribute '{}' of <{}> is given twice", attribute.name(), node.name));
    } else {
      node.attributes.push_back({attribute.name(), trimmed(attribute.value()), node.where});
    }
  }
}

void TreeBuilder::checkAttributesOfInclude(const pugi::xml_node& xml, const Location& where) {
  const std::vector<std::string> known{"href", "section", "excludeSectionTag"};
  for (const pugi::xml_attribute& attribute : xml.attributes()) {
    const std::string name = attribute.name();
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    diagnostics_.error(where, {},
                       fmt::format("unknown attribute '{}' of <include>{}; allowed here: {}", name,
                                   didYouMean(name, known), listed(known)));
  }
}

bool TreeBuilder::isCycle(const std::string& path, const Location& where) {
  const auto same = [&](const std::string& other) {
    std::error_code ignored;
    return other == path || std::filesystem::equivalent(other, path, ignored);
  };
  if (std::none_of(including_.begin(), including_.end(), same)) return false;
  diagnostics_.error(where, {},
                     fmt::format("cannot include '{}': it includes itself, directly or through other files", path));
  return true;
}

/// The path of an included file. `href` is relative to the folder of the including file or, as in Uintah's scenes, to a
/// folder above it.
std::string findIncluded(const std::filesystem::path& beside, const std::string& href) {
  std::error_code ignored;
  const std::filesystem::path here =
      beside.empty() ? std::filesystem::current_path(ignored) : std::filesystem::absolute(beside, ignored);
  if (!std::filesystem::exists(here / href, ignored))
    for (std::filesystem::path above = here; above.has_relative_path();) {
      above = above.parent_path();
      if (std::filesystem::exists(above / href, ignored)) return (above / href).string();
    }
  return (beside / href).string();
}

void TreeBuilder::addInclude(const XmlFile& file, const pugi::xml_node& xml, Node& parent) {
  const Location where = file.locate(xml);
  checkAttributesOfInclude(xml, where);
  const std::string href = trimmed(xml.attribute("href").value());
  if (href.empty()) {
    diagnostics_.error(where, {}, "<include> needs the attribute 'href', the file to include");
    return;
  }
  const std::string path = findIncluded(std::filesystem::path(file.name()).parent_path(), href);
  if (isCycle(path, where)) return;
  const auto text = XmlFile::slurp(path, where, diagnostics_);
  if (!text) return;
  const XmlFile included(*text, path, diagnostics_);
  including_.push_back(path);
  if (included.root()) addSection(included, xml, where, parent);
  including_.pop_back();
}

std::vector<std::string> namesOfTags(const pugi::xml_node& xml) {
  std::set<std::string> names;
  for (const pugi::xml_node& child : xml.children()) {
    if (child.type() == pugi::node_element) names.insert(child.name());
  }
  return {names.begin(), names.end()};
}

void TreeBuilder::addSection(const XmlFile& file, const pugi::xml_node& include, const Location& where, Node& parent) {
  std::istringstream path(include.attribute("section").value());
  pugi::xml_node section = file.root();
  for (std::string name; std::getline(path, name, '/');) {
    const pugi::xml_node next = section.child(trimmed(name).c_str());
    if (!next) {
      diagnostics_.error(where, {},
                         fmt::format("there is no <{}> in <{}> of '{}'{}", trimmed(name), section.name(), file.name(),
                                     didYouMean(trimmed(name), namesOfTags(section))));
      return;
    }
    section = next;
  }
  const bool contentsOnly = trimmed(include.attribute("excludeSectionTag").value()) == "true" || section == file.root();
  !contentsOnly ? addChild(file, section, parent) : addChildren(file, section, parent);
}

std::unique_ptr<Node> bareRoot(const std::string& file) {
  auto node = std::make_unique<Node>();
  node->name = rootName;
  node->where = {file, 1, 1};
  return node;
}

void write(const Node& node, pugi::xml_node xml) {
  for (const Attribute& attribute : node.attributes) {
    xml.append_attribute(attribute.name.c_str()) = attribute.value.c_str();
  }
  if (!node.text.empty()) xml.append_child(pugi::node_pcdata).set_value(node.text.c_str());
  for (const auto& child : node.children) {
    if (child->kind == Node::Kind::comment) {
      xml.append_child(pugi::node_comment).set_value(child->text.c_str());
    } else {
      write(*child, xml.append_child(child->name.c_str()));
    }
  }
}

}  // namespace

Document Document::load(const std::string& path, Diagnostics& diagnostics) {
  const auto text = XmlFile::slurp(path, {path, 0, 0}, diagnostics);
  return text ? parse(*text, path, diagnostics) : Document(path, bareRoot(path));
}

Document Document::parse(std::string_view text, const std::string& name, Diagnostics& diagnostics) {
  const XmlFile file(text, name, diagnostics);
  if (!file.root()) return {name, bareRoot(name)};
  auto root = TreeBuilder(diagnostics).build(file);
  if (root->name != rootName) {
    diagnostics.error(root->where, {},
                      fmt::format("the outermost tag is <{}>, expected <{}>{}", root->name, rootName,
                                  didYouMean(root->name, {rootName})));
    root = bareRoot(name);
  }
  return {name, std::move(root)};
}

void Document::set(const std::string& change, Diagnostics& diagnostics) {
  const Location where{"--set " + change, 0, 0};
  if (const auto parsed = parseOverride(change, where, diagnostics)) apply(*parsed, *root_, where, diagnostics);
}

void Document::readFirst(std::string_view path) {
  std::vector<Node*> found{root_.get()};
  std::istringstream names{std::string(path)};
  for (std::string name; std::getline(names, name, '/');) {
    std::vector<Node*> below;
    for (const Node* node : found)
      for (const auto& child : node->children)
        if (child->name == name) below.push_back(child.get());
    found = std::move(below);
  }
  for (Node* node : found) node->isReadFirst = true;
}

std::string Document::text() const {
  pugi::xml_document document;
  auto declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  write(*root_, document.append_child(root_->name.c_str()));
  std::ostringstream out;
  document.save(out, "  ", pugi::format_default, pugi::encoding_utf8);
  return out.str();
}

}  // namespace tushar::input
