#include "reports/diff/records/number_diff.hpp"

#include <array>
#include <tuple>

#include <fmt/format.h>

#include "core/base/byte_source.hpp"
#include "core/base/errors.hpp"
#include "core/json/json_cursor.hpp"
#include "reports/diff/documents/excerpts.hpp"
#include "reports/diff/records/number_words.hpp"

namespace mapproof {
namespace {

using ParsedJson = nlohmann::json;

constexpr std::size_t kMostNumberText = 60;  // Of a value that is told.

/// What keys are of that do not have a quantity's name.
struct KeyQuantity {
  std::string_view key, quantity;
};
constexpr std::array kKeys = {KeyQuantity{"estimate", "landmark_m"},
                              KeyQuantity{"truth_m", "landmark_m"},
                              KeyQuantity{"true_landmarks_m", "landmark_m"},
                              KeyQuantity{"landmarks_m", "landmark_m"},
                              KeyQuantity{"path", "path_m"},
                              KeyQuantity{"truth", "path_m"},
                              KeyQuantity{"error_m", "path_m"},
                              KeyQuantity{"positions_m", "path_m"}};

std::string shown(const ParsedJson& value) {
  if (value.is_string()) return printable(value.get<std::string>(), kMostNumberText);
  if (value.is_structured())
    return fmt::format("{} of {}", value.is_array() ? "an array" : "an object", value.size());
  return value.dump(-1, ' ', false, ParsedJson::error_handler_t::replace);
}

double largest(const ParsedJson& value) {
  if (value.is_number()) return std::abs(value.get<double>());
  double most = 0.0;
  if (value.is_array())
    for (const ParsedJson& item : value) most = std::max(most, largest(item));
  return most;
}

class NumberComparer {
 public:
  NumberComparer(const Tolerances& tolerances, OtherDiff& diff)
      : tolerances_(tolerances), diff_(diff) {}

  void compare(const ParsedJson& a, const ParsedJson& b, const std::string& pointer,
               const Tolerance& tolerance) {
    if (a.is_number() && b.is_number()) return number(a, b, pointer, tolerance);
    if (a.is_string() && b.is_string()) return text(a, b, pointer, tolerance);
    if (a.type() != b.type() || a.is_primitive()) {
      if (a != b) beyond(a, b, pointer, true);
    } else if (a.is_array()) {
      array(a, b, pointer, tolerance);
    } else {
      object(a, b, pointer, tolerance);
    }
  }

  void lines(std::string_view a, std::string_view b, const Tolerance& tolerance) {
    for (int line = 1; !a.empty() || !b.empty(); ++line)
      text(take_line(a), take_line(b), fmt::format("line {}", line), tolerance);
  }

 private:
  void beyond(const ParsedJson& a, const ParsedJson& b, const std::string& place, bool shape) {
    if (diff_.first.empty()) {
      diff_.first = place.empty() ? "/" : place;
      diff_.baseline = shown(a);
      diff_.current = shown(b);
      if (a.is_string() && b.is_string())
        std::tie(diff_.baseline, diff_.current) =
            excerpts(a.get<std::string>(), b.get<std::string>(), kMostNumberText);
    }
    diff_.shape |= shape;
    if (!shape) ++diff_.beyond;
  }

  void number(const ParsedJson& a, const ParsedJson& b, const std::string& place,
              const Tolerance& tolerance) {
    ++diff_.numbers;
    const double first = a.get<double>(), second = b.get<double>();
    if (first == second) return;
    if (tolerance.holds(first, second))
      ++diff_.within;
    else
      beyond(a, b, place, false);
  }

  void text(const ParsedJson& a, const ParsedJson& b, const std::string& place,
            const Tolerance& tolerance) {
    const TextChange change =
        text_change(a.get_ref<const std::string&>(), b.get_ref<const std::string&>(), tolerance);
    if (change == TextChange::kWithin) ++diff_.within;
    if (change > TextChange::kWithin) beyond(a, b, place, change == TextChange::kWords);
  }

  void array(const ParsedJson& a, const ParsedJson& b, const std::string& pointer,
             Tolerance tolerance) {
    if (a.size() != b.size()) return beyond(a, b, pointer, true);
    tolerance.absolute += tolerance.relative * largest(a);
    for (std::size_t i = 0; i < a.size(); ++i)
      compare(a[i], b[i], fmt::format("{}/{}", pointer, i), tolerance);
  }

  void object(const ParsedJson& a, const ParsedJson& b, const std::string& pointer,
              const Tolerance& tolerance) {
    const bool is_shape = a.contains("frame") && a["frame"] == "similarity";
    for (const auto& [key, value] : a.items()) {
      const std::string place = pointer + "/" + key;
      const auto other = b.find(key);
      if (other == b.end())
        beyond(value, "not there", place, true);
      else if (!is_shape || key != "estimate")
        compare(value, *other, place, tolerance_at(key, value, tolerance));
    }
    for (const auto& [key, value] : b.items())
      if (!a.contains(key)) beyond("not there", value, pointer + "/" + key, true);
  }

  Tolerance tolerance_at(const std::string& key, const ParsedJson& value,
                         const Tolerance& outer) const {
    if (value.is_structured())  // Of scores there are numbers of the same names.
      for (const KeyQuantity& known : kKeys)
        if (known.key == key) return tolerance_of(known_quantity(known.quantity), tolerances_);
    const Quantity* facts = find_quantity(key);
    return facts == nullptr ? outer : tolerance_of(*facts, tolerances_);
  }

  static std::string take_line(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
  }

  const Tolerances& tolerances_;
  OtherDiff& diff_;
};

}  // namespace

OtherDiff number_diff(const std::string& name, const std::filesystem::path& baseline,
                      const std::filesystem::path& current, const Tolerances& tolerances) {
  OtherDiff diff;
  diff.file = name;
  NumberComparer comparer(tolerances, diff);
  const Tolerance tolerance = tolerance_of_others(tolerances);
  const std::string before = read_input(baseline), after = read_input(current);
  if (name.empty() || baseline.extension() == ".json")
    comparer.compare(parse_json(before, baseline.string()).root,
                     parse_json(after, current.string()).root, "", tolerance);
  else
    comparer.lines(before, after, tolerance_of(known_quantity("path_m"), tolerances));
  return diff;
}

}  // namespace mapproof
