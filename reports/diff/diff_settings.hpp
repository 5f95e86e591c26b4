#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/json/fields.hpp"
#include "reports/diff/diff_fields.hpp"
#include "reports/diff/figures/figure_diff.hpp"
#include "reports/diff/images/image_changes.hpp"
#include "reports/diff/items.hpp"
#include "reports/diff/records/record_diff.hpp"

namespace mapproof {

/// Whether a pattern (fnmatch(3): `*` any characters, also '/', `?` one, `[a-z]`, `\\` before a
/// character that stands for itself) matches a text, or is equal to it.
bool matches_glob(const std::string& pattern, const std::string& text);

/// A region of an image that is not compared.
struct IgnoredRegion {
  std::string id;  ///< A pattern of ids.
  PixelBox box;
};

/// The parts of a tolerance that are given.
struct GivenTolerance {
  std::optional<double> absolute, relative;

  Tolerance in_place_of(const Tolerance& usual) const {
    return {absolute.value_or(usual.absolute), relative.value_or(usual.relative)};
  }
};

/// The options for images that are given.
struct GivenImageOptions {
  std::optional<double> noise, mean_noise, displacement_px, changed_share, svg_distance, svg_colour;

  ImageOptions in_place_of(ImageOptions usual) const;
};

/// What differs from the settings of the whole for some items.
struct ItemSettings {
  std::string id;                    ///< A pattern of ids.
  std::vector<std::string> formats;  ///< Of the images, those that are compared; empty: all.
  GivenTolerance position;
  GivenImageOptions images;
  std::vector<Verdict> allowed;  ///< In addition to those of the whole.
};

/// The settings of a comparison.
struct DiffSettings {
  RecordOptions records;
  FigureOptions figures;
  ImageOptions images;
  std::vector<IgnoredRegion> ignored;
  std::vector<Verdict> allowed;
  std::vector<ItemSettings> items;  ///< Of several that match an item the last one counts.
  /// Patterns of what alone is compared, and of what is not: an id, or "ID.FORMAT".
  std::vector<std::string> include, exclude;
  /// The result keeps heat maps of images of about so many bytes, for its page (ImageFile::heat).
  std::size_t heat_map_bytes = 0;

  /// The options for the images of one item, with its ignored regions.
  ImageOptions images_of(const std::string& id) const;
  FigureOptions figures_of(const std::string& id) const;
  std::vector<Verdict> allowed_of(const std::string& id) const;
  /// Whether an item's file of that format is compared, "figure.json" and "png" alike. A format of
  /// "": whether the item is, of which no file is known.
  bool compares(const std::string& id, const std::string& format) const;
};

/// The two sides of a comparison and the names in them.
struct ComparedItems {
  ItemList baseline, current;
  std::vector<std::string> record_ids;  ///< Of either side.
  std::string file_name;                ///< The id of the item "" of two single files.
};

/// What the settings do to the items of a comparison.
struct Selection {
  std::vector<std::string> left_out;  ///< Ids, sorted: of these nothing is compared.
  /// Patterns that match neither an item nor a file of one, as `--exclude "map-*"`: they may be
  /// misspelt.
  std::vector<std::string> unmatched;
};

/// Removes from both sides the files that the settings leave out, and items without any file.
Selection select_items(ComparedItems& items, const DiffSettings& settings);

/// Reads mapproof-diff.json (docs/diff.md, docs/schemas/diff_settings.schema.json).
/// @throws IoError with file and JSON pointer, for unknown keys too.
DiffSettings parse_diff_settings(std::string_view text, const std::string& source);

// The fields of mapproof-diff.json and of a file of approvals (core/json/fields.hpp).

namespace record_rules {

inline constexpr double kGreatestTolerance = 1e300;

/// An optional number from 0 up.
inline FieldRule up_to(double maximum) {
  return {.minimum = 0.0, .maximum = maximum, .key = Key::kOptional};
}
inline FieldRule pixels_from(double minimum) { return {.minimum = minimum, .maximum = 1 << 20}; }

}  // namespace record_rules

template <typename Visitor>
void fields(Visitor& v, GivenTolerance& tolerance) {
  v.type("tolerance");
  v.field("absolute", tolerance.absolute,
          {.minimum = 0.0, .maximum = record_rules::kGreatestTolerance, .key = Key::kIfAny});
  v.field("relative", tolerance.relative, {.minimum = 0.0, .maximum = 1.0, .key = Key::kIfAny});
}

/// Why there cannot be a tolerance of that name; empty if there can. Whether a study declares a
/// quantity that the dictionary lacks is known only when it is compared.
std::string tolerance_problem(const std::string& name);

template <typename Visitor>
void record_option_fields(Visitor& v, RecordOptions& options) {
  v.field("significance", options.significance, record_rules::up_to(1.0));
  v.field("least_effect", options.least_effect, record_rules::up_to(1.0));
  std::map<std::string, GivenTolerance> tolerances;
  v.field("tolerances", tolerances,
          {.description = "By the id of a quantity, or other.", .key = Key::kOptional});
  if constexpr (Visitor::kReads)
    for (const auto& [name, given] : tolerances) {
      if (const std::string problem = tolerance_problem(name); !problem.empty())
        v.refuse("tolerances", problem);
      const Quantity* quantity = find_quantity(name);
      options.tolerances[name] =
          given.in_place_of(quantity == nullptr ? tolerance_of_others({}) : quantity->rounding);
    }
}

/// @tparam Options  ImageOptions or GivenImageOptions. @param key  Of every field.
template <typename Visitor, typename Options>
void image_option_fields(Visitor& v, Options& options, Key key) {
  const auto up_to = [key](double maximum) {
    return FieldRule{.minimum = 0.0, .maximum = maximum, .key = key};
  };
  v.field("noise", options.noise, up_to(64.0));
  v.field("mean_noise", options.mean_noise, up_to(64.0));
  v.field("displacement_px", options.displacement_px, up_to(4.0));
  v.field("changed_share", options.changed_share, up_to(1.0));
  v.field("svg_distance", options.svg_distance, up_to(record_rules::kGreatestTolerance));
  v.field("svg_colour", options.svg_colour, up_to(255.0));
}

/// Why there cannot be images of that format; empty if there can.
std::string format_problem(const std::string& format);

template <typename Visitor>
void fields(Visitor& v, ItemSettings& item) {
  constexpr FieldRule kOptional = {.key = Key::kOptional};
  constexpr std::size_t kMostFormats = 20;
  v.type("item_settings");
  v.field("id", item.id,
          {.description = "A pattern of ids: * any characters, ? one.", .not_empty = true});
  v.field("formats", item.formats,
          {.description = "Of the images, those that are compared, such as svg.",
           .max_items = kMostFormats,
           .not_empty = true,
           .key = Key::kOptional});
  if constexpr (Visitor::kReads)
    for (std::size_t i = 0; i < item.formats.size(); ++i)
      if (const std::string problem = format_problem(item.formats[i]); !problem.empty())
        v.refuse("formats", i, problem);
  v.group(
      "figures", [&](auto& figures) { figures.field("position", item.position, kOptional); },
      kOptional);
  v.group(
      "images", [&](auto& images) { image_option_fields(images, item.images, Key::kIfAny); },
      kOptional);
  v.field("allow", item.allowed, {.max_items = kVerdicts.size(), .key = Key::kOptional});
}

/// Finds the first number that violates its rule.
struct BoundsVisitor : FieldVisitor {
  std::string problem;

