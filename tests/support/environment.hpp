#pragma once

#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mapproof::test {

/// Ends a test as skipped (exit code 77) if sanitizers watch the programs, which scripts/check
/// sanitize says: they take address space of their own, and their calls would fail, too.
inline void skip_if_sanitized() {
  if (std::getenv("MAPPROOF_SANITIZED") == nullptr) return;
  std::fputs("skipped: limits of memory and calls that fail are not for sanitizers\n", stderr);
  std::_Exit(77);
}

/// Sets variables of the environment while it lives, or unsets those whose value is null; programs
/// started meanwhile see that. Then all are as they were.
class Environment {
 public:
  Environment(std::initializer_list<std::pair<const char*, const char*>> values) {
    for (const auto& [name, value] : values) {
      const char* before = std::getenv(name);
      before_.emplace_back(name, before == nullptr ? std::optional<std::string>() : before);
      set(name, value);
    }
  }
  ~Environment() {
    for (const auto& [name, value] : before_) set(name, value ? value->c_str() : nullptr);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  static void set(const char* name, const char* value) {
    if (value == nullptr)
      ::unsetenv(name);
    else
      ::setenv(name, value, 1);
  }

  std::vector<std::pair<const char*, std::optional<std::string>>> before_;
};

}  // namespace mapproof::test
