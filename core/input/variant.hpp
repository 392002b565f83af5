#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/input/schema.hpp"

namespace tushar::input {

/// A tag whose attribute `type` selects one of several structs, each with a `name` and a `schema()`.
template <class Variant>
class TypedTag;

template <class... Ts>
class TypedTag<std::variant<Ts...>> {
 public:
  /// Reads the tag `element`; if its type is unknown, the result is the first of the structs with its defaults.
  static std::variant<Ts...> read(const input::Element& element, input::Diagnostics& diagnostics) {
    std::variant<Ts...> result;
    const std::string type = element.attribute("type").value_or("");
    if (const std::string problem = input::choiceProblem(type, names()); !problem.empty())
      diagnostics.error(element, "attribute 'type': " + problem);
    ((type == Ts::name ? void(result = schema<Ts>().read(element, diagnostics)) : void()), ...);
    return result;
  }
  static std::vector<std::string> names() { return {std::string(Ts::name)...}; }
  static void describe(std::ostream& out, int indent) { (describeOne<Ts>(out, indent), ...); }
  /// The forms of the tag, one for each type.
  static std::vector<input::Alternative> alternatives() {
    return {{&schema<Ts>(), {{"type", {std::string(Ts::name)}}}}...};
  }

 private:
  template <class T>
  static const input::Schema<T>& schema() {
    static const input::Schema<T> schema = input::Schema<T>(T::schema()).foreignAttribute("type", T::name);
    return schema;
  }
  template <class T>
  static void describeOne(std::ostream& out, int indent) {
    out << std::string(indent, ' ') << "type=\"" << T::name << "\": " << T::schema().sentence() << '\n';
    T::schema().describeContents(out, indent + 2);
  }
};

/// Adds a tag whose attribute `type` selects a struct (see TypedTag) to a schema; if the tag is omitted, the member
/// keeps its default.
template <class S, class Variant>
void typedTag(input::Schema<S>& schema, const std::string& tag, Variant S::*member, const std::string& sentence,
              bool isRequired) {
  schema.custom(
      tag,
      [=](S& object, const input::Element& element, input::Diagnostics& diagnostics) {
        if (const auto given = element.child(tag))
          object.*member = TypedTag<Variant>::read(*given, diagnostics);
        else if (isRequired)
          diagnostics.error(element, "missing tag <" + tag + "> (" + sentence + ")");
      },
      {tag}, sentence, TypedTag<Variant>::describe);
  schema.forms({onceForm(tag, TypedTag<Variant>::alternatives, isRequired ? 1 : 0)});
}

}  // namespace tushar::input
