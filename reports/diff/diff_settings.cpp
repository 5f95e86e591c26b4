#include "reports/diff/diff_settings.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/spelling.hpp"
#include "core/json/record_reader.hpp"

namespace mapproof {
namespace {

/// "figure.json" or "scene.json".
std::string figure_format(const ItemFiles& files) {
  return files.figure.filename().string().ends_with(".scene.json") ? "scene.json" : "figure.json";
}

/// The formats of all files of an item.
std::vector<std::string> formats_of(const ItemFiles& files) {
  std::vector<std::string> formats;
  if (!files.figure.empty()) formats.push_back(figure_format(files));
  for (const auto& [format, by_key] : files.images) formats.push_back(format);
  for (const auto& [format, file] : files.documents) formats.push_back(format);
  return formats;
}

/// Removes the files that are not compared. @return The ids of items without any other.
std::set<std::string> reduce(ItemList& side, const std::string& file_name,
                             const DiffSettings& settings) {
  std::set<std::string> left_out;
  for (auto item = side.begin(); item != side.end();) {
    ItemFiles& files = item->second;
    const std::string& id = item->first.empty() ? file_name : item->first;
    const auto is_left_out = [&](const auto& entry) { return !settings.compares(id, entry.first); };
    std::erase_if(files.images, is_left_out);
    std::erase_if(files.documents, is_left_out);
    if (!files.figure.empty() && !settings.compares(id, figure_format(files))) files.figure.clear();
    if (formats_of(files).empty()) {
      left_out.insert(id);
      item = side.erase(item);
    } else {
      ++item;
    }
  }
  return left_out;
}

/// The names that a pattern can match.
struct Names {
  std::set<std::string> ids, files;  ///< Files: "ID.FORMAT".

  bool any_id(const std::string& pattern) const { return any(ids, pattern); }
  bool any_name(const std::string& pattern) const { return any_id(pattern) || any(files, pattern); }

 private:
  static bool any(const std::set<std::string>& names, const std::string& pattern) {
    return std::ranges::any_of(
        names, [&](const std::string& name) { return matches_glob(pattern, name); });
  }
};

Names names_of(const ComparedItems& items) {
  Names names;
  names.ids.insert(items.record_ids.begin(), items.record_ids.end());
  for (const ItemList* side : {&items.baseline, &items.current})
    for (const auto& [id, files] : *side) {
      const std::string& shown = id.empty() ? items.file_name : id;
      names.ids.insert(shown);
      for (const std::string& format : formats_of(files))
        names.files.insert(fmt::format("{}.{}", shown, format));
    }
  return names;
}

std::vector<std::string> unmatched_patterns(const Names& names, const DiffSettings& settings) {
  std::vector<std::string> unmatched;
  const auto add = [&](std::string_view where, const std::string& pattern) {
    unmatched.push_back(fmt::format("{} \"{}\"", where, printable(pattern)));
  };
  for (const std::string& pattern : settings.include)
    if (!names.any_name(pattern)) add("--include", pattern);
  for (const std::string& pattern : settings.exclude)
    if (!names.any_name(pattern)) add("--exclude", pattern);
  // What is meant for all items is not misspelt.
  for (const IgnoredRegion& region : settings.ignored)
    if (region.id != "*" && !names.any_id(region.id)) add("ignore", region.id);
  for (const ItemSettings& item : settings.items)
    if (item.id != "*" && !names.any_id(item.id)) add("items", item.id);
  const auto repeated = std::ranges::unique(unmatched);
  unmatched.erase(repeated.begin(), repeated.end());
  return unmatched;
}
}  // namespace

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

Selection select_items(ComparedItems& items, const DiffSettings& settings) {
  Selection selection{.left_out = {}, .unmatched = unmatched_patterns(names_of(items), settings)};
  std::set<std::string> left_out = reduce(items.baseline, items.file_name, settings);
  left_out.merge(reduce(items.current, items.file_name, settings));
  for (const std::string& id : items.record_ids)
    if (!settings.compares(id, "")) left_out.insert(id);
  // A file of the item may be compared on the other side, as a new or a missing one.
  for (const ItemList* side : {&items.baseline, &items.current})
    for (const auto& [id, files] : *side) left_out.erase(id.empty() ? items.file_name : id);
  selection.left_out.assign(left_out.begin(), left_out.end());
  return selection;
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
