#include "reports/diff/images/image_diff.hpp"

#include <algorithm>
#include <array>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/parallel.hpp"
#include "core/base/text/words.hpp"
#include "render/image/png_check.hpp"
#include "render/image/png_chunks.hpp"
#include "render/image/png_read.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/diff/images/flat_ground.hpp"
#include "reports/diff/images/pixel_judgement.hpp"
#include "reports/diff/images/tile_evidence.hpp"
#include "reports/diff/svg/svg_parser.hpp"

namespace mapproof {

namespace {

// An image has noise everywhere if this share of its pixels differ by no more than noise.
constexpr double kNoisyShare = 0.2;

// Of 255: a contrast above any allowed noise.
constexpr double kContrast = 16.0;

/// The result of the first pass over a tile.
struct TileStyle {
  bool differs = false;
  bool is_textured = false;   ///< Not of one colour.
  bool has_contrast = false;  ///< It has colours further apart than kContrast.
  int within_noise = 0;       ///< Pixels that differ by no more than noise.
};

/// The pixels of a tile, cut off at the image's edge.
PixelBox box_of(const ChangeMap& marks, const Image& image, int tile) {
  const int x0 = tile % marks.across() * kTile, y0 = tile / marks.across() * kTile;
  return {x0, y0, std::min(kTile, image.width - x0), std::min(kTile, image.height - y0)};
}

/// Makes `current` equal to the baseline in the boxes. @return The number of pixels in them.
std::int64_t ignore(const Image& baseline, Image& current, const std::vector<PixelBox>& boxes) {
  std::vector<bool> is_ignored(boxes.empty() ? 0 : baseline.pixels.size());
  for (const PixelBox& box : boxes) {
    const std::int64_t right =
        std::min<std::int64_t>(std::int64_t{box.x} + box.width, baseline.width);
    const std::int64_t end =
        std::min<std::int64_t>(std::int64_t{box.y} + box.height, baseline.height);
    for (std::int64_t y = std::max(box.y, 0); y < end; ++y)
      for (std::int64_t x = std::max(box.x, 0); x < right; ++x) {
        const std::size_t i = static_cast<std::size_t>(y * baseline.width + x);
        current.pixels[i] = baseline.pixels[i];
        is_ignored[i] = true;
      }
  }
  return std::ranges::count(is_ignored, true);
}

bool is_within(std::uint32_t a, std::uint32_t b, double noise) {
  return largest_difference(a, b) <= noise;
}

TileStyle look_at(const Image& a, const Image& b, const PixelBox& box, double noise) {
  TileStyle style;
  const std::uint32_t first = a.row(box.y)[box.x];
  for (int y = box.y; y < box.y + box.height; ++y) {
    const std::uint32_t *p = a.row(y) + box.x, *q = b.row(y) + box.x;
    style.is_textured =
        style.is_textured || std::any_of(p, p + box.width, [=](auto v) { return v != first; });
    style.has_contrast =
        style.has_contrast || (style.is_textured && std::any_of(p, p + box.width, [=](auto v) {
                                 return !is_within(v, first, kContrast);
                               }));
    if (std::memcmp(p, q, sizeof *p * static_cast<std::size_t>(box.width)) == 0) continue;
    style.differs = true;
    for (int x = 0; x < box.width; ++x)
      style.within_noise += p[x] != q[x] && is_within(p[x], q[x], noise);
  }
  return style;
}

std::vector<TileStyle> styles_at(const Image& baseline, const Image& current,
                                 const ChangeMap& marks, double noise) {
  std::vector<TileStyle> styles(static_cast<std::size_t>(marks.across()) * marks.down());
  parallel_for(static_cast<std::size_t>(marks.down()), [&](std::size_t i) {
    const int row = static_cast<int>(i);
    for (int tile = row * marks.across(); tile < (row + 1) * marks.across(); ++tile)
      styles[tile] = look_at(baseline, current, box_of(marks, baseline, tile), noise);
  });
  return styles;
}

/// Sums the evidence of all tiles.
void sum_up(std::span<const int> tiles, std::span<const TileEvidence> evidence,
            const ChangeMap& marks, PixelDiff& pixels) {
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const TileEvidence& tile = evidence[i];
    const TileMarks& tile_marks = *marks.tile(tiles[i]);
    const std::int64_t changed = std::ranges::count(tile_marks, PixelMark::kChanged);
    pixels.differing += tile.differing;
    pixels.changed += changed;
    pixels.antialiased += std::ranges::count(tile_marks, PixelMark::kSmoothed);
    pixels.largest_colour_difference =
        std::max(pixels.largest_colour_difference, tile.largest_colour_difference);
    pixels.largest_mean_shift = std::max(pixels.largest_mean_shift, tile.flat_shift);
    if (tile.moved_share > 0.7 && changed > 0)
      pixels.largest_displacement_px =
          std::max(pixels.largest_displacement_px, tile.displacement_px());
    if (tile.least_structure < pixels.least_structure) {
      pixels.least_structure = tile.least_structure;
      pixels.least_structure_at = tile.least_structure_at;
    }
  }
  const double all = static_cast<double>(pixels.baseline.width) * pixels.baseline.height;
  pixels.changed_share = all > 0.0 ? static_cast<double>(pixels.changed) / all : 0.0;
}

/// The changed pixels of a group of tiles.
struct Cluster {
  std::int64_t pixels = 0;
  int left = INT_MAX, top = INT_MAX, right = 0, bottom = 0;

