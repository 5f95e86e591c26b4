#pragma once

#include <string>

#include "tests/support/program.hpp"

namespace mapproof::test {

/// Draws path.png and path.svg in the current folder; its argument is the height of a point.
inline constexpr const char* kMatplotlibScript = R"(import sys
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
figure, axes = plt.subplots(figsize=(4, 3))
axes.plot([0, 1, 2], [0, float(sys.argv[1]), 1], marker="o", label="path")
axes.legend()
figure.savefig("path.png")
figure.savefig("path.svg")
)";

/// Debian's Python, for which its packages are.
inline std::string python() { return "/usr/bin/python3"; }

inline bool has_module(const std::string& name) {
  return run_program({python(), "-c", "import " + name}).exit_code == 0;
}
inline bool has_matplotlib() { return has_module("matplotlib"); }

}  // namespace mapproof::test
