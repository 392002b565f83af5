#include "core/input/relax_ng.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <pugixml.hpp>

#include "core/base/joined.hpp"
#include "core/input/schema_file.hpp"
#include "core/input/value_types.hpp"

namespace tushar::input {

namespace {

using Place = SchemaEntry::Place;
using Form = SchemaEntry::Form;
using pugi::xml_node;

constexpr const char* anything = "anything";
constexpr const char* include = "include";

void document(xml_node parent, const std::string& text) {
  if (!text.empty()) parent.append_child("a:documentation").text() = text.c_str();
}

void refer(xml_node parent, const std::string& name) { named(parent, "ref", name); }

void writePattern(xml_node parent, const std::string& pattern) {
  xml_node data = parent.append_child("data");
  data.append_attribute("type") = "token";
  named(data, "param", "pattern").text() = pattern.c_str();
}

/// Writes a choice of words, which are compared as numbers if `asNumbers` is true.
void writeWords(xml_node parent, const std::vector<std::string>& words, bool asNumbers) {
  xml_node choice = words.size() == 1 ? parent : parent.append_child("choice");
  for (const std::string& word : words) {
    xml_node value = choice.append_child("value");
    if (asNumbers) value.append_attribute("type") = "double";
    value.text() = word.c_str();
  }
}

void writeValue(xml_node parent, const TagForm& form) {
  if (!form.pattern.empty())
    writePattern(parent, form.pattern);
  else if (!form.choices.empty())
    writeWords(parent, form.choices, !form.type.empty());
  else
    refer(parent, "value-" + valueTypeOf(form.type).name);
}

/// Writes the allowed number of occurrences into `parent`; returns the node for the content.
xml_node often(xml_node parent, int atLeast, bool repeats) {
  if (repeats) return parent.append_child(atLeast > 0 ? "oneOrMore" : "zeroOrMore");
  return atLeast > 0 ? parent : parent.append_child("optional");
}

bool isTag(const SchemaEntry& entry) { return entry.place == Place::tag; }

/// A grammar, with one definition for each form of a tag.
class Grammar {
 public:
  explicit Grammar(xml_node grammar) : grammar_(grammar) {}

  void write(const TagForm& root) {
    xml_node start = grammar_.append_child("start").append_child("choice");
    referToTag(start, root, root.tags.front(), "");
    root_names_ = pending_.size();
    for (std::size_t k = 0; !pending_.empty(); ++k) {
      const Pending next = std::move(pending_.front());
      pending_.pop_front();
      xml_node element = named(named(grammar_, "define", next.name), "element", next.tag);
      next.fill(element);
      if (k < root_names_) allowOtherAttributes(element);
    }
    writeTypes();
  }

 private:
  struct Pending {
    std::string name, tag;
    std::function<void(xml_node)> fill;
  };

  /// Returns the name of the definition of `key`; on first use, calls `fill` to write the content of its element.
  std::string define(const std::string& key, const std::string& tag, std::function<void(xml_node)> fill) {
    auto [found, isNew] = names_.try_emplace(key);
    if (isNew) {
      const int count = ++counts_[tag];
      found->second = count == 1 ? tag + "-tag" : fmt::format("{}-tag-{}", tag, count);
      pending_.push_back({found->second, tag, std::move(fill)});
    }
    return found->second;
  }

  static std::string keyOf(const std::string& tag, const void* what, const std::vector<Demand>& demands) {
    std::string key = fmt::format("{} {}", tag, what);
    for (const Demand& demand : demands) key += fmt::format(" {}={}", demand.name, joined(demand.words, ","));
    return key;
  }

