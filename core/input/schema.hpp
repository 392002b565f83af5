#pragma once

#include <algorithm>
#include <cassert>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/input/constraint.hpp"
#include "core/input/diagnostics.hpp"
#include "core/input/element.hpp"
#include "core/input/schema_entries.hpp"
#include "core/input/values.hpp"

namespace tushar::input {

/// Converts a pointer to a member of a base class of S to a pointer to a member of S.
template <class S, class T, class Base>
T S::*memberOf(T Base::*member) {
  return member;
}

/// Describes how to read one tag into a structure S: each tag and attribute that it may contain is declared once, with
/// its type, default, unit, limits and description. Reading, error messages and the manual are all based on these
/// declarations.
///
/// S must be default-constructible. Units are written as in "m/s"; "1" means dimensionless. Schemas passed to other
/// schemas are stored by reference and must outlive them (make them function-local statics).
template <class S>
class Schema : public SchemaBase {
 public:
  /// `name` is the name of the tag; `sentence` describes its purpose.
  Schema(std::string_view name, std::string_view sentence) : SchemaBase(name, sentence) {}

  /// Reads the tag. Reports every problem to `diagnostics`; the member concerned then keeps its default.
  S read(const Element& element, Diagnostics& diagnostics) const {
    S object{};
    readInto(&object, element, diagnostics);
    return object;
  }

  /// The settings that an empty tag would give.
  S defaults() const {
    S object{};
    setDefaults(&object);
    return object;
  }

  /// Declares a tag with a value; `byDefault` is the value if the tag is omitted.
  template <class T, class... C>
  Schema& value(std::string_view name, T S::*member, const std::type_identity_t<T>& byDefault, std::string_view unit,
                std::string_view sentence, const C&... constraints) {
    return put(withDefault(valueEntry<T>(member, name, unit, sentence, constraints...), member, byDefault));
  }

  /// Declares a tag with a value that must be given.
  template <class T, class... C>
  Schema& required(std::string_view name, T S::*member, std::string_view unit, std::string_view sentence,
                   const C&... constraints) {
    return put(mandatory(valueEntry<T>(member, name, unit, sentence, constraints...)));
  }

  /// Declares a tag with an optional value.
  template <class T, class... C>
  Schema& optional(std::string_view name, std::optional<T> S::*member, std::string_view unit, std::string_view sentence,
                   const C&... constraints) {
    return put(valueEntry<T>(member, name, unit, sentence, constraints...));
  }

  /// Declares a tag with a value; the tag may be repeated, and must be given at least `atLeast` times.
  template <class T, class... C>
  Schema& values(std::string_view name, std::vector<T> S::*member, std::string_view unit, std::string_view sentence,
                 int atLeast, const C&... constraints) {
    return put(repeated(valueEntry<T>(member, name, unit, sentence, constraints...), atLeast));
  }

  /// Declares a flag: an empty tag means true; otherwise its text is true or false.
  Schema& flag(std::string_view name, bool S::*member, std::string_view sentence) {
    return put(flagEntry(withDefault(valueEntry<bool>(member, name, "1", sentence), member, false)));
  }

  /// Declares the tag's own text, which must be given.
  template <class T, class... C>
  Schema& text(T S::*member, std::string_view unit, std::string_view sentence, const C&... constraints) {
    return put(ownText(mandatory(valueEntry<T>(member, "", unit, sentence, constraints...))));
  }

  /// Declares a tag whose text is one of several words.
  template <class E>
  Schema& choice(std::string_view name, E S::*member, const std::type_identity_t<Choices<E>>& choices,
                 const std::type_identity_t<E>& byDefault, std::string_view sentence) {
    return put(withDefaultChoice(choiceEntry<E>(member, name, choices, sentence), member, choices, byDefault));
  }
  template <class E>
  Schema& requiredChoice(std::string_view name, E S::*member, const std::type_identity_t<Choices<E>>& choices,
                         std::string_view sentence) {
    return put(mandatory(choiceEntry<E>(member, name, choices, sentence)));
  }
  template <class E>
  Schema& optionalChoice(std::string_view name, std::optional<E> S::*member,
                         const std::type_identity_t<Choices<E>>& choices, std::string_view sentence) {
    return put(choiceEntry<E>(member, name, choices, sentence));
  }

