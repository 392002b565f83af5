#pragma once

#include <algorithm>
#include <cassert>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/input/constraint.hpp"
#include "core/input/diagnostics.hpp"
#include "core/input/element.hpp"
#include "core/input/schema_base.hpp"
#include "core/input/values.hpp"

namespace tushar::input {

/// The names of a choice and their values.
template <class E>
using Choices = std::vector<std::pair<std::string, E>>;

/// The pointer to a member of a base of S, as a member of S.
template <class S, class T, class Base>
T S::*memberOf(T Base::*member) {
  return member;
}

/// How one tag is read into a structure S: each tag and attribute that it may have is declared once, with its type,
/// default, unit, limits and a sentence. Reading, the messages and the manual all come from these declarations.
///
/// S must be default-constructible. Units are as in "m/s"; "1" means none. Schemas that are passed to others are kept
/// by reference and must outlive them (make them function-local statics).
template <class S>
class Schema : public SchemaBase {
 public:
  /// `name` is the tag's; `sentence` says what it is for.
  Schema(std::string name, std::string sentence) : SchemaBase(std::move(name), std::move(sentence)) {}

  /// Reads the tag; every problem goes to `diagnostics`, and the member concerned keeps its default.
  S read(const Element& element, Diagnostics& diagnostics) const {
    S object{};
    readInto(&object, element, diagnostics);
    return object;
  }

  /// The settings of an empty tag.
  S defaults() const {
    S object{};
    setDefaults(&object);
    return object;
  }

  /// A tag with a value; `byDefault` if it is left out.
  template <class T, class... C>
  Schema& value(const std::string& name, T S::*member, const std::type_identity_t<T>& byDefault,
                const std::string& unit, const std::string& sentence, const C&... constraints) {
    return put(withDefault(valueEntry<T>(member, name, unit, sentence, constraints...), member, byDefault));
  }

  /// A tag with a value that must be given.
  template <class T, class... C>
  Schema& required(const std::string& name, T S::*member, const std::string& unit, const std::string& sentence,
                   const C&... constraints) {
    return put(mandatory(valueEntry<T>(member, name, unit, sentence, constraints...)));
  }

  /// A tag with a value that may be left out.
  template <class T, class... C>
  Schema& optional(const std::string& name, std::optional<T> S::*member, const std::string& unit,
                   const std::string& sentence, const C&... constraints) {
    return put(valueEntry<T>(member, name, unit, sentence, constraints...));
  }

  /// A tag with a value that may be given any number of times, at least `atLeast` times.
  template <class T, class... C>
  Schema& values(const std::string& name, std::vector<T> S::*member, const std::string& unit,
                 const std::string& sentence, int atLeast, const C&... constraints) {
    SchemaEntry entry = valueEntry<T>(member, name, unit, sentence, constraints...);
    entry.repeatable = true;
    entry.atLeast = atLeast;
    return put(std::move(entry));
  }

  /// A flag: an empty tag means true; otherwise its text is true or false.
  Schema& flag(const std::string& name, bool S::*member, const std::string& sentence) {
    SchemaEntry entry = valueEntry<bool>(member, name, "1", sentence);
    entry.type = "empty, true or false";
    entry.assign = [read = entry.assign](void* object, const std::string& text, const Location& where) {
      return read(object, text.empty() ? "true" : text, where);
    };
    return put(withDefault(std::move(entry), member, false));
  }

  /// The tag's own text, which must be given.
  template <class T, class... C>
  Schema& text(T S::*member, const std::string& unit, const std::string& sentence, const C&... constraints) {
    SchemaEntry entry = mandatory(valueEntry<T>(member, "", unit, sentence, constraints...));
    entry.place = SchemaEntry::Place::text;
    return put(std::move(entry));
  }