  /// Writes references to all forms of a tag.
  void referToTag(xml_node parent, const TagForm& form, const std::string& tag, const std::string& documentation) {
    if (form.kind == TagForm::Kind::section) {
      for (const Alternative& alternative : form.alternatives())
        refer(parent,
              define(keyOf(tag, alternative.schema, alternative.demands), tag, [this, alternative](xml_node to) {
                document(to, alternative.schema->sentence());
                writeContents(to, *alternative.schema, alternative.demands);
              }));
      return;
    }
    const std::string key = fmt::format("{} {} {} {} {} {}", keyOf(tag, nullptr, form.demands), form.type, form.pattern,
                                        joined(form.choices, ","), static_cast<int>(form.kind), documentation);
    refer(parent, define(key, tag, [form, documentation](xml_node to) {
            document(to, documentation);
            form.kind == TagForm::Kind::value ? writeValue(to, form) : writeAnything(to, form.demands);
          }));
  }

  /// Writes a tag with the allowed number of occurrences.
  void writeTag(xml_node parent, TagForm form, const std::string& tag, const std::string& documentation,
                const Demand* demand, bool isOptional) {
    if (demand && !demand->words.empty()) form.choices = demand->words;
    const int atLeast = isOptional ? 0 : std::max(form.atLeast, demand ? 1 : 0);
    xml_node place = atLeast > 1 ? parent.append_child("group") : parent;
    for (int k = 1; k < atLeast; ++k) referToOne(place, form, tag, documentation);
    referToOne(often(place, atLeast, form.repeats), form, tag, documentation);
  }

  void referToOne(xml_node parent, const TagForm& form, const std::string& tag, const std::string& documentation) {
    const bool isOne = form.kind != TagForm::Kind::section || form.alternatives().size() == 1;
    referToTag(isOne ? parent : parent.append_child("choice"), form, tag, documentation);
  }

  /// Writes tags of which at least `atLeast` must be given, in any combination.
  void writeAnyOf(xml_node parent, const SchemaEntry& entry, int atLeast) {
    const auto choose = [&](xml_node place) {
      xml_node choice = place.append_child("choice");
      for (const TagForm& form : formsOf(entry))
        for (const std::string& tag : form.tags) referToTag(choice, form, tag, documentationOf(entry));
    };
    xml_node place = atLeast > 1 ? parent.append_child("group") : parent;
    for (int k = 1; k < atLeast; ++k) choose(place);
    choose(often(place, atLeast, true));
  }

  void writeTags(xml_node interleave, const SchemaBase& schema, const std::vector<Demand>& demands, bool areOptional) {
    for (const SchemaEntry& entry : schema.entries()) {
      if (!isTag(entry)) continue;
      if (entry.form == Form::custom && entry.atLeast > 0) {
        writeAnyOf(interleave, entry, areOptional ? 0 : entry.atLeast);
        continue;
      }
      for (const TagForm& form : formsOf(entry))
        for (const std::string& tag : form.tags)
          if (form.kind != TagForm::Kind::nothing)
            writeTag(interleave, form, tag, documentationOf(entry), findDemand(demands, tag), areOptional);
    }
  }

  static void writeAttribute(xml_node parent, const SchemaEntry& entry, const Demand* demand) {
    xml_node attribute =
        named(often(parent, demand || entry.isAlternative ? 1 : entry.atLeast, false), "attribute", entry.name);
    document(attribute, documentationOf(entry));
    if (demand && !demand->words.empty())
      writeWords(attribute, demand->words, false);
    else if (entry.form == Form::value)
      writeValue(attribute, formsOf(entry).front());
    else
      attribute.append_child("text");
  }

  static bool isRequired(const SchemaEntry& entry, const std::vector<Demand>& demands) {
    if (!isTag(entry)) return false;
    const std::vector<TagForm> forms = formsOf(entry);
    return entry.atLeast > 0 ||
           std::any_of(forms.begin(), forms.end(), [](const auto& form) { return form.atLeast > 0; }) ||
           std::any_of(entry.takes.begin(), entry.takes.end(),
                       [&](const auto& tag) { return findDemand(demands, tag); });
  }