  /// Declares an attribute with a value; `byDefault` is the value if the attribute is omitted.
  template <class T, class... C>
  Schema& attributeValue(std::string_view name, T S::*member, const std::type_identity_t<T>& byDefault,
                         std::string_view unit, std::string_view sentence, const C&... constraints) {
    return put(attribute(withDefault(valueEntry<T>(member, name, unit, sentence, constraints...), member, byDefault)));
  }
  template <class T, class... C>
  Schema& requiredAttribute(std::string_view name, T S::*member, std::string_view unit, std::string_view sentence,
                            const C&... constraints) {
    return put(attribute(mandatory(valueEntry<T>(member, name, unit, sentence, constraints...))));
  }
  template <class T, class... C>
  Schema& optionalAttribute(std::string_view name, std::optional<T> S::*member, std::string_view unit,
                            std::string_view sentence, const C&... constraints) {
    return put(attribute(valueEntry<T>(member, name, unit, sentence, constraints...)));
  }
  template <class E>
  Schema& choiceAttribute(std::string_view name, E S::*member, const std::type_identity_t<Choices<E>>& choices,
                          const std::type_identity_t<E>& byDefault, std::string_view sentence) {
    return put(
        attribute(withDefaultChoice(choiceEntry<E>(member, name, choices, sentence), member, choices, byDefault)));
  }
  template <class E>
  Schema& requiredChoiceAttribute(std::string_view name, E S::*member, const std::type_identity_t<Choices<E>>& choices,
                                  std::string_view sentence) {
    return put(attribute(mandatory(choiceEntry<E>(member, name, choices, sentence))));
  }

  template <class E>
  Schema& optionalChoiceAttribute(std::string_view name, std::optional<E> S::*member,
                                  const std::type_identity_t<Choices<E>>& choices, std::string_view sentence) {
    return put(attribute(choiceEntry<E>(member, name, choices, sentence)));
  }

  /// Declares an optional tag that is read by another schema; if it is omitted, the member is empty.
  template <class T>
  Schema& section(std::string_view name, std::optional<T> S::*member, const Schema<T>& schema,
                  std::string_view sentence = "") {
    return put(nestedEntry(name, schema, sentence, member));
  }
  /// Declares an optional tag that is read by another schema; if it is omitted, the member has the defaults of that
  /// schema.
  template <class T>
  Schema& section(std::string_view name, T S::*member, const Schema<T>& schema, std::string_view sentence = "") {
    SchemaEntry entry = nestedEntry(name, schema, sentence, member);
    entry.setDefault = [member, &schema](void* object) { static_cast<S*>(object)->*member = schema.defaults(); };
    return put(std::move(entry));
  }
  /// Declares a tag that is read by another schema and must be given.
  template <class T>
  Schema& requiredSection(std::string_view name, T S::*member, const Schema<T>& schema,
                          std::string_view sentence = "") {
    return put(mandatory(nestedEntry(name, schema, sentence, member)));
  }
  /// Declares a tag that is read by another schema; it may be repeated, and must be given at least `atLeast` times.
  template <class T>
  Schema& list(std::string_view name, std::vector<T> S::*member, const Schema<T>& schema,
               std::string_view sentence = "", int atLeast = 0) {
    return put(repeated(nestedEntry(name, schema, sentence, member), atLeast));
  }

  /// Declares a tag that is accepted with its content but has no effect; `sentence` gives the reason.
  Schema& ignored(std::string_view name, std::string_view sentence) { return put(ignoredEntry(name, sentence)); }
  Schema& ignoredAttribute(std::string_view name, std::string_view sentence) {
    return put(attribute(ignoredEntry(name, sentence)));
  }

  /// Declares an attribute whose text is not read by this schema.
  Schema& foreignAttribute(std::string_view name, std::string_view sentence) {
    return put(attribute(textEntry(name, sentence)));
  }

