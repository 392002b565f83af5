#include "core/input/refuse.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/input/text.hpp"

namespace tushar::input {

void refuseSwitch(SchemaBase& schema, const std::string& tag, const std::string& instead) {
  schema.addCustom(
      tag,
      [tag, instead](void*, const Element& element, Diagnostics& diagnostics) {
        const auto given = element.child(tag);
        if (!given || given->text() == "false" || parse<double>(given->text()).value == 0.0) return;
        diagnostics.error(*given, "is not available; " + instead);
      },
      {tag}, "only false: " + instead);
  schema.setFormsOfLast({patternForm({tag}, std::string("false|") + zeroPattern)});
}

void requireSwitch(SchemaBase& schema, const std::string& tag, const std::string& instead) {
  schema.addCustom(
      tag,
      [tag, instead](void*, const Element& element, Diagnostics& diagnostics) {
        const auto given = element.child(tag);
        if (given && given->text() != "true") diagnostics.error(*given, "is always true; " + instead);
      },
      {tag}, "only true: " + instead);
  schema.setFormsOfLast({choiceForm({tag}, {"true"})});
}

void refuseOtherValues(SchemaBase& schema, const std::string& tag, const std::vector<std::string>& values,
                       const std::string& sentence) {
  const auto isOneOfThem = [values](const std::string& given) {
    const auto number = parse<double>(given).value;
    return std::any_of(values.begin(), values.end(), [&](const std::string& value) {
      return given == value || (number && number == parse<double>(value).value);
    });
  };
  schema.addCustom(
      tag,
      [=](void*, const Element& element, Diagnostics& diagnostics) {
        const auto given = element.child(tag);
        if (given && !isOneOfThem(given->text()))
          diagnostics.error(*given, "found '" + given->text() + "', expected " + listed(values) + ": " + sentence);
      },
      {tag}, "only " + listed(values) + ": " + sentence);
  TagForm form = choiceForm({tag}, values);
  const auto isNumber = [](const std::string& value) { return parse<double>(value).value.has_value(); };
  if (std::all_of(values.begin(), values.end(), isNumber)) form.type = typeName<double>;
  schema.setFormsOfLast({std::move(form)});
}

void refuseTag(SchemaBase& schema, const std::string& tag, const std::string& instead) {
  schema.addCustom(
      tag,
      [tag, instead](void*, const Element& element, Diagnostics& diagnostics) {
        if (const auto given = element.child(tag)) diagnostics.error(*given, "is not available; " + instead);
      },
      {tag}, "not available: " + instead);
  schema.setFormsOfLast({noForm({tag})});
}

void noteTag(SchemaBase& schema, const std::string& tag, const std::string& why) {
  schema.addCustom(
      tag,
      [tag, why](void*, const Element& element, Diagnostics& diagnostics) {
        for (const Element& given : element.children(tag)) diagnostics.note(given, "does nothing: " + why);
      },
      {tag}, "does nothing: " + why);
  schema.setFormsOfLast({anyForm({tag})});
}

void noteAttribute(const Element& given, const std::string& attribute, const std::string& why,
                   Diagnostics& diagnostics) {
  if (given.attribute(attribute))
    diagnostics.note(given.whereOf(attribute), given.path(),
                     fmt::format("attribute '{}' does nothing: {}", attribute, why));
}

void refuseTypes(SchemaBase& schema, const std::string& tag, const std::vector<std::string>& available,
                 const std::string& sentence) {
  schema.addCustom(
      tag,
      [tag, available](void*, const Element& element, Diagnostics& diagnostics) {
        const auto given = element.child(tag);
        if (!given) return;
        const std::string problem = choiceProblem(given->attribute("type").value_or(""), available);
        if (!problem.empty()) diagnostics.error(*given, "attribute 'type': " + problem);
      },
      {tag}, sentence);
  TagForm form = anyForm({tag}, {{"type", available}});
  form.repeats = false;
  schema.setFormsOfLast({std::move(form)});
}

}  // namespace tushar::input