  template <typename T>
  void field(std::string_view key, T& value, const FieldRule& rule = {}) {
    if (problem.empty() && !(value >= rule.minimum && value <= rule.maximum))
      problem = fmt::format("{}: must be {} to {}", key, rule.minimum, rule.maximum);
  }
};

template <typename Visitor>
void fields(Visitor& v, IgnoredRegion& region) {
  using namespace record_rules;
  v.field("id", region.id, {.description = "A pattern of ids: * any characters, ? one."});
  v.field("x", region.box.x, pixels_from(0));
  v.field("y", region.box.y, pixels_from(0));
  v.field("width", region.box.width, pixels_from(1));
  v.field("height", region.box.height, pixels_from(1));
}

template <typename Visitor>
void fields(Visitor& v, DiffSettings& settings) {
  constexpr FieldRule kOptional = {.key = Key::kOptional};
  v.file("mapproof.diff_settings", "The settings of a comparison: mapproof-diff.json.");
  v.group(
      "records", [&](auto& records) { record_option_fields(records, settings.records); },
      kOptional);
  const auto visit_figures = [&](auto& figures) {
    GivenTolerance position;
    figures.field("position", position, kOptional);
    settings.figures.position = position.in_place_of(settings.figures.position);
  };
  v.group("figures", visit_figures, kOptional);
  v.group(
      "images", [&](auto& images) { image_option_fields(images, settings.images, Key::kOptional); },
      kOptional);
  v.field("ignore", settings.ignored, {.max_items = 10'000, .key = Key::kOptional});
  v.field("allow", settings.allowed, {.max_items = kVerdicts.size(), .key = Key::kOptional});
  v.field("items", settings.items,
          {.description = "What differs for some items; of several that match, the last counts.",
           .max_items = 10'000,
           .key = Key::kOptional});
}

/// A file of approvals.
struct ApprovalsFile {
  std::optional<std::string> baseline, current;
  std::vector<std::string> ids;
};

template <typename Visitor>
void fields(Visitor& v, ApprovalsFile& file) {
  constexpr FieldRule kSide = {.description = "As it was named when compared; for readers.",
                               .key = Key::kIfAny};
  v.file("mapproof.approvals",
         "The items whose current state is taken as the baseline: for mapproof approve --from.");
  v.field("baseline", file.baseline, kSide);
  v.field("current", file.current, kSide);
  v.field("ids", file.ids, {.min_items = 1, .max_items = 100'000});
}

/// Names the first field that cannot be used; empty if none.
std::string problem_of(const ImageOptions& options);

}  // namespace mapproof
