#include "reports/diff/diff_settings.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/spelling.hpp"
#include "core/json/record_reader.hpp"

namespace mapproof {

std::string tolerance_problem(const std::string& name) {
  std::vector<std::string_view> known = {kOtherNumbers};
  for (const Quantity& quantity : all_quantities()) known.push_back(quantity.id);
  if (std::ranges::find(known, name) != known.end()) return "";
  const std::string_view meant = likely_word(name, known);
  if (!meant.empty())
    return fmt::format("there is no quantity \"{}\"; did you mean {}?", printable(name), meant);
  return problem_of({.id = name, .label = name});
}

ImageOptions DiffSettings::images_of(const std::string& id) const {
  ImageOptions options = images;
  for (const IgnoredRegion& region : ignored)
    if (region.id == "*" || region.id == id) options.ignored.push_back(region.box);
  return options;
}

DiffSettings parse_diff_settings(std::string_view text, const std::string& source) {
  return from_json_text<DiffSettings>(text, source);
}

std::string problem_of(const ImageOptions& given) {
  for (const PixelBox& box : given.ignored)
    if (box.width < 1 || box.height < 1) return "ignored: a box needs a width and a height above 0";
  BoundsVisitor bounds;
  ImageOptions options = given;
  image_option_fields(bounds, options);
  return bounds.problem;
}

}  // namespace mapproof
