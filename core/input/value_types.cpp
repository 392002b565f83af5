#include "core/input/value_types.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/input/values.hpp"

namespace tushar::input {

namespace {

constexpr const char* integer = R"([+\-]?[0-9]+(\.0*)?)";
constexpr const char* number = R"([+\-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+\-]?[0-9]+)?)";

std::string threeOf(const std::string& pattern) { return fmt::format(R"(\[ ?{0} ?, ?{0} ?, ?{0} ?\])", pattern); }

std::string anyNumberOf(const std::string& pattern) { return fmt::format(R"({0}|\[ ?({0}( ?, ?{0})*)? ?\])", pattern); }

/// The pattern of a formula: a number, or a text with a character that does not occur in numbers.
std::string formula() { return fmt::format(R"({}|[^\[\]]*[^\[\]+\-.0-9eE][^\[\]]*)", number); }

template <class T>
ValueType typeOf(const std::string& name, const std::string& pattern) {
  return {std::string(typeName<T>), name, pattern};
}

}  // namespace

const std::vector<ValueType>& valueTypes() {
  static const std::vector<ValueType> types{
      typeOf<std::string>("text", ".+"),
      {"empty, true or false", "flag", "(true|false)?"},
      typeOf<bool>("truth", "true|false"),
      typeOf<int>("integer", integer),
      typeOf<double>("number", number),
      typeOf<Vec3>("numbers3", threeOf(number)),
      typeOf<Index3>("integers3", threeOf(integer)),
      typeOf<std::vector<double>>("numbers", anyNumberOf(number)),
      typeOf<std::vector<int>>("integers", anyNumberOf(integer)),
      typeOf<std::vector<Index3>>("integers3s", fmt::format(R"({0}|\[ ?{0}( ?, ?{0})* ?\])", threeOf(integer))),
      typeOf<std::vector<std::string>>("words", R"(\[.*\])"),
      typeOf<Expression>("formula", formula()),
      typeOf<VectorExpression>("formulas3", R"(\[.+,.+,.+\])"),
  };
  return types;
}

const ValueType& valueTypeOf(const std::string& type) {
  const std::vector<ValueType>& types = valueTypes();
  const auto found = std::find_if(types.begin(), types.end(), [&](const ValueType& one) { return one.type == type; });
  return found == types.end() ? types.front() : *found;
}

std::vector<TagForm> formsOf(const SchemaEntry& entry) {
  using Form = SchemaEntry::Form;
  if (entry.form == Form::ignored) return {anyForm(entry.takes)};
  if (entry.form == Form::custom) return entry.forms.empty() ? std::vector{anyForm(entry.takes)} : entry.forms;
  TagForm form = typeForm(entry.takes, entry.type, entry.atLeast);
  form.choices = entry.choices;
  if (entry.form == Form::nested)
    form = sectionForm(
        entry.takes,
        [nested = entry.nested] {
          return std::vector<Alternative>{{nested, {}}};
        },
        entry.atLeast);
  form.repeats = entry.repeatable;
  return {std::move(form)};
}

std::string documentationOf(const SchemaEntry& entry) {
  std::string text = factsOf(entry);
  if (!entry.sentence.empty()) text += (text.empty() ? "" : ": ") + entry.sentence;
  return text + (entry.ours ? " [Tushar's own]" : "");
}

const Demand* findDemand(const std::vector<Demand>& demands, const std::string& name) {
  const auto found = std::find_if(demands.begin(), demands.end(), [&](const Demand& one) { return one.name == name; });
  return found == demands.end() ? nullptr : &*found;
}

}  // namespace tushar::input