  /// Declares a function that reads what declarations cannot express. `reader` takes an S&, an Element and Diagnostics.
  /// It is called once, with the element of *this* schema, even if none of its tags is given. These tags are listed in
  /// `takes`; if that is empty, the only one is `name`.
  template <class Read>
  Schema& custom(std::string_view name, Read reader, std::vector<std::string> takes, std::string_view sentence,
                 SharedFunction<void(std::ostream&, int)> describeBelow = {}) {
    addCustom(
        name,
        [reader = std::move(reader)](void* object, const Element& element, Diagnostics& diagnostics) {
          reader(*static_cast<S*>(object), element, diagnostics);
        },
        std::move(takes), sentence, std::move(describeBelow));
    return *this;
  }

  /// Declares, for the schemas that editors use, what the tags of the last declaration may contain. The declaration
  /// must be a custom one; at least `atLeast` of these tags must be given in total.
  Schema& forms(std::vector<TagForm> forms, int atLeast = 0) {
    setFormsOfLast(std::move(forms), atLeast);
    return *this;
  }

  /// Stores the location of the tag or, if the name of an attribute is given, of this attribute.
  Schema& location(Location S::*member, std::string attribute = "") {
    addLocate([member, attribute = std::move(attribute)](void* object, const Element& element) {
      static_cast<S*>(object)->*member = element.whereOf(attribute);
    });
    return *this;
  }

  /// Checks values against each other; called only if the element has no problem so far. `checker` takes a const S&, an
  /// Element and Diagnostics.
  template <class Check>
  Schema& check(Check checker) {
    addCheck([checker = std::move(checker)](const void* object, const Element& element, Diagnostics& diagnostics) {
      checker(*static_cast<const S*>(object), element, diagnostics);
    });
    return *this;
  }

  /// Declares, for the schemas that editors use, that one of the last `count` attributes must be given.
  Schema& oneOfLast(int count) {
    markAlternatives(count);
    return *this;
  }

  /// Adds `sentence`, which says where the word is available, to the error message for `word`, which is not an option
  /// of the last choice.
  Schema& elsewhere(std::string_view word, std::string_view sentence) {
    explainWordOfLast(word, sentence);
    return *this;
  }

  /// Marks all later declarations as tags that Uintah does not have.
  Schema& allOurs() {
    markAllOurs();
    return *this;
  }
  /// Marks the last declaration as a tag or attribute that Uintah does not have.
  Schema& ours() {
    markLastOurs();
    return *this;
  }

 private:
  Schema& put(SchemaEntry&& entry) {
    add(std::move(entry));
    return *this;
  }

  /// The address of `member` in an S whose type is erased. The entries do not depend on S, so that the compiler
  /// generates them only once for each type of value.
  template <class M>
  static Reach<M> reach(M S::*member) {
    return Reach<M>(member);
  }

  template <class T, class M, class... C>
  static SchemaEntry valueEntry(M S::*member, std::string_view name, std::string_view unit, std::string_view sentence,
                                const C&... constraints) {
    return valueEntryOf<T>(reach(member), name, unit, sentence, Limits<T>{limitOf<T>(constraints)...});
  }

  template <class T>
  static SchemaEntry withDefault(SchemaEntry entry, T S::*member, const T& byDefault) {
    setDefaultOf(entry, reach(member), byDefault);
    return entry;
  }

  template <class E, class M>
  static SchemaEntry choiceEntry(M S::*member, std::string_view name, const Choices<E>& choices,
                                 std::string_view sentence) {
    return choiceEntryOf<E>(reach(member), name, choices, sentence);
  }

  template <class E>
  static SchemaEntry withDefaultChoice(SchemaEntry entry, E S::*member, const Choices<E>& choices, const E& byDefault) {
    setDefaultChoiceOf(entry, reach(member), choices, byDefault);
    return entry;
  }

  template <class T, class M>
  static SchemaEntry nestedEntry(std::string_view name, const Schema<T>& schema, std::string_view sentence,
                                 M S::*member) {
    SchemaEntry entry = sectionEntry(name, schema, sentence);
    entry.fill = [reached = reach(member), &schema](void* object, const Element& element, Diagnostics& diagnostics) {
      storeIn(*reached(object), schema.read(element, diagnostics));
    };
    return entry;
  }
};

}  // namespace tushar::input
