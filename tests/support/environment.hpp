#pragma once

#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

namespace tushar::test {

/// Sets or unsets an environment variable for the lifetime of the object.
class Environment {
 public:
  Environment(std::string name, const std::optional<std::string>& value) : name_(std::move(name)) {
    if (const char* found = std::getenv(name_.c_str())) before_ = found;
    set(value);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  ~Environment() { set(before_); }

 private:
  void set(const std::optional<std::string>& value) const {
    value ? setenv(name_.c_str(), value->c_str(), 1) : unsetenv(name_.c_str());
  }

  std::string name_;
  std::optional<std::string> before_;
};

}  // namespace tushar::test
