#pragma once

#include <functional>
#include <string>
#include <vector>

namespace tushar::input {

class SchemaBase;

/// A required attribute or tag whose value is one of some words; any value is allowed if there are no words.
struct Demand {
  std::string name;
  std::vector<std::string> words;
};

/// One form of a tag: its schema, and the conditions under which that schema reads it.
struct Alternative {
  const SchemaBase* schema = nullptr;  ///< schema of this form; must outlive the form
  std::vector<Demand> demands;
};

/// The allowed content of tags that a function reads. Used for the schemas that editors use, not for reading.
struct TagForm {
  enum class Kind { anything, nothing, value, section };

  std::vector<std::string> tags = {};
  Kind kind = Kind::anything;
  std::string type = {};  ///< name of the type of a value in the manual: see typeName
  /// Allowed words for a value; compared as values of the type, if there is one.
  std::vector<std::string> choices = {};
  /// Regular expression of XML Schema that a value must match, instead of the type.
  std::string pattern = {};
  std::vector<Demand> demands = {};  ///< required attributes of a tag whose other contents may be anything
  /// The schemas of a section; called when all schemas are complete.
  std::function<std::vector<Alternative>()> alternatives = {};
  int atLeast = 0;      ///< smallest number of occurrences of each tag
  bool repeats = true;  ///< whether a tag may be given more than once
};

/// Tags with a value of a given type, each given at most once.
inline TagForm typeForm(std::vector<std::string> tags, std::string type, int atLeast = 0) {
  return {.tags = std::move(tags),
          .kind = TagForm::Kind::value,
          .type = std::move(type),
          .atLeast = atLeast,
          .repeats = false};
}

/// Tags whose text is one of some words.
inline TagForm choiceForm(std::vector<std::string> tags, std::vector<std::string> words, int atLeast = 0) {
  TagForm form = typeForm(std::move(tags), "", atLeast);
  form.choices = std::move(words);
  return form;
}

/// Tags whose text, after blanks are collapsed, matches a regular expression of XML Schema.
inline TagForm patternForm(std::vector<std::string> tags, std::string pattern) {
  TagForm form = typeForm(std::move(tags), "");
  form.pattern = std::move(pattern);
  return form;
}

/// Tags that are never allowed.
inline TagForm noForm(std::vector<std::string> tags) {
  return {.tags = std::move(tags), .kind = TagForm::Kind::nothing};
}

/// Tags whose contents are not checked, except for the attributes in `demands`.
inline TagForm anyForm(std::vector<std::string> tags, std::vector<Demand> demands = {}) {
  return {.tags = std::move(tags), .demands = std::move(demands)};
}

/// Tags that schemas read.
inline TagForm sectionForm(std::vector<std::string> tags, std::function<std::vector<Alternative>()> alternatives,
                           int atLeast = 0) {
  return {.tags = std::move(tags),
          .kind = TagForm::Kind::section,
          .alternatives = std::move(alternatives),
          .atLeast = atLeast};
}

/// A tag that schemas read, given at most once.
inline TagForm onceForm(std::string tag, std::function<std::vector<Alternative>()> alternatives, int atLeast = 0) {
  TagForm form = sectionForm({std::move(tag)}, std::move(alternatives), atLeast);
  form.repeats = false;
  return form;
}

/// A regular expression that matches the number 0.
inline constexpr const char* zeroPattern = R"([+\-]?(0+(\.0*)?|\.0+)([eE][+\-]?[0-9]+)?)";

}  // namespace tushar::input
