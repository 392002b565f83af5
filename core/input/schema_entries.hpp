#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/input/constraint.hpp"
#include "core/input/schema_base.hpp"
#include "core/input/values.hpp"

// The parts of a Schema's entries that depend on the type of the value alone, not on the structure: all schemas of a
// program share them.

namespace tushar::input {

/// The names of a choice and their values.
template <class E>
using Choices = std::vector<std::pair<std::string, E>>;

/// The address of a member in an object whose type is erased; M is T, an optional T or a list of T. Works like
/// std::function, but the compiler generates one function per structure instead of five.
template <class M>
class Reach {
 public:
  template <class S>
  explicit Reach(M S::*member) : address_(addressOf<S>) {
    static_assert(sizeof member == sizeof member_);
    std::memcpy(member_, &member, sizeof member);
  }
  M* operator()(void* object) const { return address_(member_, object); }

 private:
  template <class S>
  static M* addressOf(const std::byte* stored, void* object) {
    M S::*member;
    std::memcpy(&member, stored, sizeof member);
    return &(static_cast<S*>(object)->*member);
  }

  std::byte member_[sizeof(std::ptrdiff_t)];  ///< the member pointer, an M S::*
  M* (*address_)(const std::byte*, void*);
};

template <class T>
void storeIn(T& member, T value) {
  member = std::move(value);
}
template <class T>
void storeIn(std::optional<T>& member, T value) {
  member = std::move(value);
}
template <class T>
void storeIn(std::vector<T>& member, T value) {
  member.push_back(std::move(value));
}

/// A constraint on a T.
template <class T>
struct Limit {
  std::string allowed;  ///< the constraint in words, such as `greater than 0`
  /// Returns why a value, given as `text`, violates the constraint; empty if it does not.
  SharedFunction<std::string(const T& value, const std::string& text, const std::string& unit)> problem;
};
template <class T>
using Limits = std::vector<Limit<T>>;

template <class T, class C>
Limit<T> limitOf(const C& constraint) {
  return {constraint.allowed, [constraint](const T& value, const std::string& text, const std::string& unit) {
            return satisfies(value, constraint) ? std::string() : violation(text, constraint, unit);
          }};
}

/// The entry that reads a T into a member.
template <class T, class M>
SchemaEntry valueEntryOf(Reach<M> member, std::string_view name, std::string_view unit, std::string_view sentence,
                         Limits<T> limits) {
  SchemaEntry entry = namedEntry(name, sentence);
  entry.type = typeName<T>;
  entry.unit = unit;
  for (const Limit<T>& limit : limits) entry.limits += (entry.limits.empty() ? "" : " and ") + limit.allowed;
  entry.assign = [member = std::move(member), limits = std::move(limits), unit = entry.unit](
                     void* object, const std::string& text, const Location& where) {
    Parsed<T> parsed = parse<T>(text);
    if (!parsed) return parsed.problem;
    for (const Limit<T>& limit : limits)
      if (std::string problem = limit.problem(*parsed, text, unit); !problem.empty()) return problem;
    if constexpr (requires { parsed.value->readAt(where); }) parsed.value->readAt(where);
    storeIn(*member(object), *std::move(parsed.value));
    return std::string();
  };
  return entry;
}

template <class T>
void setDefaultOf(SchemaEntry& entry, Reach<T> member, const T& byDefault) {
  entry.fallback = toText(byDefault);
  entry.setDefault = [member = std::move(member), byDefault](void* object) { *member(object) = byDefault; };
}

/// The entry that reads one of several words into a member.
template <class E, class M>
SchemaEntry choiceEntryOf(Reach<M> member, std::string_view name, const Choices<E>& choices,
                          std::string_view sentence) {
  SchemaEntry entry = namedEntry(name, sentence);
  for (const auto& [word, meaning] : choices) entry.choices.push_back(word);
  entry.assign = [member = std::move(member), choices, words = entry.choices](void* object, const std::string& text,
                                                                              const Location&) {
    std::string problem = choiceProblem(text, words);
    if (!problem.empty()) return problem;
    const auto found = std::find(words.begin(), words.end(), text) - words.begin();
    storeIn(*member(object), E(choices[found].second));
    return std::string();
  };
  return entry;
}

template <class E>
void setDefaultChoiceOf(SchemaEntry& entry, Reach<E> member, const Choices<E>& choices, const E& byDefault) {
  const auto isDefault = [&](const auto& choice) { return choice.second == byDefault; };
  const auto found = std::find_if(choices.begin(), choices.end(), isDefault);
  assert(found != choices.end());
  entry.fallback = found->first;
  entry.setDefault = [member = std::move(member), byDefault](void* object) { *member(object) = byDefault; };
}

// Instances that nearly every component has, compiled once in the core.
#define TUSHAR_SCHEMA_INSTANCES(WORD, T)                                                                             \
  WORD template SchemaEntry valueEntryOf(Reach<T>, std::string_view, std::string_view, std::string_view, Limits<T>); \
  WORD template void setDefaultOf(SchemaEntry&, Reach<T>, const T&);
#define TUSHAR_ALL_SCHEMA_INSTANCES(WORD)    \
  TUSHAR_SCHEMA_INSTANCES(WORD, bool)        \
  TUSHAR_SCHEMA_INSTANCES(WORD, int)         \
  TUSHAR_SCHEMA_INSTANCES(WORD, double)      \
  TUSHAR_SCHEMA_INSTANCES(WORD, std::string) \
  TUSHAR_SCHEMA_INSTANCES(WORD, Vec3)        \
  TUSHAR_SCHEMA_INSTANCES(WORD, Expression)  \
  TUSHAR_SCHEMA_INSTANCES(WORD, VectorExpression)
TUSHAR_ALL_SCHEMA_INSTANCES(extern)

}  // namespace tushar::input