  /// A tag with one of several words.
  template <class E>
  Schema& choice(const std::string& name, E S::*member, const std::type_identity_t<Choices<E>>& choices,
                 const std::type_identity_t<E>& byDefault, const std::string& sentence) {
    return put(withDefaultChoice(choiceEntry<E>(member, name, choices, sentence), member, choices, byDefault));
  }
  template <class E>
  Schema& requiredChoice(const std::string& name, E S::*member, const std::type_identity_t<Choices<E>>& choices,
                         const std::string& sentence) {
    return put(mandatory(choiceEntry<E>(member, name, choices, sentence)));
  }
  template <class E>
  Schema& optionalChoice(const std::string& name, std::optional<E> S::*member,
                         const std::type_identity_t<Choices<E>>& choices, const std::string& sentence) {
    return put(choiceEntry<E>(member, name, choices, sentence));
  }

  /// As above, for attributes.
  template <class T, class... C>
  Schema& attributeValue(const std::string& name, T S::*member, const std::type_identity_t<T>& byDefault,
                         const std::string& unit, const std::string& sentence, const C&... constraints) {
    return put(attribute(withDefault(valueEntry<T>(member, name, unit, sentence, constraints...), member, byDefault)));
  }
  template <class T, class... C>
  Schema& requiredAttribute(const std::string& name, T S::*member, const std::string& unit, const std::string& sentence,
                            const C&... constraints) {
    return put(attribute(mandatory(valueEntry<T>(member, name, unit, sentence, constraints...))));
  }
  template <class T, class... C>
  Schema& optionalAttribute(const std::string& name, std::optional<T> S::*member, const std::string& unit,
                            const std::string& sentence, const C&... constraints) {
    return put(attribute(valueEntry<T>(member, name, unit, sentence, constraints...)));
  }
  template <class E>
  Schema& choiceAttribute(const std::string& name, E S::*member, const std::type_identity_t<Choices<E>>& choices,
                          const std::type_identity_t<E>& byDefault, const std::string& sentence) {
    return put(
        attribute(withDefaultChoice(choiceEntry<E>(member, name, choices, sentence), member, choices, byDefault)));
  }
  template <class E>
  Schema& requiredChoiceAttribute(const std::string& name, E S::*member,
                                  const std::type_identity_t<Choices<E>>& choices, const std::string& sentence) {
    return put(attribute(mandatory(choiceEntry<E>(member, name, choices, sentence))));
  }

  template <class E>
  Schema& optionalChoiceAttribute(const std::string& name, std::optional<E> S::*member,
                                  const std::type_identity_t<Choices<E>>& choices, const std::string& sentence) {
    return put(attribute(choiceEntry<E>(member, name, choices, sentence)));
  }

  /// A tag read by another schema, which may be left out: the member is then empty.
  template <class T>
  Schema& section(const std::string& name, std::optional<T> S::*member, const Schema<T>& schema,
                  const std::string& sentence = "") {
    return put(nestedEntry<T>(name, schema, sentence, [member](S& s, T value) { s.*member = std::move(value); }));
  }
  /// A tag read by another schema, which may be left out: the member then has that schema's defaults.
  template <class T>
  Schema& section(const std::string& name, T S::*member, const Schema<T>& schema, const std::string& sentence = "") {
    SchemaEntry entry =
        nestedEntry<T>(name, schema, sentence, [member](S& s, T value) { s.*member = std::move(value); });
    entry.setDefault = [member, &schema](void* object) { static_cast<S*>(object)->*member = schema.defaults(); };
    return put(std::move(entry));
  }
  /// A tag read by another schema, which must be given.
  template <class T>
  Schema& requiredSection(const std::string& name, T S::*member, const Schema<T>& schema,
                          const std::string& sentence = "") {
    return put(
        mandatory(nestedEntry<T>(name, schema, sentence, [member](S& s, T value) { s.*member = std::move(value); })));
  }
  /// A tag read by another schema, any number of times, at least `atLeast` times.
  template <class T>
  Schema& list(const std::string& name, std::vector<T> S::*member, const Schema<T>& schema,
               const std::string& sentence = "", int atLeast = 0) {
    SchemaEntry entry =
        nestedEntry<T>(name, schema, sentence, [member](S& s, T value) { (s.*member).push_back(std::move(value)); });
    entry.repeatable = true;
    entry.atLeast = atLeast;
    return put(std::move(entry));
  }