  PixelBox box() const { return {left, top, right - left, bottom - top}; }
};

Cluster cluster_of(const std::vector<int>& group, const ChangeMap& marks) {
  Cluster found;
  for (const int tile : group)
    for (int i = 0; i < kTile * kTile; ++i) {
      if ((*marks.tile(tile))[i] != PixelMark::kChanged) continue;
      const int x = tile % marks.across() * kTile + i % kTile;
      const int y = tile / marks.across() * kTile + i / kTile;
      found.left = std::min(found.left, x), found.right = std::max(found.right, x + 1);
      found.top = std::min(found.top, y), found.bottom = std::max(found.bottom, y + 1);
      ++found.pixels;
    }
  return found;
}

void find_clusters(std::span<const int> tiles, const ChangeMap& marks, PixelDiff& pixels) {
  std::vector<bool> is_changed(static_cast<std::size_t>(marks.across()) * marks.down(), false);
  for (const int tile : tiles)
    is_changed[tile] =
        std::ranges::find(*marks.tile(tile), PixelMark::kChanged) != marks.tile(tile)->end();
  for (const std::vector<int>& group : tile_groups(marks.across(), is_changed)) {
    ++pixels.clusters;
    const Cluster cluster = cluster_of(group, marks);
    if (cluster.pixels <= pixels.largest_cluster_pixels) continue;
    pixels.largest_cluster_pixels = cluster.pixels;
    pixels.largest_cluster = cluster.box();
  }
}

constexpr std::size_t kMostImageBytes = std::size_t{1} << 28;

/// A PNG file, or the reason why it cannot be read.
struct Side {
  PngFile png;
  std::string reason = {};
};

void read_side(std::string_view bytes, Side& side) {
  try {
    side.png = read_png(bytes);
  } catch (const InvalidInput& error) {
    side.reason = error.what();
  }
}

std::string renderer(const PngFile& png) {
  for (const char* key : {"mapproof:renderer", "Software"})
    if (const auto found = png.texts.find(key); found != png.texts.end())
      return printable(found->second, 200);
  return "";
}

/// The reason of one side or both.
std::string unreadable(const std::string& baseline, const std::string& current) {
  std::string reason;
  if (!baseline.empty()) reason = "the baseline: " + baseline;
  if (!current.empty()) (reason += reason.empty() ? "" : "; ") += "the current file: " + current;
  return reason;
}

ImageState state_of(const PixelDiff& pixels, const ImageOptions& options) {
  if (pixels.baseline != pixels.current) return ImageState::kDifferent;
  if (pixels.changed > 0 && pixels.changed_share > options.changed_share)
    return ImageState::kDifferent;
  return pixels.differing > 0 ? ImageState::kWithinTolerance : ImageState::kIdentical;
}

std::string words(const PixelDiff& found, bool finer_differs) {
  if (found.baseline != found.current)
    return fmt::format("{} x {} pixels became {} x {}", found.baseline.width, found.baseline.height,
                       found.current.width, found.current.height);
  if (found.changed > 0)
    return fmt::format("{} pixels changed ({:.3g} %), the largest cluster at {}, {}", found.changed,
                       100.0 * found.changed_share, found.largest_cluster.x,
                       found.largest_cluster.y);
  if (found.differing > 0)
    return fmt::format("{} pixels differ by no more than noise and anti-aliasing explain",
                       found.differing);
  if (finer_differs) return "the pixels differ only in alpha or below 8 bits";
  return "the pixels are equal";
}

/// The chunks of a PNG file without texts and other metadata.
std::vector<std::string_view> image_chunks(std::string_view bytes) {
  std::vector<std::string_view> chunks;
  for (const PngChunk& chunk : png_chunks(bytes))
    if (chunk.type == "IHDR" || chunk.type == "PLTE" || chunk.type == "tRNS" ||
        chunk.type == "IDAT")
      chunks.push_back(chunk.whole);
  return chunks;
}

/// Whether the pixels need no decoding, as both files have the same. If so, sets the result.
bool are_same_pngs(std::string_view before, std::string_view after, ImageDiff& diff) {
  if (!png_problem(before).empty() || !png_problem(after).empty() ||
      image_chunks(before) != image_chunks(after))
    return false;
  try {
    diff.baseline_renderer = renderer(read_png_remarks(before));
    diff.current_renderer = renderer(read_png_remarks(after));
  } catch (const InvalidInput&) {
    return false;
  }
  diff.state = ImageState::kIdentical;
  diff.reason = before == after ? "the files are equal" : "the pixels are equal, texts apart";
  return true;
}

/// Compares images of one size.
bool differ(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.pixels != b.pixels;
}

void compare_decoded(std::string_view before, std::string_view after, const ImageOptions& options,
                     Image* heat, ImageDiff& diff) {
  Side baseline, current;
  parallel_invoke([&] { read_side(before, baseline); }, [&] { read_side(after, current); });
  diff.baseline_renderer = renderer(baseline.png);
  diff.current_renderer = renderer(current.png);
  diff.reason = unreadable(baseline.reason, current.reason);
  if (!diff.reason.empty()) return;
  const bool hidden = !options.ignored.empty() && differ(baseline.png.image, current.png.image);
  const PixelComparison found =
      pixel_diff(baseline.png.image, std::move(current.png.image), options);
  diff.pixels = found.pixels;
  diff.state = state_of(found.pixels, options);
  const bool finer_differs = baseline.png.finer_digest != current.png.finer_digest;
  if (finer_differs && diff.state == ImageState::kIdentical)
    diff.state = ImageState::kWithinTolerance;
  diff.reason = words(found.pixels, finer_differs);
  if (hidden && found.pixels.differing == 0) {
    diff.state = std::max(diff.state, ImageState::kWithinTolerance);
    diff.reason = fmt::format("{} ignored, which differ", counted(found.pixels.ignored, "pixel"));
  }
  if (heat && found.pixels.baseline == found.pixels.current && found.pixels.differing > 0)
    *heat = heat_map(std::move(baseline.png.image), found.marks);
}

void compare_pngs(std::string_view before, std::string_view after, const ImageOptions& options,
                  Image* heat, ImageDiff& diff) {
  if (are_same_pngs(before, after, diff)) return;
  // A waiting thread takes no other pair meanwhile: it would hold the pixels of both.
  run_isolated([&] { compare_decoded(before, after, options, heat, diff); });
}

enum class ImageFormat { kPng, kSvg, kEmpty, kOther };

/// Whether the bytes begin as UTF-16 does, with its mark or with "<" in two bytes.
bool is_utf16(std::string_view bytes) {
  using namespace std::string_view_literals;
  return bytes.starts_with("\xFF\xFE"sv) || bytes.starts_with("\xFE\xFF"sv) ||
         bytes.starts_with("<\0"sv) || bytes.starts_with("\0<"sv);
}

/// The kind by the first bytes of the content, whatever the name of the file.
ImageFormat kind_of(std::string_view bytes) {
  if (bytes.empty()) return ImageFormat::kEmpty;
  if (bytes.starts_with("\x89PNG")) return ImageFormat::kPng;
  if (is_utf16(bytes)) return ImageFormat::kSvg;
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  return start != std::string_view::npos && bytes[start] == '<' ? ImageFormat::kSvg
                                                                : ImageFormat::kOther;
}

std::string kind_problem(ImageFormat kind) {
  if (kind == ImageFormat::kEmpty) return "is empty";
  return kind == ImageFormat::kOther ? "is neither PNG nor SVG" : "";
}

/// An SVG file, or the reason why it cannot be read.
struct SvgSide {
  SvgTree tree;
  std::string reason = {};
};

void read_side(std::string_view bytes, SvgSide& side) {
  try {
    side.tree = parse_svg(bytes);
  } catch (const InvalidInput& error) {
    side.reason = error.what();
  }
}

std::string words(const SvgDiff& found) {
  if (found.total == 0) return "the elements are equal";
  const std::int64_t changed = found.total - found.tolerated;
  if (changed == 0)
    return fmt::format("{} values differ within tolerance or are metadata", found.total);
  const SvgChange& first = found.changes.front();
  return fmt::format("{}, the first: {} {}", counted(changed, "change"), first.element, first.what);
}

void compare_svgs(std::string_view before, std::string_view after, const ImageOptions& options,
                  ImageDiff& diff) {
  SvgSide baseline, current;
  parallel_invoke([&] { read_side(before, baseline); }, [&] { read_side(after, current); });
  diff.baseline_renderer = printable(baseline.tree.generator, 200);
  diff.current_renderer = printable(current.tree.generator, 200);
  diff.reason = unreadable(baseline.reason, current.reason);
  if (!diff.reason.empty()) return;
  diff.svg = svg_diff(baseline.tree, current.tree,
                      {.distance_px = options.svg_distance, .colour = options.svg_colour});
  diff.state = diff.svg->total == 0                     ? ImageState::kIdentical
               : diff.svg->total == diff.svg->tolerated ? ImageState::kWithinTolerance
                                                        : ImageState::kDifferent;
  diff.reason = words(*diff.svg);
}

// The tolerances at which a judgement is made, from the defaults on.
constexpr std::array kNoiseSteps{
    ImageTolerances::kNoise, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0, 48.0, 64.0};
constexpr std::array kDisplacementSteps{ImageTolerances::kDisplacement_px,
                                        0.5,
                                        0.6,
                                        0.7,
                                        0.8,
                                        0.9,
                                        1.0,
                                        1.25,
                                        1.5,
                                        1.75,
                                        2.0,
                                        2.5,
                                        3.0,
                                        3.5,
                                        4.0};

/// The steps up to a value, the largest first; the first step if the value is below all.
std::vector<double> steps_up_to(double value, std::span<const double> steps) {
  std::vector<double> found;
  for (const double step : steps)
    if (step <= value) found.insert(found.begin(), step);
  if (found.empty()) found.push_back(steps.front());
  return found;
}

/// What the options allow of a tile and its judgement did not know.
struct TileTolerance {
  /// @param judged  The tolerances of the judgement: at least the options', if these are below the
  ///                defaults, else at most theirs.
  TileTolerance(const ImageOptions& options, const ImageOptions& judged,
                const TileEvidence& evidence)
      : noise(options.noise),
        is_flat_shift(evidence.flat_shift > 0.0),
        is_moved_too_far(options.displacement_px < judged.displacement_px &&
                         evidence.displacement_px() > options.displacement_px) {}

