#include "reports/diff/number_diff.hpp"

#include <fmt/format.h>

#include "core/base/files.hpp"
#include "core/json/json_cursor.hpp"

namespace mapproof {
namespace {

void compare(const nlohmann::json& a, const nlohmann::json& b, const std::string& pointer,
             const Tolerance& tolerance, OtherDiff& diff) {
  const auto beyond = [&](bool shape) {
    if (diff.first.empty()) diff.first = pointer.empty() ? "/" : pointer;
    diff.shape |= shape;
    if (!shape) ++diff.beyond;
  };
  if (a.is_number() && b.is_number()) {
    ++diff.numbers;
    const double first = a.get<double>(), second = b.get<double>();
    if (first == second) return;
    if (tolerance.holds(first, second))
      ++diff.within;
    else
      beyond(false);
    return;
  }
  if (a.type() != b.type() || a.size() != b.size()) return beyond(true);
  if (a.is_array()) {
    for (std::size_t i = 0; i < a.size(); ++i)
      compare(a[i], b[i], fmt::format("{}/{}", pointer, i), tolerance, diff);
  } else if (a.is_object()) {
    for (const auto& [key, value] : a.items()) {
      if (!b.contains(key)) return beyond(true);
      compare(value, b[key], pointer + "/" + key, tolerance, diff);
    }
  } else if (a != b) {
    beyond(true);
  }
}

}  // namespace

OtherDiff number_diff(const std::string& name, const std::filesystem::path& baseline,
                      const std::filesystem::path& current, const Tolerance& tolerance) {
  OtherDiff diff;
  diff.file = name;
  compare(parse_json(read_file(baseline), baseline.string()).root,
          parse_json(read_file(current), current.string()).root, "", tolerance, diff);
  return diff;
}

}  // namespace mapproof
