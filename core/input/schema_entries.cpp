#include "core/input/schema_entries.hpp"

namespace tushar::input {

TUSHAR_ALL_SCHEMA_INSTANCES()

// Instances that the compiler would otherwise make in each file that declares a schema.
SchemaEntry::SchemaEntry() = default;
SchemaEntry::SchemaEntry(const SchemaEntry& other) = default;
SchemaEntry::SchemaEntry(SchemaEntry&& other) noexcept = default;
SchemaEntry& SchemaEntry::operator=(const SchemaEntry& other) = default;
SchemaEntry& SchemaEntry::operator=(SchemaEntry&& other) noexcept = default;
SchemaEntry::~SchemaEntry() = default;

SchemaBase::SchemaBase(std::string_view name, std::string_view sentence) : name_(name), sentence_(sentence) {}
SchemaBase::SchemaBase(const SchemaBase& other) = default;
SchemaBase::SchemaBase(SchemaBase&& other) noexcept = default;
SchemaBase& SchemaBase::operator=(const SchemaBase& other) = default;
SchemaBase& SchemaBase::operator=(SchemaBase&& other) noexcept = default;
SchemaBase::~SchemaBase() = default;

SchemaEntry namedEntry(std::string_view name, std::string_view sentence) {
  SchemaEntry entry;
  entry.name = name;
  entry.sentence = sentence;
  return entry;
}

SchemaEntry SchemaBase::attribute(SchemaEntry&& entry) {
  entry.place = SchemaEntry::Place::attribute;
  return std::move(entry);
}

SchemaEntry SchemaBase::ownText(SchemaEntry&& entry) {
  entry.place = SchemaEntry::Place::text;
  return std::move(entry);
}

SchemaEntry SchemaBase::mandatory(SchemaEntry&& entry) {
  entry.atLeast = 1;
  return std::move(entry);
}

SchemaEntry SchemaBase::repeated(SchemaEntry&& entry, int atLeast) {
  entry.repeatable = true;
  entry.atLeast = atLeast;
  return std::move(entry);
}

SchemaEntry SchemaBase::flagEntry(SchemaEntry&& entry) {
  entry.type = "empty, true or false";
  entry.assign = [read = std::move(entry.assign)](void* object, const std::string& text, const Location& where) {
    return read(object, text.empty() ? "true" : text, where);
  };
  return std::move(entry);
}

SchemaEntry SchemaBase::ignoredEntry(std::string_view name, std::string_view sentence) {
  SchemaEntry entry = namedEntry(name, sentence);
  entry.form = SchemaEntry::Form::ignored;
  return entry;
}

SchemaEntry SchemaBase::textEntry(std::string_view name, std::string_view sentence) {
  SchemaEntry entry = ignoredEntry(name, sentence);
  entry.type = typeName<std::string>;
  return entry;
}

SchemaEntry SchemaBase::sectionEntry(std::string_view name, const SchemaBase& schema, std::string_view sentence) {
  SchemaEntry entry = namedEntry(name, sentence.empty() ? schema.sentence() : sentence);
  entry.form = SchemaEntry::Form::nested;
  entry.nested = &schema;
  entry.describe = [&schema](std::ostream& out, int indent) { schema.describeContents(out, indent); };
  return entry;
}

void SchemaBase::addCustom(std::string_view name, Fill&& fill, std::vector<std::string>&& takes,
                           std::string_view sentence, SharedFunction<void(std::ostream&, int)>&& describeBelow) {
  SchemaEntry entry = namedEntry(name, sentence);
  entry.form = SchemaEntry::Form::custom;
  entry.takes = std::move(takes);
  entry.describe = std::move(describeBelow);
  entry.fill = std::move(fill);
  add(std::move(entry));
}

void SchemaBase::addCheck(Check&& check) { checks_.push_back(std::move(check)); }
void SchemaBase::addLocate(Locate&& locate) { locates_.push_back(std::move(locate)); }

}  // namespace tushar::input
