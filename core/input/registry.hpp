#pragma once

#include <fmt/format.h>

#include <functional>
#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"

namespace tushar::input {

/// The implementations of an interface that scenes choose by name, each with its sentence and its manual.
template <class Interface, class... Args>
class Registry {
 public:
  using Factory = std::function<std::unique_ptr<Interface>(Args...)>;
  /// Writes the manual of the settings, indented by that many blanks.
  using Describe = std::function<void(std::ostream&, int)>;

  struct Entry {
    std::string sentence;
    Factory create;
    Describe describe;
  };

  /// Adds, or replaces, the implementation called `name`.
  Registry& add(const std::string& name, std::string sentence, Factory create, Describe describe = {}) {
    entries_.insert_or_assign(name, Entry{std::move(sentence), std::move(create), std::move(describe)});
    return *this;
  }

  /// Null if there is none of that name.
  const Entry* find(std::string_view name) const {
    const auto found = entries_.find(name);
    return found == entries_.end() ? nullptr : &found->second;
  }

  /// In alphabetical order.
  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const auto& [name, entry] : entries_) out.push_back(name);
    return out;
  }

  /// `unknown contact 'fricton', expected 'friction' or 'rigid' (did you mean 'friction'?)`.
  std::string unknown(std::string_view kind, std::string_view name) const {
    if (entries_.empty()) return fmt::format("unknown {} '{}'; none is known", kind, name);
    return fmt::format("unknown {} '{}', expected {}{}", kind, name, alternatives(names()), didYouMean(name, names()));
  }

  /// The manual of all implementations, indented by that many blanks.
  void describe(std::ostream& out, int indent = 0) const {
    for (const auto& [name, entry] : entries_) {
      out << std::string(static_cast<std::size_t>(indent), ' ') << name << ": " << entry.sentence << '\n';
      if (entry.describe) entry.describe(out, indent + 2);
    }
  }

 private:
  std::map<std::string, Entry, std::less<>> entries_;
};

}  // namespace tushar::input