  /// A tag (with its content) that is accepted but has no effect; `sentence` says why.
  Schema& ignored(const std::string& name, const std::string& sentence) { return put(ignoredEntry(name, sentence)); }
  Schema& ignoredAttribute(const std::string& name, const std::string& sentence) {
    return put(attribute(ignoredEntry(name, sentence)));
  }

  /// An attribute with text that something other than this schema reads.
  Schema& foreignAttribute(const std::string& name, const std::string& sentence) {
    SchemaEntry entry = ignoredEntry(name, sentence);
    entry.type = typeName<std::string>;
    return put(attribute(std::move(entry)));
  }

  /// Reads what declarations cannot express. `read` is called once with the element of *this* schema, whether or not
  /// any of the tags that it `takes` over (`name` itself if none are listed) is given.
  Schema& custom(const std::string& name, std::function<void(S&, const Element&, Diagnostics&)> read,
                 std::vector<std::string> takes, const std::string& sentence,
                 std::function<void(std::ostream&, int)> describeBelow = {}) {
    SchemaEntry entry = named(name, sentence);
    entry.form = SchemaEntry::Form::custom;
    entry.takes = std::move(takes);
    entry.describe = std::move(describeBelow);
    entry.fill = [read = std::move(read)](void* object, const Element& element, Diagnostics& diagnostics) {
      read(*static_cast<S*>(object), element, diagnostics);
    };
    return put(std::move(entry));
  }

  /// The allowed content of the tags of the last declaration, a custom one, for the schemas of editors; at least
  /// `atLeast` of these tags must be given in all.
  Schema& forms(std::vector<TagForm> forms, int atLeast = 0) {
    setFormsOfLast(std::move(forms), atLeast);
    return *this;
  }

  /// Stores the location of the tag or, with the name of an attribute, that of the attribute.
  Schema& location(Location S::*member, std::string attribute = "") {
    addLocate([member, attribute = std::move(attribute)](void* object, const Element& element) {
      static_cast<S*>(object)->*member = element.whereOf(attribute);
    });
    return *this;
  }

  /// Checks values against each other; called only if the element had no problem so far.
  Schema& check(std::function<void(const S&, const Element&, Diagnostics&)> check) {
    addCheck([check = std::move(check)](const void* object, const Element& element, Diagnostics& diagnostics) {
      check(*static_cast<const S*>(object), element, diagnostics);
    });
    return *this;
  }

  /// Tells editors that one of the last `count` attributes must be given.
  Schema& oneOfLast(int count) {
    markAlternatives(count);
    return *this;
  }

  /// Adds, to the message about a word that the last choice lacks, where that word is available.
  Schema& elsewhere(const std::string& word, const std::string& sentence) {
    explainWordOfLast(word, sentence);
    return *this;
  }

  /// Marks all declarations that follow as tags that Uintah does not have.
  Schema& allOurs() {
    markAllOurs();
    return *this;
  }
  /// Marks the last declaration as one that Uintah does not have.
  Schema& ours() {
    markLastOurs();
    return *this;
  }

 private:
  Schema& put(SchemaEntry entry) {
    add(std::move(entry));
    return *this;
  }

  static SchemaEntry named(const std::string& name, const std::string& sentence) {
    SchemaEntry entry;
    entry.name = name;
    entry.sentence = sentence;
    return entry;
  }

  static SchemaEntry attribute(SchemaEntry entry) {
    entry.place = SchemaEntry::Place::attribute;
    return entry;
  }

  static SchemaEntry mandatory(SchemaEntry entry) {
    entry.atLeast = 1;
    return entry;
  }

