#pragma once

#include <cstdlib>
#include <initializer_list>
#include <utility>
#include <vector>

namespace mapproof::test {

/// Sets variables of the environment while it lives; programs started meanwhile see them.
class Environment {
 public:
  Environment(std::initializer_list<std::pair<const char*, const char*>> values) : values_(values) {
    for (const auto& [name, value] : values_) ::setenv(name, value, 1);
  }
  ~Environment() {
    for (const auto& [name, value] : values_) ::unsetenv(name);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  std::vector<std::pair<const char*, const char*>> values_;
};

}  // namespace mapproof::test
