#include "core/output/archive_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <sstream>
#include <string_view>
#include <utility>

#include "core/base/joined.hpp"
#include "core/output/archive_files.hpp"
#include "core/output/archive_snapshot.hpp"
#include "core/output/archive_xml.hpp"

namespace tushar::output {

namespace {

std::string typeOf(const Array& array) {
  constexpr const char* names[] = {"double", "uint64", "int32"};
  return names[array.values.index()];
}

std::string endOfRoot() { return fmt::format("</{}>\n", ArchiveIndex::rootName); }

std::set<std::string> separated(const std::string& names) {
  constexpr std::string_view comma = ", ";
  std::set<std::string> all;
  for (std::size_t from = 0, to; from < names.size(); from = to + comma.size()) {
    to = std::min(names.find(comma, from), names.size());
    all.insert(names.substr(from, to - from));
  }
  return all;
}

}  // namespace

ArchiveIndex::ArchiveIndex(std::string version, const std::string& text, int step) : version_(std::move(version)) {
  pugi::xml_document document;
  document.load_string(text.c_str());
  const pugi::xml_node root = document.child(rootName);
  format_ = root.attribute("format").as_int(uniformFormat);
  const auto word = [](const pugi::xml_node& node, const char* name) { return node.attribute(name).as_string(); };
  for (const pugi::xml_node& node : root.child("variables"))
    variables_[word(node, "name")] = {word(node, "centring"),
                                      word(node, "unit"),
                                      word(node, "description"),
                                      word(node, "type"),
                                      node.attribute("components").as_int(),
                                      separated(word(node, "materials"))};
  for (const pugi::xml_node& node : root.child("globals"))
    globals_[word(node, "name")] = {word(node, "unit"), word(node, "description"), word(node, "href"),
                                    node.attribute("components").as_uint()};
  for (const pugi::xml_node& node : root.child("timesteps"))
    if (const int at = node.text().as_int(); at <= step)
      outputs_[at] = {node.attribute("time").as_double(), node.attribute("delT").as_double()};
}

std::string ArchiveIndex::refusalOf(const std::string& text) {
  pugi::xml_document document;
  document.load_string(text.c_str());
  const pugi::xml_node root = document.child(rootName);
  const int found = root.attribute("format").as_int();
  return found <= format ? ""
                         : fmt::format(
                               "the archive has format {}, but this sus supports only formats up to {}; it was written "
                               "by version {}",
                               found, format, root.attribute("version").as_string());
}

std::vector<std::string> ArchiveIndex::globals() const {
  std::vector<std::string> names;
  for (const auto& global : globals_) names.push_back(global.first);
  return names;
}

std::string ArchiveIndex::labelOf(const std::string& nameInFile) const {
  for (const auto& variable : variables_)
    if (nameInPath(variable.first) == nameInFile) return variable.first;
  return nameInFile;
}

std::vector<int> ArchiveIndex::steps() const {
  std::vector<int> all;
  for (const auto& output : outputs_) all.push_back(output.first);
  return all;
}

bool ArchiveIndex::addVariable(const Array& array, const std::string& centring, const std::string& material) {
  const auto [place, isNew] = variables_.try_emplace(array.label);
  Variable variable{centring, array.unit, array.description, typeOf(array), array.components, place->second.materials};
  const bool isNewOf = !material.empty() && variable.materials.insert(material).second;
  if (variable == place->second) return false;
  place->second = std::move(variable);
  head_.clear();
  return isNewOf || isNew;
}

bool ArchiveIndex::add(const Snapshot& snapshot) {
  bool isNew = false;
  for (const ParticleBlock& block : snapshot.particles)
    for (const Array& array : block.arrays)
      if (isHeld(block, array)) isNew |= addVariable(array, "particle", groupName(block.material, block.materialIndex));
  for (const FieldBlock& field : snapshot.fields)
    isNew |= addVariable(field.array, field.centring == Centring::cell ? "cell" : "node",
                         field.materialIndex < 0 ? "" : groupName(field.material, field.materialIndex));
  if (!snapshot.grid.boxes.empty() && format_ != format) {
    format_ = format;
    head_.clear();
  }
  outputs_[snapshot.step] = {snapshot.time, snapshot.delT};
  return isNew;
}

void ArchiveIndex::add(const GlobalSample& sample, const std::string& file) {
  Global& global = globals_[sample.name];
  Global now{sample.unit, sample.description, file, sample.values.size()};
  if (now == global) return;
  global = std::move(now);
  head_.clear();
}

const std::string& ArchiveIndex::head() const {
  if (!head_.empty()) return head_;
  pugi::xml_document document;
  pugi::xml_node root = document.append_child(rootName);
  set(root, "format", format_, "version", version_);
  pugi::xml_node variables = root.append_child("variables");
  for (const auto& [name, variable] : variables_) {
    pugi::xml_node node = variables.append_child("variable");
    set(node, "name", name, "centring", variable.centring, "type", variable.type, "components", variable.components,
        "unit", variable.unit, "description", variable.description);
    if (!variable.materials.empty()) set(node, "materials", joined(variable.materials, ", "));
  }
  pugi::xml_node globals = root.append_child("globals");
  for (const auto& [name, global] : globals_) {
    pugi::xml_node node = globals.append_child("global");
    set(node, "name", name, "href", global.file, "components", global.components, "unit", global.unit, "description",
        global.description);
  }
  const std::string text = textOf(root, 0);
  head_ = std::string(xmlDeclaration) + text.substr(0, text.size() - endOfRoot().size());
  return head_;
}

/// Writes the index; outputs are written directly as text, because there are many.
void ArchiveIndex::write(std::ostream& out) const {
  const std::string end = endOfRoot();
  out << head();
  if (outputs_.empty()) out << " <timesteps />\n" << end;
  if (outputs_.empty()) return;
  out << " <timesteps>\n";
  for (const auto& [step, output] : outputs_)
    out << fmt::format("  <timestep href=\"{}\" time=\"{}\" delT=\"{}\">{}</timestep>\n", outputName(step), output.time,
                       output.delT, step);
  out << " </timesteps>\n" << end;
}

std::string ArchiveIndex::text() const {
  std::ostringstream out;
  write(out);
  return std::move(out).str();
}

}  // namespace tushar::output
