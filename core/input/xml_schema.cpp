#include "core/input/xml_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>
#include <pugixml.hpp>
#include <set>

#include "core/base/joined.hpp"
#include "core/input/schema_file.hpp"
#include "core/input/value_types.hpp"

namespace tushar::input {

namespace {

using Place = SchemaEntry::Place;
using Form = SchemaEntry::Form;
using pugi::xml_node;

void annotate(xml_node parent, const std::string& text) {
  if (text.empty()) return;
  parent.append_child("xs:annotation").append_child("xs:documentation").text() = text.c_str();
}

void restrict(xml_node type, const char* base, const char* facet, const std::vector<std::string>& values) {
  xml_node restriction = type.append_child("xs:restriction");
  restriction.append_attribute("base") = base;
  for (const std::string& value : values) restriction.append_child(facet).append_attribute("value") = value.c_str();
}

/// All allowed forms of the tags or attributes of one name, collected from all declarations.
class Uses {
 public:
  std::vector<TagForm> values;
  std::vector<Alternative> sections;
  bool mayBeAnything = false;
  std::string documentation;

  void add(const TagForm& form) {
    mayBeAnything = mayBeAnything || form.kind == TagForm::Kind::anything;
    if (form.kind == TagForm::Kind::value) addValue(form);
    if (form.kind != TagForm::Kind::section) return;
    for (const Alternative& one : form.alternatives())
      if (std::none_of(sections.begin(), sections.end(), [&](const auto& known) { return keyOf(known) == keyOf(one); }))
        sections.push_back(one);
  }
  static std::string keyOf(const Alternative& section) {
    std::string key = fmt::format("{}", static_cast<const void*>(section.schema));
    for (const Demand& demand : section.demands) key += fmt::format(" {}={}", demand.name, joined(demand.words, ","));
    return key;
  }

 private:
  void addValue(const TagForm& form) {
    const auto isSame = [&](const TagForm& known) {
      return known.type == form.type && known.choices == form.choices && known.pattern == form.pattern;
    };
    if (std::none_of(values.begin(), values.end(), isSame)) values.push_back(form);
  }
};

/// Uses sorted by name, in the order in which the names first occur.
struct UsesByName {
  std::vector<std::pair<std::string, Uses>> all;

  Uses& operator[](const std::string& name) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.first == name; });
    return found != all.end() ? found->second : all.emplace_back(name, Uses{}).second;
  }
};

class Writer {
 public:
  explicit Writer(xml_node schema) : schema_(schema) {}

  void write(const TagForm& root) {
    Uses uses;
    uses.add(root);
    xml_node element = named(schema_, "xs:element", root.tags.front());
    element.append_attribute("type") = typeOf(root.tags.front(), uses).c_str();
    for (bool isRoot = true; !pending_.empty(); isRoot = false) {
      const auto [name, sections] = std::move(pending_.front());
      pending_.pop_front();
      writeSection(name, sections, isRoot);
    }
    writeTypes();
  }

 private:
  /// The name of the type of a tag; empty if the type is defined inside the tag's declaration.
  std::string typeOf(const std::string& tag, const Uses& uses) {
    if (uses.mayBeAnything || (!uses.sections.empty() && !uses.values.empty())) return "xs:anyType";
    if (uses.sections.empty()) return "";
    std::set<std::string> parts;
    for (const Alternative& one : uses.sections) parts.insert(Uses::keyOf(one));
    auto [found, isNew] = names_.try_emplace(fmt::format("{} {}", tag, joined(parts, ";")));
    if (isNew) {
      const int count = ++counts_[tag];
      found->second = count == 1 ? tag + "-tag" : fmt::format("{}-tag-{}", tag, count);
      pending_.emplace_back(found->second, uses.sections);
    }
    return found->second;
  }