  double noise;
  bool is_flat_shift;
  bool is_moved_too_far;
};

void apply_tolerance(const Image& baseline, const Image& current, const PixelBox& tile,
                     const TileTolerance& allowed, TileMarks& marks) {
  for (int y = 0; y < tile.height; ++y)
    for (int x = 0; x < tile.width; ++x) {
      PixelMark& mark = marks[y * kTile + x];
      if (mark == PixelMark::kEqual) continue;
      const int difference = largest_difference(baseline.row(tile.y + y)[tile.x + x],
                                                current.row(tile.y + y)[tile.x + x]);
      if (mark == PixelMark::kChanged && !allowed.is_flat_shift && difference <= allowed.noise)
        mark = PixelMark::kNoise;
      else if ((mark == PixelMark::kNoise && difference > allowed.noise) ||
               (mark == PixelMark::kSmoothed && allowed.is_moved_too_far))
        mark = PixelMark::kChanged;
    }
}

/// Fills in the marks and the sums of two images of one size.
/// @param judged  The tolerances of the judgement; what else the options allow is applied to its
///                marks.
void judge_pixels(const Image& baseline, const Image& current, const ImageOptions& options,
                  const ImageOptions& judged, PixelComparison& diff) {
  diff.marks = ChangeMap(baseline.width, baseline.height);

  // First pass: which tiles differ, and whether there is noise everywhere.
  const std::vector<TileStyle> styles = styles_at(baseline, current, diff.marks, judged.noise);
  std::vector<int> tiles;
  Texture texture;
  double within_noise = 0.0;
  for (std::size_t i = 0; i < styles.size(); ++i) {
    if (styles[i].differs) tiles.push_back(static_cast<int>(i));
    within_noise += styles[i].within_noise;
    texture.tiles += styles[i].is_textured;
    if (!styles[i].has_contrast) continue;
    texture.bounds.add(static_cast<int>(i) % diff.marks.across(),
                       static_cast<int>(i) / diff.marks.across());
  }
  const double pixels = static_cast<double>(baseline.width) * baseline.height;
  const EvidenceBounds bounds{judged.noise, judged.mean_noise, judged.displacement_px,
                              within_noise > kNoisyShare * pixels};
  diff.marks.keep(tiles);

  // Second pass: the evidence of each differing tile, then the judgement of all together.
  std::vector<TileEvidence> evidence(tiles.size());
  parallel_for(tiles.size(), [&](std::size_t i) {
    const PixelBox tile = box_of(diff.marks, baseline, tiles[i]);
    evidence[i] = tile_evidence(baseline, current, tile, bounds, *diff.marks.tile(tiles[i]));
  });
  judge(tiles, evidence, texture, judged, diff.marks);
  if (options.noise != judged.noise || options.displacement_px != judged.displacement_px)
    parallel_for(tiles.size(), [&](std::size_t i) {
      apply_tolerance(baseline, current, box_of(diff.marks, baseline, tiles[i]),
                      {options, judged, evidence[i]}, *diff.marks.tile(tiles[i]));
    });
  mark_drawing_on_flat_ground(baseline, current, tiles, options, diff.marks);
  sum_up(tiles, evidence, diff.marks, diff.pixels);
  find_clusters(tiles, diff.marks, diff.pixels);
}

}  // namespace

