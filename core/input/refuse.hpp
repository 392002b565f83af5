#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/input/schema.hpp"
#include "core/input/text.hpp"
#include "core/input/values.hpp"

namespace tushar::input {

/// Accepts a switch of Uintah's only if it is `false` or 0; `instead` names the alternative.
template <class S>
void refuseSwitch(input::Schema<S>& schema, const std::string& tag, const std::string& instead) {
  schema.custom(
      tag,
      [tag, instead](S&, const input::Element& element, input::Diagnostics& diagnostics) {
        const auto given = element.child(tag);
        if (!given || given->text() == "false" || input::parse<double>(given->text()).value == 0.0) return;
        diagnostics.error(*given, "is not available; " + instead);
      },
      {tag}, "only false: " + instead);
  schema.forms({patternForm({tag}, std::string("false|") + zeroPattern)});
}

/// Accepts a switch of Uintah's only if it is `true`; `instead` names the alternative.
template <class S>
void requireSwitch(input::Schema<S>& schema, const std::string& tag, const std::string& instead) {
  schema.custom(
      tag,
      [tag, instead](S&, const input::Element& element, input::Diagnostics& diagnostics) {
        const auto given = element.child(tag);
        if (given && given->text() != "true") diagnostics.error(*given, "is always true; " + instead);
      },
      {tag}, "only true: " + instead);
  schema.forms({choiceForm({tag}, {"true"})});
}

/// Accepts a tag of Uintah's only with one of some values; `sentence` says why.
template <class S>
void refuseOtherValues(input::Schema<S>& schema, const std::string& tag, const std::vector<std::string>& values,
                       const std::string& sentence) {
  const auto isOneOfThem = [values](const std::string& given) {
    const auto number = input::parse<double>(given).value;
    return std::any_of(values.begin(), values.end(), [&](const std::string& value) {
      return given == value || (number && number == input::parse<double>(value).value);
    });
  };
  schema.custom(
      tag,
      [=](S&, const input::Element& element, input::Diagnostics& diagnostics) {
        const auto given = element.child(tag);
        if (given && !isOneOfThem(given->text()))
          diagnostics.error(*given,
                            "found '" + given->text() + "', expected " + input::listed(values) + ": " + sentence);
      },
      {tag}, "only " + input::listed(values) + ": " + sentence);
  TagForm form = choiceForm({tag}, values);
  const auto isNumber = [](const std::string& value) { return input::parse<double>(value).value.has_value(); };
  if (std::all_of(values.begin(), values.end(), isNumber)) form.type = typeName<double>;
  schema.forms({std::move(form)});
}

/// Refuses each entry of a list whose `member` is not above that of the entry before it. `tags` are the entries' own.
template <class T, class Member>
void refuseDescent(const std::vector<T>& entries, Member T::*member, const std::vector<Element>& tags,
                   const std::string& problem, Diagnostics& diagnostics) {
  for (std::size_t k = 1; k < entries.size(); ++k)
    if (entries[k].*member <= entries[k - 1].*member) diagnostics.error(tags[k], problem);
}

/// Refuses a tag of Uintah's; `instead` names the alternative.
template <class S>
void refuseTag(input::Schema<S>& schema, const std::string& tag, const std::string& instead) {
  schema.custom(
      tag,
      [tag, instead](S&, const input::Element& element, input::Diagnostics& diagnostics) {
        if (const auto given = element.child(tag)) diagnostics.error(*given, "is not available; " + instead);
      },
      {tag}, "not there: " + instead);
  schema.forms({noForm({tag})});
}

/// Accepts a tag of Uintah's that has no effect here, with a note that says `why`.
template <class S>
void noteTag(input::Schema<S>& schema, const std::string& tag, const std::string& why) {
  schema.custom(
      tag,
      [tag, why](S&, const input::Element& element, input::Diagnostics& diagnostics) {
        for (const input::Element& given : element.children(tag)) diagnostics.note(given, "does nothing: " + why);
      },
      {tag}, "does nothing: " + why);
  schema.forms({anyForm({tag})});
}

/// Accepts only the `available` options of a choice of Uintah's; the tag may be left out.
template <class S>
void refuseTypes(input::Schema<S>& schema, const std::string& tag, const std::vector<std::string>& available,
                 const std::string& sentence) {
  schema.custom(
      tag,
      [tag, available](S&, const input::Element& element, input::Diagnostics& diagnostics) {
        const auto given = element.child(tag);
        if (!given) return;
        const std::string problem = input::choiceProblem(given->attribute("type").value_or(""), available);
        if (!problem.empty()) diagnostics.error(*given, "attribute 'type': " + problem);
      },
      {tag}, sentence);
  TagForm form = anyForm({tag}, {{"type", available}});
  form.repeats = false;
  schema.forms({std::move(form)});
}

/// Options of Uintah's that are not available, and the nearest alternative of each.
using Lacking = std::vector<std::pair<std::string, std::string>>;

/// Declares a tag with one of several words; for those that are `lacking`, the message names the nearest.
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
            return diagnostics.error(*given, "'" + word + "' of Uintah is not available; the nearest is " + nearest);
        const std::string problem = input::choiceProblem(given->text(), words);
        if (!problem.empty()) diagnostics.error(*given, problem);
      },
      {tag}, input::listed(words) + ": " + sentence);
  schema.forms({choiceForm({tag}, words, 1)});
}

}  // namespace tushar::input
