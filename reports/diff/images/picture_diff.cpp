#include "reports/diff/images/picture_diff.hpp"

#include <utility>

#include <fmt/format.h>

#include "core/base/byte_source.hpp"
#include "core/base/errors.hpp"
#include "core/base/parallel.hpp"
#include "core/base/words.hpp"
#include "render/image/png_check.hpp"
#include "render/image/png_chunks.hpp"
#include "render/image/png_read.hpp"
#include "reports/diff/images/image_diff.hpp"
#include "reports/diff/settings_fields.hpp"
#include "reports/diff/svg/svg_parser.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostPictureBytes = std::size_t{1} << 28;

/// A PNG file, or why there is none.
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

/// "baseline truncated", for one side or both.
std::string unreadable(const std::string& baseline, const std::string& current) {
  std::string reason;
  if (!baseline.empty()) reason = "the baseline: " + baseline;
  if (!current.empty()) (reason += reason.empty() ? "" : "; ") += "the current file: " + current;
  return reason;
}

PictureState state_of(const PixelDiff& pixels, const PictureOptions& options) {
  if (pixels.baseline != pixels.current) return PictureState::kDifferent;
  if (pixels.changed > 0 && pixels.changed_share > options.changed_share)
    return PictureState::kDifferent;
  return pixels.differing > 0 ? PictureState::kWithinTolerance : PictureState::kIdentical;
}

std::string words(const PixelDiff& found, bool finer_differs) {
  if (found.baseline != found.current)
    return fmt::format("{} x {} pixels became {} x {}", found.baseline.width, found.baseline.height,
                       found.current.width, found.current.height);
  if (found.changed > 0)
    return fmt::format("{} pixels changed ({:.3g} %), the most together at {}, {}", found.changed,
                       100.0 * found.changed_share, found.largest_cluster.x,
                       found.largest_cluster.y);
  if (found.differing > 0)
    return fmt::format("{} pixels differ by no more than noise and smoothing do", found.differing);
  if (finer_differs) return "the pixels differ only in alpha or below 8 bits";
  return "the pixels are equal";
}

/// What a PNG file is made of, texts and other remarks apart.
std::vector<std::string_view> picture_chunks(std::string_view bytes) {
  std::vector<std::string_view> chunks;
  for (const PngChunk& chunk : png_chunks(bytes))
    if (chunk.type == "IHDR" || chunk.type == "PLTE" || chunk.type == "tRNS" ||
        chunk.type == "IDAT")
      chunks.push_back(chunk.whole);
  return chunks;
}

/// Whether pixels need not be decoded, as both files have the same. Sets what else is to be told.
bool are_same_pngs(std::string_view before, std::string_view after, PictureDiff& diff) {
  if (!png_problem(before).empty() || !png_problem(after).empty() ||
      picture_chunks(before) != picture_chunks(after))
    return false;
  try {
    diff.baseline_renderer = renderer(read_png_remarks(before));
    diff.current_renderer = renderer(read_png_remarks(after));
  } catch (const InvalidInput&) {
    return false;
  }
  diff.state = PictureState::kIdentical;
  diff.reason = before == after ? "the files are equal" : "the pixels are equal, texts apart";
  return true;
}

/// Of pictures of one size.
bool differ(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.pixels != b.pixels;
}

void compare_decoded(std::string_view before, std::string_view after, const PictureOptions& options,
                     Image* heat, PictureDiff& diff) {
  Side baseline, current;
  parallel_invoke([&] { read_side(before, baseline); }, [&] { read_side(after, current); });
  diff.baseline_renderer = renderer(baseline.png);
  diff.current_renderer = renderer(current.png);
  diff.reason = unreadable(baseline.reason, current.reason);
  if (!diff.reason.empty()) return;
  const bool hidden = !options.ignored.empty() && differ(baseline.png.image, current.png.image);
  const ImageDiff found = image_diff(baseline.png.image, std::move(current.png.image), options);
  diff.pixels = found.pixels;
  diff.state = state_of(found.pixels, options);
  const bool finer_differs = baseline.png.finer_digest != current.png.finer_digest;
  if (finer_differs && diff.state == PictureState::kIdentical)
    diff.state = PictureState::kWithinTolerance;
  diff.reason = words(found.pixels, finer_differs);
  if (hidden && found.pixels.differing == 0) {
    diff.state = std::max(diff.state, PictureState::kWithinTolerance);
    diff.reason = fmt::format("{} ignored, which differ", counted(found.pixels.ignored, "pixel"));
  }
  if (heat && found.pixels.baseline == found.pixels.current && found.pixels.differing > 0)
    *heat = heat_map(std::move(baseline.png.image), found.marks);
}