PixelComparison pixel_diff(const Image& baseline, Image current, const ImageOptions& options) {
  if (const std::string problem = problem_of(options); !problem.empty())
    throw InvalidInput(problem);
  PixelComparison diff;
  diff.pixels.baseline = {baseline.width, baseline.height};
  diff.pixels.current = {current.width, current.height};
  if (diff.pixels.baseline != diff.pixels.current) return diff;
  diff.pixels.ignored = ignore(baseline, current, options.ignored);
  // The judgement weighs shares of what differs, which a larger tolerance changes in either
  // direction. The judgement that finds least at any tolerance up to the allowed one cannot find
  // more if more is allowed.
  std::optional<PixelComparison> least;
  for (const double noise : steps_up_to(options.noise, kNoiseSteps))
    for (const double displacement_px : steps_up_to(options.displacement_px, kDisplacementSteps)) {
      ImageOptions judged = options;
      judged.noise = noise, judged.displacement_px = displacement_px;
      PixelComparison found = diff;
      judge_pixels(baseline, current, options, judged, found);
      if (!least || found.pixels.changed < least->pixels.changed) least = std::move(found);
      if (least->pixels.changed == 0) return *std::move(least);
    }
  return *std::move(least);
}

ImageDiff image_diff(const std::filesystem::path& baseline, const std::filesystem::path& current,
                     const ImageOptions& options, Image* heat) {
  if (const std::string problem = problem_of(options); !problem.empty())
    throw InvalidInput(problem);
  const std::string before = read_input(baseline, kMostImageBytes);
  const std::string after = read_input(current, kMostImageBytes);
  ImageDiff diff;
  diff.baseline_bytes = before.size();
  diff.current_bytes = after.size();
  if (heat) *heat = {};
  const ImageFormat first = kind_of(before), second = kind_of(after);
  diff.reason = unreadable(kind_problem(first), kind_problem(second));
  if (!diff.reason.empty()) return diff;
  if (first != second) {
    diff.state = ImageState::kDifferent;
    diff.reason = "one file is a PNG, the other an SVG";
  } else if (first == ImageFormat::kPng) {
    compare_pngs(before, after, options, heat, diff);
  } else {
    compare_svgs(before, after, options, diff);
  }
  return diff;
}

Image heat_map(const std::filesystem::path& baseline, const std::filesystem::path& current,
               const ImageOptions& options) {
  Image heat;
  image_diff(baseline, current, options, &heat);
  return heat;
}

}  // namespace mapproof
