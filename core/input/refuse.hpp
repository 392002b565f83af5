#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/input/schema.hpp"
#include "core/input/text.hpp"
#include "core/input/values.hpp"

namespace tushar::input {

/// Accepts a flag of Uintah only if it is `false` or 0; `instead` names the alternative.
void refuseSwitch(SchemaBase& schema, const std::string& tag, const std::string& instead);
/// Accepts a flag of Uintah only if it is `true`; `instead` names the alternative.
void requireSwitch(SchemaBase& schema, const std::string& tag, const std::string& instead);
/// Accepts a tag of Uintah only if its value is one of `values`; `sentence` gives the reason.
void refuseOtherValues(SchemaBase& schema, const std::string& tag, const std::vector<std::string>& values,
                       const std::string& sentence);
/// Refuses a tag of Uintah; `instead` names the alternative.
void refuseTag(SchemaBase& schema, const std::string& tag, const std::string& instead);
/// Accepts a tag of Uintah that has no effect, with a note that gives the reason `why`.
void noteTag(SchemaBase& schema, const std::string& tag, const std::string& why);
/// If an attribute of Uintah is given, notes that it has no effect, with the reason `why`. The attribute must be
/// declared by Schema::ignoredAttribute.
void noteAttribute(const Element& given, const std::string& attribute, const std::string& why,
                   Diagnostics& diagnostics);
/// Accepts only the `available` options of one of Uintah's choices; the tag may be omitted.
void refuseTypes(SchemaBase& schema, const std::string& tag, const std::vector<std::string>& available,
                 const std::string& sentence);

/// Reports an error for each entry of a list whose `member` is not greater than that of the previous entry. `tags` are
/// the tags of the entries.
template <class T, class Member>
void refuseDescent(const std::vector<T>& entries, Member T::*member, const std::vector<Element>& tags,
                   const std::string& problem, Diagnostics& diagnostics) {
  for (std::size_t k = 1; k < entries.size(); ++k)
    if (entries[k].*member <= entries[k - 1].*member) diagnostics.error(tags[k], problem);
}

/// Options of Uintah that are not available, each with its closest alternative.
using Lacking = std::vector<std::pair<std::string, std::string>>;

/// Declares a tag whose text is one of several words; for words that are `lacking`, the message names the closest
/// alternative.
template <class S, class E>
void requiredChoiceOrRefusal(input::Schema<S>& schema, const std::string& tag, E S::*member,
                             const std::type_identity_t<input::Choices<E>>& choices, const Lacking& lacking,
                             const std::string& sentence) {
  std::vector<std::string> words;
  for (const auto& [word, value] : choices) words.push_back(word);
  schema.custom(
      tag,
      [=](S& read, const input::Element& element, input::Diagnostics& diagnostics) {
        const auto given = element.child(tag);
        if (!given) return diagnostics.error(element, "missing tag <" + tag + "> in <" + element.name() + ">");
        for (const auto& [word, value] : choices)
          if (given->text() == word) read.*member = value;
        for (const auto& [word, nearest] : lacking)
          if (given->text() == word)
            return diagnostics.error(*given,
                                     "'" + word + "' of Uintah is not available; the most similar one is " + nearest);
        const std::string problem = input::choiceProblem(given->text(), words);
        if (!problem.empty()) diagnostics.error(*given, problem);
      },
      {tag}, input::listed(words) + ": " + sentence);
  schema.forms({choiceForm({tag}, words, 1)});
}

}  // namespace tushar::input
