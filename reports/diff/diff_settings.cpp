#include "reports/diff/diff_settings.hpp"

#include <fnmatch.h>

#include <algorithm>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/spelling.hpp"
#include "core/json/record_reader.hpp"
#include "reports/diff/items.hpp"

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

bool matches_glob(const std::string& pattern, const std::string& text) {
  return pattern == text || ::fnmatch(pattern.c_str(), text.c_str(), 0) == 0;
}

std::string format_problem(const std::string& format) {
  return is_decoded(format) || is_not_compared(format)
             ? ""
             : fmt::format("there are no images of format \"{}\"; there are png, svg, pdf, jpg, …",
                           printable(format));
}

ImageOptions GivenImageOptions::in_place_of(ImageOptions usual) const {
  usual.noise = noise.value_or(usual.noise);
  usual.mean_noise = mean_noise.value_or(usual.mean_noise);
  usual.displacement_px = displacement_px.value_or(usual.displacement_px);
  usual.changed_share = changed_share.value_or(usual.changed_share);
  usual.svg_distance = svg_distance.value_or(usual.svg_distance);
  usual.svg_colour = svg_colour.value_or(usual.svg_colour);
  return usual;
}

ImageOptions DiffSettings::images_of(const std::string& id) const {
  ImageOptions options = images;
  for (const ItemSettings& item : items)
    if (matches_glob(item.id, id)) options = item.images.in_place_of(std::move(options));
  for (const IgnoredRegion& region : ignored)
    if (matches_glob(region.id, id)) options.ignored.push_back(region.box);
  return options;
}

FigureOptions DiffSettings::figures_of(const std::string& id) const {
  FigureOptions options = figures;
  for (const ItemSettings& item : items)
    if (matches_glob(item.id, id)) options.position = item.position.in_place_of(options.position);
  return options;
}

std::vector<Verdict> DiffSettings::allowed_of(const std::string& id) const {
  std::vector<Verdict> all = allowed;
  for (const ItemSettings& item : items)
    if (matches_glob(item.id, id)) all.insert(all.end(), item.allowed.begin(), item.allowed.end());
  return all;
}

bool DiffSettings::compares(const std::string& id, const std::string& format) const {
  const auto names = [&](const std::string& pattern) {
    return matches_glob(pattern, id) ||
           (!format.empty() && matches_glob(pattern, id + "." + format));
  };
  if ((!include.empty() && std::ranges::none_of(include, names)) ||
      std::ranges::any_of(exclude, names))
    return false;
  const std::vector<std::string>* formats = nullptr;
  for (const ItemSettings& item : items)
    if (!item.formats.empty() && matches_glob(item.id, id)) formats = &item.formats;
  return formats == nullptr || !(is_decoded(format) || is_not_compared(format)) ||
         std::ranges::find(*formats, format) != formats->end();
}

DiffSettings parse_diff_settings(std::string_view text, const std::string& source) {
  return from_json_text<DiffSettings>(text, source);
}

std::string problem_of(const ImageOptions& given) {
  for (const PixelBox& box : given.ignored)
    if (box.width < 1 || box.height < 1) return "ignored: a box needs a width and a height above 0";
  BoundsVisitor bounds;
  ImageOptions options = given;
  image_option_fields(bounds, options, Key::kOptional);
  return bounds.problem;
}

}  // namespace mapproof
