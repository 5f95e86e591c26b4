#include "reports/diff/diff_settings.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/spelling.hpp"
#include "core/json/json_cursor.hpp"

namespace mapproof {
namespace {

constexpr double kGreatestTolerance = 1e300;
constexpr std::size_t kMostRegions = 10'000;
constexpr int kMostPixels = 1 << 20;

Tolerance read_tolerance(const JsonCursor& at, Tolerance tolerance) {
  at.allow_only({"absolute", "relative"});
  if (const auto value = at.find("absolute")) tolerance.absolute = value->number(0.0, kGreatestTolerance);
  if (const auto value = at.find("relative")) tolerance.relative = value->number(0.0, 1.0);
  return tolerance;
}

/// Why there cannot be a tolerance of that name; empty if there can: whether a study declares a
/// quantity that the dictionary lacks shows when it is compared.
std::string tolerance_problem(const std::string& name) {
  std::vector<std::string_view> known = {kOtherNumbers};
  for (const Quantity& quantity : all_quantities()) known.push_back(quantity.id);
  if (std::ranges::find(known, name) != known.end()) return "";
  const std::string_view meant = likely_word(name, known);
  if (!meant.empty())
    return fmt::format("there is no quantity \"{}\"; did you mean {}?", printable(name), meant);
  return problem_of({.id = name, .label = name});
}

void read_record_options(const JsonCursor& at, RecordOptions& options) {
  at.allow_only({"significance", "least_effect", "tolerances"});
  if (const auto value = at.find("significance")) options.significance = value->number(0.0, 1.0);
  if (const auto value = at.find("least_effect")) options.least_effect = value->number(0.0, 1.0);
  const auto tolerances = at.find("tolerances");
  if (!tolerances) return;
  for (const auto& [name, value] : tolerances->members()) {
    if (const std::string problem = tolerance_problem(name); !problem.empty())
      tolerances->fail(problem);
    const Quantity* quantity = find_quantity(name);
    options.tolerances[name] =
        read_tolerance(value, quantity == nullptr ? tolerance_of_others({}) : quantity->rounding);
  }
}

void read_picture_options(const JsonCursor& at, PictureOptions& options) {
  at.allow_only(
      {"noise", "mean_noise", "displacement_px", "changed_share", "svg_distance", "svg_colour"});
  const auto read = [&](const char* key, double most, double& value) {
    if (const auto found = at.find(key)) value = found->number(0.0, most);
  };
  read("noise", 64.0, options.noise);
  read("mean_noise", 64.0, options.mean_noise);
  read("displacement_px", 4.0, options.displacement_px);
  read("changed_share", 1.0, options.changed_share);
  read("svg_distance", kGreatestTolerance, options.svg_distance);
  read("svg_colour", 255.0, options.svg_colour);
  if (const std::string problem = options.problem(); !problem.empty()) at.fail(problem);
}

IgnoredRegion read_region(const JsonCursor& at) {
  at.allow_only({"id", "x", "y", "width", "height"});
  return {.id = at.at("id").text(),
          .box = {.x = at.at("x").integer32(0, kMostPixels),
                  .y = at.at("y").integer32(0, kMostPixels),
                  .width = at.at("width").integer32(1, kMostPixels),
                  .height = at.at("height").integer32(1, kMostPixels)}};
}

Verdict read_verdict(const JsonCursor& at) {
  const auto verdict = verdict_named(at.text());
  if (!verdict) at.fail("is no verdict: \"" + printable(at.text()) + "\"");
  return *verdict;
}

}  // namespace

PictureOptions DiffSettings::pictures_of(const std::string& id) const {
  PictureOptions options = pictures;
  for (const IgnoredRegion& region : ignored)
    if (region.id == "*" || region.id == id) options.ignored.push_back(region.box);
  return options;
}

DiffSettings parse_diff_settings(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  const JsonCursor root = document.cursor();
  expect_schema(root, "mapproof.diff_settings");
  root.allow_only({"schema", "records", "figures", "pictures", "ignore", "allow"});
  DiffSettings settings;
  if (const auto at = root.find("records")) read_record_options(*at, settings.records);
  if (const auto at = root.find("figures")) {
    at->allow_only({"position"});
    if (const auto position = at->find("position"))
      settings.figures.position = read_tolerance(*position, settings.figures.position);
  }
  if (const auto at = root.find("pictures")) read_picture_options(*at, settings.pictures);
  if (const auto at = root.find("ignore"))
    for (const JsonCursor& region : at->elements(0, kMostRegions))
      settings.ignored.push_back(read_region(region));
  if (const auto at = root.find("allow"))
    for (const JsonCursor& verdict : at->elements(0, kVerdicts.size()))
      settings.allowed.push_back(read_verdict(verdict));
  return settings;
}

}  // namespace mapproof
