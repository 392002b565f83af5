#include "core/input/schema_base.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "core/input/text.hpp"

namespace tushar::input {

namespace {

using Place = SchemaEntry::Place;
using Form = SchemaEntry::Form;

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string allowedHere(const std::vector<std::string>& names, std::string_view what) {
  return names.empty() ? fmt::format("; no {} is allowed here", what) : "; allowed here: " + listed(names);
}

std::string unknownAttribute(const Element& element, const std::string& name, const std::vector<std::string>& known) {
  return fmt::format("unknown attribute '{}' of <{}>{}{}", name, element.name(), didYouMean(name, known),
                     allowedHere(known, "attribute"));
}

void reportAttribute(const Element& element, const Attribute& attribute, std::string sentence,
                     Diagnostics& diagnostics) {
  diagnostics.error(attribute.where, element.path(), std::move(sentence));
}

void refuseTags(const Element& element, Diagnostics& diagnostics) {
  for (const Element& child : element.children())
    diagnostics.error(
        child, fmt::format("found tag <{}> in <{}>, where only a value is allowed", child.name(), element.name()));
}

/// Reads a tag that contains one value and neither attributes nor other tags.
void readValue(const SchemaEntry& entry, void* object, const Element& element, Diagnostics& diagnostics) {
  refuseAttributes(element, {}, diagnostics);
  refuseTags(element, diagnostics);
  if (!element.children().empty() && element.text().empty()) return;
  const std::string problem = entry.assign(object, element.text(), element.where());
  if (!problem.empty()) diagnostics.error(element, problem);
}

std::string place(const Location& where, const Location& from) {
  return where.file == from.file && where.line > 0 ? fmt::format("on line {}", where.line) : "at " + where.text();
}

void reportTwice(const Element& first, const Element& again, Diagnostics& diagnostics) {
  diagnostics.error(again, fmt::format("tag <{}> is given twice, {} and {}; only one is allowed", again.name(),
                                       place(first.where(), again.where()), place(again.where(), again.where())));
}

void reportMissing(const SchemaEntry& entry, const Element& element, std::size_t found, Diagnostics& diagnostics) {
  const std::string meaning = entry.sentence.empty() ? "" : fmt::format(" ({})", entry.sentence);
  if (entry.atLeast == 1) {
    diagnostics.error(element, fmt::format("missing tag <{}> in <{}>{}", entry.name, element.name(), meaning));
  } else {
    diagnostics.error(element, fmt::format("<{}> needs at least {} tags <{}>, found {}{}", element.name(),
                                           entry.atLeast, entry.name, found, meaning));
  }
}

void readTag(const SchemaEntry& entry, void* object, const Element& element, Diagnostics& diagnostics) {
  const std::vector<Element> found = element.children(entry.name);
  if (found.size() < static_cast<std::size_t>(entry.atLeast)) {
    reportMissing(entry, element, found.size(), diagnostics);
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (i > 0 && !entry.repeatable) {
      reportTwice(found[0], found[i], diagnostics);
    } else if (entry.form == Form::value) {
      readValue(entry, object, found[i], diagnostics);
    } else {
      entry.fill(object, found[i], diagnostics);
    }
  }
}

void readAttribute(const SchemaEntry& entry, void* object, const Element& element, Diagnostics& diagnostics) {
  const auto& given = element.attributes();
  const auto found = std::find_if(given.begin(), given.end(), [&](const Attribute& a) { return a.name == entry.name; });
  if (found == given.end()) {
    if (entry.atLeast == 0) return;
    diagnostics.error(element,
                      fmt::format("missing attribute '{}' of <{}> ({})", entry.name, element.name(), entry.sentence));
  } else if (entry.form == Form::value) {
    const std::string problem = entry.assign(object, found->value, found->where);
    if (!problem.empty()) {
      reportAttribute(element, *found, fmt::format("attribute '{}': {}", entry.name, problem), diagnostics);
    }
  }
}

/// Reports content that the function for a custom tag would ignore: attributes, tags in values, repeated tags.
void checkForm(const TagForm& form, const Element& element, Diagnostics& diagnostics) {
  std::vector<std::string> demanded;
  for (const Demand& demand : form.demands) demanded.push_back(demand.name);
  const bool isValue = form.kind == TagForm::Kind::value;
  for (const std::string& tag : form.tags) {
    const std::vector<Element> found = element.children(tag);
    for (std::size_t k = 1; k < found.size() && !form.repeats; ++k) reportTwice(found[0], found[k], diagnostics);
    for (const Element& one : found) {
      if (isValue || !demanded.empty()) refuseAttributes(one, demanded, diagnostics);
      if (isValue) refuseTags(one, diagnostics);
    }
  }
}

std::string title(const SchemaEntry& entry) {
  if (entry.place == Place::attribute) return entry.name + "=";
  if (entry.place == Place::text) return "(text)";
  std::string tags;
  for (const std::string& tag : entry.takes) tags += (tags.empty() ? "<" : ", <") + tag + ">";
  return tags;
}

std::string presence(const SchemaEntry& entry) {
  if (entry.form == Form::ignored) return entry.type.empty() ? "ignored" : "optional";
  if (entry.form == Form::custom) return {};
  if (entry.atLeast > 1) return fmt::format("at least {}", entry.atLeast);
  if (entry.atLeast == 1) return entry.repeatable ? "at least one" : "required";
  if (entry.repeatable) return "any number";
  return entry.fallback.empty() ? "optional" : "default " + entry.fallback;
}

void describeEntry(const SchemaEntry& entry, std::ostream& out, int indent) {
  std::string line = std::string(indent, ' ') + title(entry);
  if (const std::string facts = factsOf(entry); !facts.empty()) line += " — " + facts;
  if (!entry.sentence.empty()) line += ": " + entry.sentence;
  out << line << (entry.ours ? " [Tushar's own]" : "") << '\n';
  if (entry.describe) entry.describe(out, indent + 2);
}

}  // namespace

void refuseAttributes(const Element& element, const std::vector<std::string>& allowed, Diagnostics& diagnostics) {
  for (const Attribute& attribute : element.attributes())
    if (!contains(allowed, attribute.name))
      reportAttribute(element, attribute, unknownAttribute(element, attribute.name, allowed), diagnostics);
}

void refuseText(const Element& element, Diagnostics& diagnostics) {
  if (!element.text().empty())
    diagnostics.error(
        element, fmt::format("found text '{}' in <{}>, where only tags are allowed", element.text(), element.name()));
}

std::string factsOf(const SchemaEntry& entry) {
  std::vector<std::string> facts;
  if (!entry.type.empty()) {
    const bool hasUnit = !entry.unit.empty() && entry.unit != "1";
    facts.push_back(hasUnit ? entry.type + " in " + entry.unit : entry.type);
  }
  if (!entry.choices.empty()) facts.push_back(alternatives(entry.choices));
  if (!entry.limits.empty()) facts.push_back(entry.limits);
  if (!presence(entry).empty()) facts.push_back(presence(entry));
  return listed(facts);
}

std::string choiceProblem(const std::string& text, const std::vector<std::string>& words) {
  if (contains(words, text)) return {};
  return fmt::format("found {}, expected {}{}", text.empty() ? "nothing" : "'" + text + "'", alternatives(words),
                     words.size() == 1 ? "" : didYouMean(text, words));
}

std::vector<std::string> SchemaBase::tagNames() const {
  std::vector<std::string> names;
  for (const SchemaEntry& entry : entries_) names.insert(names.end(), entry.takes.begin(), entry.takes.end());
  return names;
}

std::vector<std::string> SchemaBase::acceptedTagNames() const {
  std::vector<std::string> names = tagNames();
  for (const SchemaEntry& entry : entries_)
    for (const TagForm& form : entry.forms)
      if (form.kind == TagForm::Kind::nothing)
        std::erase_if(names, [&](const std::string& name) { return contains(form.tags, name); });
  return names;
}

std::vector<std::string> SchemaBase::attributeNames() const {
  std::vector<std::string> names;
  for (const SchemaEntry& entry : entries_) {
    if (entry.place == Place::attribute) names.push_back(entry.name);
  }
  return names;
}

void SchemaBase::describe(std::ostream& out, int indent) const {
  out << std::string(indent, ' ') << '<' << name_ << ">: " << sentence_ << '\n';
  describeContents(out, indent + 2);
}

void SchemaBase::describeContents(std::ostream& out, int indent) const {
  for (const SchemaEntry& entry : entries_) describeEntry(entry, out, indent);
}

void SchemaBase::add(SchemaEntry&& entry) {
  if (entry.place == Place::tag && entry.takes.empty()) entry.takes = {entry.name};
  entry.ours = entry.ours || all_ours_;
  entries_.push_back(std::move(entry));
}

void SchemaBase::markLastOurs() {
  assert(!entries_.empty());
  entries_.back().ours = true;
}

void SchemaBase::markAlternatives(int last) {
  for (auto entry = entries_.end() - last; entry != entries_.end(); ++entry) entry->isAlternative = true;
}

void SchemaBase::explainWordOfLast(std::string_view word, std::string_view sentence) {
  assert(!entries_.empty() && !entries_.back().choices.empty());
  entries_.back().assign = [word = std::string(word), sentence = std::string(sentence),
                            assign = entries_.back().assign](void* object, const std::string& text,
                                                             const Location& where) {
    const std::string problem = assign(object, text, where);
    return problem.empty() || text != word ? problem : problem + ": " + sentence;
  };
}

void SchemaBase::setFormsOfLast(std::vector<TagForm> forms, int atLeast) {
  assert(!entries_.empty() && entries_.back().form == Form::custom);
  entries_.back().forms = std::move(forms);
  entries_.back().atLeast = atLeast;
}

void SchemaBase::setDefaults(void* object) const {
  for (const SchemaEntry& entry : entries_) {
    if (entry.setDefault) entry.setDefault(object);
  }
}

void SchemaBase::readInto(void* object, const Element& element, Diagnostics& diagnostics) const {
  const std::size_t before = diagnostics.size();
  setDefaults(object);
  for (const Locate& locate : locates_) locate(object, element);
  reportUnknown(element, diagnostics);
  readAttributes(object, element, diagnostics);
  readTags(object, element, diagnostics);
  readText(object, element, diagnostics);
  if (diagnostics.size() != before) return;
  for (const Check& check : checks_) check(object, element, diagnostics);
}

void SchemaBase::reportUnknown(const Element& element, Diagnostics& diagnostics) const {
  refuseAttributes(element, attributeNames(), diagnostics);
  const std::vector<std::string> known = tagNames(), tags = acceptedTagNames();
  for (const Element& child : element.children()) {
    if (contains(known, child.name())) continue;
    diagnostics.error(child, fmt::format("unknown tag <{}> in <{}>{}{}", child.name(), element.name(),
                                         didYouMean(child.name(), tags), allowedHere(tags, "tag")));
  }
}

void SchemaBase::readAttributes(void* object, const Element& element, Diagnostics& diagnostics) const {
  for (const SchemaEntry& entry : entries_) {
    if (entry.place == Place::attribute) readAttribute(entry, object, element, diagnostics);
  }
}

void SchemaBase::readTags(void* object, const Element& element, Diagnostics& diagnostics) const {
  for (const SchemaEntry& entry : entries_) {
    if (entry.place != Place::tag || entry.form == Form::ignored) continue;
    if (entry.form == Form::custom) {
      for (const TagForm& form : entry.forms) checkForm(form, element, diagnostics);
      entry.fill(object, element, diagnostics);
    } else {
      readTag(entry, object, element, diagnostics);
    }
  }
}

void SchemaBase::readText(void* object, const Element& element, Diagnostics& diagnostics) const {
  const auto isText = [](const SchemaEntry& entry) { return entry.place == Place::text; };
  const auto entry = std::find_if(entries_.begin(), entries_.end(), isText);
  if (entry != entries_.end()) {
    const std::string problem = entry->assign(object, element.text(), element.where());
    if (!problem.empty()) diagnostics.error(element, problem);
  } else if (!element.text().empty()) {
    diagnostics.error(element, fmt::format("found text '{}' in <{}>, where {} allowed", element.text(), element.name(),
                                           tagNames().empty() ? "none is" : "only tags are"));
  }
}

}  // namespace tushar::input