  void writeSection(const std::string& name, const std::vector<Alternative>& sections, bool isRoot) {
    UsesByName tags, attributes;
    bool hasText = false;
    for (const Alternative& section : sections)
      for (const SchemaEntry& entry : section.schema->entries()) {
        hasText = hasText || entry.place == Place::text;
        if (entry.place == Place::attribute) addAttribute(attributes[entry.name], entry, section.demands);
        if (entry.place == Place::tag) addTags(tags, entry);
      }
    xml_node type = named(schema_, "xs:complexType", name);
    if (hasText) type.append_attribute("mixed") = "true";
    annotate(type, sections.front().schema->sentence());
    if (!tags.all.empty()) writeTags(type, tags);
    for (const auto& [attribute, uses] : attributes.all) {
      xml_node one = named(type, "xs:attribute", attribute);
      annotate(one, uses.documentation);
      writeValue(one, uses);
    }
    if (isRoot) type.append_child("xs:anyAttribute").append_attribute("processContents") = "skip";
  }

  static void addAttribute(Uses& uses, const SchemaEntry& entry, const std::vector<Demand>& demands) {
    if (uses.documentation.empty()) uses.documentation = documentationOf(entry);
    const Demand* demand = findDemand(demands, entry.name);
    if (demand && !demand->words.empty())
      uses.add(choiceForm({entry.name}, demand->words));
    else if (entry.form == Form::value)
      uses.add(formsOf(entry).front());
    else
      uses.mayBeAnything = true;
  }

  static void addTags(UsesByName& tags, const SchemaEntry& entry) {
    for (const TagForm& form : formsOf(entry))
      for (const std::string& tag : form.tags) {
        if (form.kind == TagForm::Kind::nothing) continue;
        Uses& uses = tags[tag];
        uses.add(form);
        if (uses.documentation.empty()) uses.documentation = documentationOf(entry);
      }
  }

  void writeTags(xml_node type, const UsesByName& tags) {
    xml_node choice = type.append_child("xs:choice");
    choice.append_attribute("minOccurs") = "0";
    choice.append_attribute("maxOccurs") = "unbounded";
    for (const auto& [tag, uses] : tags.all) {
      xml_node element = named(choice, "xs:element", tag);
      const std::string name = typeOf(tag, uses);
      if (!name.empty()) element.append_attribute("type") = name.c_str();
      annotate(element, uses.documentation);
      if (name.empty()) writeValue(element, uses);
    }
    xml_node other = named(choice, "xs:element", "include");
    other.append_attribute("type") = "include";
  }

  /// Writes the type of a value inside the declaration of its tag or attribute.
  static void writeValue(xml_node parent, const Uses& uses) {
    xml_node type = parent.append_child("xs:simpleType");
    if (uses.mayBeAnything) return restrict(type, "xs:string", "", {});
    if (uses.values.size() == 1) return restrictTo(type, uses.values.front());
    xml_node all = type.append_child("xs:union");
    for (const TagForm& form : uses.values) restrictTo(all.append_child("xs:simpleType"), form);
  }

  static void restrictTo(xml_node type, const TagForm& form) {
    if (!form.pattern.empty()) return restrict(type, "xs:token", "xs:pattern", {form.pattern});
    if (form.choices.empty()) return restrict(type, ("value-" + valueTypeOf(form.type).name).c_str(), "", {});
    restrict(type, form.type.empty() ? "xs:token" : "xs:double", "xs:enumeration", form.choices);
  }

  void writeTypes() {
    for (const ValueType& type : valueTypes())
      restrict(named(schema_, "xs:simpleType", "value-" + type.name), "xs:token", "xs:pattern", {type.pattern});
    xml_node other = named(schema_, "xs:complexType", "include");
    other.append_attribute("mixed") = "true";
    annotate(other, "Is replaced by the contents of another file.");
    for (const char* name : {"href", "section", "excludeSectionTag"})
      named(other, "xs:attribute", name).append_attribute("type") = "xs:string";
  }

  xml_node schema_;
  std::map<std::string, std::string> names_;
  std::map<std::string, int> counts_;
  std::deque<std::pair<std::string, std::vector<Alternative>>> pending_;
};

}  // namespace

void writeXmlSchema(std::ostream& out, const TagForm& root, const std::string& comment) {
  pugi::xml_document file;
  xml_node schema = startFile(file, "xs:schema", comment);
  schema.append_attribute("xmlns:xs") = "http://www.w3.org/2001/XMLSchema";
  Writer(schema).write(root);
  writeFile(file, out);
}

}  // namespace tushar::input