  void writeContents(xml_node element, const SchemaBase& schema, const std::vector<Demand>& demands) {
    const auto& entries = schema.entries();
    const auto isAlternative = [](const SchemaEntry& entry) { return entry.isAlternative; };
    xml_node one;
    if (std::any_of(entries.begin(), entries.end(), isAlternative)) one = element.append_child("choice");
    for (const SchemaEntry& entry : entries)
      if (entry.place == Place::attribute)
        writeAttribute(entry.isAlternative ? one : element, entry, findDemand(demands, entry.name));
    const auto text =
        std::find_if(entries.begin(), entries.end(), [](const auto& e) { return e.place == Place::text; });
    if (text != entries.end())
      writeValue(element, formsOf(*text).front());
    else if (std::none_of(entries.begin(), entries.end(), isTag))
      element.append_child("empty");
    else
      writeAllTags(element, schema, demands);
  }

  /// Writes tags in any order; if some are included from another file, missing tags cannot be detected.
  void writeAllTags(xml_node element, const SchemaBase& schema, const std::vector<Demand>& demands) {
    const bool someAreRequired = std::any_of(schema.entries().begin(), schema.entries().end(),
                                             [&](const auto& entry) { return isRequired(entry, demands); });
    xml_node parent = someAreRequired ? element.append_child("choice") : element;
    if (someAreRequired) {
      xml_node all = parent.append_child("interleave");
      writeTags(all, schema, demands, false);
      if (all.first_child() == all.last_child()) {  // libxml2 2.9 fails on an interleave of one
        parent.append_move(all.first_child());
        parent.remove_child(all);
      }
    }
    xml_node withIncludes = parent.append_child("interleave");
    refer(withIncludes.append_child(someAreRequired ? "oneOrMore" : "zeroOrMore"), include);
    writeTags(withIncludes, schema, demands, true);
  }

  /// Allows all attributes except those of `demands`.
  static void allowAttributes(xml_node parent, const std::vector<Demand>& demands) {
    xml_node any = parent.append_child("zeroOrMore").append_child("attribute").append_child("anyName");
    if (demands.empty()) return;
    xml_node except = any.append_child("except");
    for (const Demand& demand : demands) except.append_child("name").text() = demand.name.c_str();
  }

  /// Allows all attributes except those that are declared.
  static void allowOtherAttributes(xml_node element) {
    std::vector<Demand> declared;
    for (const pugi::xpath_node& one : element.select_nodes("attribute|optional/attribute|choice/attribute"))
      declared.push_back({one.node().attribute("name").value(), {}});
    allowAttributes(element, declared);
  }

  static void writeAnything(xml_node element, const std::vector<Demand>& demands) {
    for (const Demand& demand : demands) writeWords(named(element, "attribute", demand.name), demand.words, false);
    allowAttributes(element, demands);
    refer(element, anything);
  }

  void writeTypes() {
    for (const ValueType& type : valueTypes())
      writePattern(named(grammar_, "define", "value-" + type.name), type.pattern);
    xml_node all = named(grammar_, "define", anything).append_child("zeroOrMore").append_child("choice");
    all.append_child("text");
    xml_node element = all.append_child("element");
    element.append_child("anyName");
    allowAttributes(element, {});
    refer(element, anything);
    xml_node other = named(named(grammar_, "define", include), "element", "include");
    document(other, "Is replaced by the contents of another file.");
    named(other, "attribute", "href").append_child("text");
    for (const char* name : {"section", "excludeSectionTag"})
      named(other.append_child("optional"), "attribute", name).append_child("text");
    other.append_child("text");
  }

  xml_node grammar_;
  std::map<std::string, std::string> names_;
  std::map<std::string, int> counts_;
  std::deque<Pending> pending_;
  std::size_t root_names_ = 0;
};

}  // namespace

void writeRelaxNg(std::ostream& out, const TagForm& root, const std::string& comment) {
  pugi::xml_document file;
  xml_node grammar = startFile(file, "grammar", comment);
  grammar.append_attribute("xmlns") = "http://relaxng.org/ns/structure/1.0";
  grammar.append_attribute("xmlns:a") = "http://relaxng.org/ns/compatibility/annotations/1.0";
  grammar.append_attribute("datatypeLibrary") = "http://www.w3.org/2001/XMLSchema-datatypes";
  Grammar(grammar).write(root);
  writeFile(file, out);
}

}  // namespace tushar::input