  static SchemaEntry ignoredEntry(const std::string& name, const std::string& sentence) {
    SchemaEntry entry = named(name, sentence);
    entry.form = SchemaEntry::Form::ignored;
    return entry;
  }

  template <class T>
  static void store(T S::*member, void* object, T value) {
    static_cast<S*>(object)->*member = std::move(value);
  }
  template <class T>
  static void store(std::optional<T> S::*member, void* object, T value) {
    static_cast<S*>(object)->*member = std::move(value);
  }
  template <class T>
  static void store(std::vector<T> S::*member, void* object, T value) {
    (static_cast<S*>(object)->*member).push_back(std::move(value));
  }

  /// Reads a T into `member`, which is a T, an optional T or a list of T.
  template <class T, class Member, class... C>
  static SchemaEntry valueEntry(Member member, const std::string& name, const std::string& unit,
                                const std::string& sentence, const C&... constraints) {
    SchemaEntry entry = named(name, sentence);
    entry.type = typeName<T>;
    entry.unit = unit;
    ((entry.limits += (entry.limits.empty() ? "" : " and ") + constraints.allowed), ...);
    entry.assign = [=](void* object, const std::string& text, const Location& where) -> std::string {
      Parsed<T> parsed = parse<T>(text);
      if (!parsed) return parsed.problem;
      std::string problem;
      ((problem.empty() && !satisfies(*parsed, constraints) ? void(problem = violation(text, constraints, unit))
                                                            : void()),
       ...);
      if (!problem.empty()) return problem;
      if constexpr (requires { parsed.value->readAt(where); }) parsed.value->readAt(where);
      store(member, object, *std::move(parsed.value));
      return problem;
    };
    return entry;
  }

  template <class T>
  static SchemaEntry withDefault(SchemaEntry entry, T S::*member, const T& byDefault) {
    entry.fallback = toText(byDefault);
    entry.setDefault = [member, byDefault](void* object) { static_cast<S*>(object)->*member = byDefault; };
    return entry;
  }

  template <class E, class Member>
  static SchemaEntry choiceEntry(Member member, const std::string& name, const Choices<E>& choices,
                                 const std::string& sentence) {
    SchemaEntry entry = named(name, sentence);
    for (const auto& [word, meaning] : choices) entry.choices.push_back(word);
    entry.assign = [member, choices, words = entry.choices](void* object, const std::string& text, const Location&) {
      std::string problem = choiceProblem(text, words);
      if (!problem.empty()) return problem;
      const auto found = std::find(words.begin(), words.end(), text) - words.begin();
      store(member, object, E(choices[found].second));
      return std::string();
    };
    return entry;
  }

  template <class E>
  static SchemaEntry withDefaultChoice(SchemaEntry entry, E S::*member, const Choices<E>& choices, const E& byDefault) {
    const auto isDefault = [&](const auto& choice) { return choice.second == byDefault; };
    const auto found = std::find_if(choices.begin(), choices.end(), isDefault);
    assert(found != choices.end());
    entry.fallback = found->first;
    entry.setDefault = [member, byDefault](void* object) { static_cast<S*>(object)->*member = byDefault; };
    return entry;
  }

  template <class T, class Store>
  static SchemaEntry nestedEntry(const std::string& name, const Schema<T>& schema, const std::string& sentence,
                                 Store keep) {
    SchemaEntry entry = named(name, sentence.empty() ? schema.sentence() : sentence);
    entry.form = SchemaEntry::Form::nested;
    entry.fill = [keep, &schema](void* object, const Element& element, Diagnostics& diagnostics) {
      keep(*static_cast<S*>(object), schema.read(element, diagnostics));
    };
    entry.nested = &schema;
    entry.describe = [&schema](std::ostream& out, int indent) { schema.describeContents(out, indent); };
    return entry;
  }
};

}  // namespace tushar::input
