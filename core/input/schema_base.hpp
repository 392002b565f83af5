#pragma once

#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/shared_function.hpp"
#include "core/input/diagnostics.hpp"
#include "core/input/element.hpp"
#include "core/input/tag_form.hpp"

namespace tushar::input {

/// One declaration of a schema, without the type of the structure that it fills.
struct SchemaEntry {
  SchemaEntry();
  SchemaEntry(const SchemaEntry& other);
  SchemaEntry(SchemaEntry&& other) noexcept;
  SchemaEntry& operator=(const SchemaEntry& other);
  SchemaEntry& operator=(SchemaEntry&& other) noexcept;
  ~SchemaEntry();

  enum class Place { attribute, tag, text };
  /// How a tag is read: as one value, by another schema, by a function of the parent, or not at all.
  enum class Form { value, nested, custom, ignored };

  Place place = Place::tag;
  Form form = Form::value;
  std::string name;
  std::string sentence;
  std::string type;
  std::string unit;
  std::string fallback;  ///< default value as text; empty if there is none
  std::string limits;
  std::vector<std::string> choices;
  std::vector<std::string> takes;  ///< names of the tags that the declaration reads; empty for attributes and text
  bool ours = false;
  bool repeatable = false;
  bool isAlternative = false;  ///< whether it is one of several attributes of which one must be given
  int atLeast = 0;             ///< smallest number of occurrences
  std::vector<TagForm> forms;  ///< allowed content of tags that a function of the parent reads; empty: any content
  const SchemaBase* nested = nullptr;  ///< the schema that reads a nested tag

  SharedFunction<void(void* object)> setDefault;
  /// Reads a value given at `where`; returns a message if the value is invalid, otherwise an empty text.
  SharedFunction<std::string(void* object, const std::string& text, const Location& where)> assign;
  /// Reads a nested tag; for Form::custom, `element` is the parent.
  SharedFunction<void(void* object, const Element& element, Diagnostics& diagnostics)> fill;
  /// Writes the manual of the content of the tag.
  SharedFunction<void(std::ostream& out, int indent)> describe;
};

SchemaEntry namedEntry(std::string_view name, std::string_view sentence);

/// The facts about a value that the manual adds to its description: `number in Pa, greater than 0, default 1`.
std::string factsOf(const SchemaEntry& entry);

/// Returns the message that `text` is not one of `words`; empty if it is.
std::string choiceProblem(const std::string& text, const std::vector<std::string>& words);

/// Reports the attributes of a tag that are not among `allowed`.
void refuseAttributes(const Element& element, const std::vector<std::string>& allowed, Diagnostics& diagnostics);
/// Reports text in a tag that may contain only tags.
void refuseText(const Element& element, Diagnostics& diagnostics);

/// The part of a Schema that does not depend on the structure that it fills.
class SchemaBase {
 public:
  const std::string& name() const { return name_; }
  const std::string& sentence() const { return sentence_; }
  /// All declarations, in the order in which they were made.
  const std::vector<SchemaEntry>& entries() const { return entries_; }
  /// The names of the tags that may be given, in the order of their declarations.
  std::vector<std::string> tagNames() const;
  /// Like tagNames(), without the tags that are declared only to be refused.
  std::vector<std::string> acceptedTagNames() const;
  std::vector<std::string> attributeNames() const;
  /// Writes the manual of the tag and of everything that it may contain, indented by `indent` blanks.
  void describe(std::ostream& out, int indent = 0) const;
  /// Like describe(), without the line of the tag itself.
  void describeContents(std::ostream& out, int indent = 0) const;

  using Fill = SharedFunction<void(void* object, const Element& element, Diagnostics& diagnostics)>;
  /// Like Schema::custom (and, below, Schema::forms), for functions that do not need the object.
  void addCustom(std::string_view name, Fill&& fill, std::vector<std::string>&& takes, std::string_view sentence,
                 SharedFunction<void(std::ostream&, int)>&& describeBelow = {});
  void setFormsOfLast(std::vector<TagForm> forms, int atLeast = 0);

 protected:
  using Locate = SharedFunction<void(void* object, const Element& element)>;
  using Check = SharedFunction<void(const void* object, const Element& element, Diagnostics& diagnostics)>;

  SchemaBase(std::string_view name, std::string_view sentence);
  SchemaBase(const SchemaBase& other);
  SchemaBase(SchemaBase&& other) noexcept;
  SchemaBase& operator=(const SchemaBase& other);
  SchemaBase& operator=(SchemaBase&& other) noexcept;
  ~SchemaBase();

  void add(SchemaEntry&& entry);
  void addCheck(Check&& check);
  void addLocate(Locate&& locate);
  static SchemaEntry attribute(SchemaEntry&& entry);
  static SchemaEntry ownText(SchemaEntry&& entry);
  static SchemaEntry mandatory(SchemaEntry&& entry);
  static SchemaEntry repeated(SchemaEntry&& entry, int atLeast);
  static SchemaEntry flagEntry(SchemaEntry&& entry);
  static SchemaEntry ignoredEntry(std::string_view name, std::string_view sentence);
  static SchemaEntry textEntry(std::string_view name, std::string_view sentence);
  /// The entry of a tag that `schema` reads; if `sentence` is empty, the description of the schema is used.
  static SchemaEntry sectionEntry(std::string_view name, const SchemaBase& schema, std::string_view sentence);
  void markLastOurs();
  void markAllOurs() { all_ours_ = true; }
  void markAlternatives(int last);
  void explainWordOfLast(std::string_view word, std::string_view sentence);
  void setDefaults(void* object) const;
  void readInto(void* object, const Element& element, Diagnostics& diagnostics) const;

 private:
  void readAttributes(void* object, const Element& element, Diagnostics& diagnostics) const;
  void readTags(void* object, const Element& element, Diagnostics& diagnostics) const;
  void readText(void* object, const Element& element, Diagnostics& diagnostics) const;
  void reportUnknown(const Element& element, Diagnostics& diagnostics) const;

  std::string name_;
  std::string sentence_;
  std::vector<SchemaEntry> entries_;
  bool all_ours_ = false;  ///< whether all declarations from here on are tags that Uintah does not have
  std::vector<Locate> locates_;
  std::vector<Check> checks_;
};

}  // namespace tushar::input
