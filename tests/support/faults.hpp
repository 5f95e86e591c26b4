#pragma once

#include <fstream>
#include <string>

#include "tests/support/environment.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {

/// Faults in programs that are started while it lives (see tests/support/faults.cpp).
class Faults {
 public:
  /// @param rules    As in MAPPROOF_FAULT: "alloc:7-7:fail"; empty: calls are counted alone.
  /// @param program  In which program.
  explicit Faults(const std::string& rules, const std::string& program = "mapproof")
      : environment_({{"LD_PRELOAD", shim()},
                      {"MAPPROOF_FAULT", rules.c_str()},
                      {"MAPPROOF_FAULT_IN", program.c_str()},
                      {"MAPPROOF_FAULT_COUNT", (folder_ / "counts").c_str()}}) {}

  /// How many calls of a kind were made by the program that came to its end last.
  long calls(const std::string& kind) const {
    std::ifstream file(folder_ / "counts");
    std::string name;
    for (long calls = 0; file >> name >> calls;)
      if (name == kind) return calls;
    return 0;
  }

 private:
  static const char* shim() {
    skip_if_sanitized();
    return MAPPROOF_FAULTS;
  }

  TemporaryFolder folder_;
  Environment environment_;
};

/// The rule that one call of a kind fails, or kills the program.
inline std::string at_call(const std::string& kind, long call, const std::string& what = "fail") {
  const std::string number = std::to_string(call);
  return kind + ":" + number + "-" + number + ":" + what;
}

}  // namespace mapproof::test