void compare_pngs(std::string_view before, std::string_view after, const PictureOptions& options,
                  Image* heat, PictureDiff& diff) {
  if (are_same_pngs(before, after, diff)) return;
  // A thread that waits takes no other pair meanwhile: it would hold the pixels of both.
  run_isolated([&] { compare_decoded(before, after, options, heat, diff); });
}

enum class PictureKind { kPng, kSvg, kEmpty, kOther };

/// Whether the bytes begin as UTF-16 does, with its mark or with "<" in two bytes.
bool is_utf16(std::string_view bytes) {
  using namespace std::string_view_literals;
  return bytes.starts_with("\xFF\xFE"sv) || bytes.starts_with("\xFE\xFF"sv) ||
         bytes.starts_with("<\0"sv) || bytes.starts_with("\0<"sv);
}

/// By how the content begins; names of files are not asked.
PictureKind kind_of(std::string_view bytes) {
  if (bytes.empty()) return PictureKind::kEmpty;
  if (bytes.starts_with("\x89PNG")) return PictureKind::kPng;
  if (is_utf16(bytes)) return PictureKind::kSvg;
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  return start != std::string_view::npos && bytes[start] == '<' ? PictureKind::kSvg
                                                                : PictureKind::kOther;
}

std::string kind_problem(PictureKind kind) {
  if (kind == PictureKind::kEmpty) return "is empty";
  return kind == PictureKind::kOther ? "is neither PNG nor SVG" : "";
}

/// An SVG file, or why there is none.
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
    return fmt::format("{} values differ within tolerance or are remarks", found.total);
  const SvgChange& first = found.changes.front();
  return fmt::format("{}, the first: {} {}", counted(changed, "change"), first.element, first.what);
}

void compare_svgs(std::string_view before, std::string_view after, const PictureOptions& options,
                  PictureDiff& diff) {
  SvgSide baseline, current;
  parallel_invoke([&] { read_side(before, baseline); }, [&] { read_side(after, current); });
  diff.baseline_renderer = printable(baseline.tree.generator, 200);
  diff.current_renderer = printable(current.tree.generator, 200);
  diff.reason = unreadable(baseline.reason, current.reason);
  if (!diff.reason.empty()) return;
  diff.svg = svg_diff(baseline.tree, current.tree,
                      {.distance_px = options.svg_distance, .colour = options.svg_colour});
  diff.state = diff.svg->total == 0                     ? PictureState::kIdentical
               : diff.svg->total == diff.svg->tolerated ? PictureState::kWithinTolerance
                                                        : PictureState::kDifferent;
  diff.reason = words(*diff.svg);
}

}  // namespace

std::string_view name(PictureState state) {
  switch (state) {
    case PictureState::kIdentical:
      return "identical";
    case PictureState::kWithinTolerance:
      return "within tolerance";
    case PictureState::kDifferent:
      return "different";
    case PictureState::kUnreadable:
      break;
  }
  return "unreadable";
}

std::string PictureOptions::problem() const {
  for (const PixelBox& box : ignored)
    if (box.width < 1 || box.height < 1) return "ignored: a box needs a width and a height above 0";
  BoundsVisitor bounds;
  PictureOptions options = *this;
  picture_option_fields(bounds, options);
  return bounds.problem;
}

PictureDiff picture_diff(const std::filesystem::path& baseline,
                         const std::filesystem::path& current, const PictureOptions& options,
                         Image* heat) {
  if (const std::string problem = options.problem(); !problem.empty()) throw InvalidInput(problem);
  const std::string before = read_input(baseline, kMostPictureBytes);
  const std::string after = read_input(current, kMostPictureBytes);
  PictureDiff diff;
  diff.baseline_bytes = before.size();
  diff.current_bytes = after.size();
  if (heat) *heat = {};
  const PictureKind first = kind_of(before), second = kind_of(after);
  diff.reason = unreadable(kind_problem(first), kind_problem(second));
  if (!diff.reason.empty()) return diff;
  if (first != second) {
    diff.state = PictureState::kDifferent;
    diff.reason = "one file is a PNG, the other an SVG";
  } else if (first == PictureKind::kPng) {
    compare_pngs(before, after, options, heat, diff);
  } else {
    compare_svgs(before, after, options, diff);
  }
  return diff;
}

Image heat_map(const std::filesystem::path& baseline, const std::filesystem::path& current,
               const PictureOptions& options) {
  Image heat;
  picture_diff(baseline, current, options, &heat);
  return heat;
}

}  // namespace mapproof
