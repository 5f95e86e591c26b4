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
#include "render/decode/image_reader.hpp"
#include "render/image/png_check.hpp"
#include "render/image/png_chunks.hpp"
#include "render/image/png_colour.hpp"
#include "render/image/png_read.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/diff/images/flat_ground.hpp"
#include "reports/diff/images/pixel_diff.hpp"
#include "reports/diff/images/pixel_judgement.hpp"
#include "reports/diff/images/tile_evidence.hpp"
#include "reports/diff/svg/svg_parser.hpp"

namespace mapproof {

namespace {

constexpr std::size_t kMostImageBytes = std::size_t{1} << 28;

/// A PNG file, or the reason why it cannot be read.
struct Side {
  PngFile png;
  std::string reason = {};
};

/// One that is not held whole comes here only beside one that cannot be read: its pixels are not
/// needed.
void read_side(std::string_view bytes, Side& side) {
  try {
    side.png = read_png_remarks(bytes);
    if (is_held_whole(side.png.header)) side.png = read_png(bytes);
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

/// Whether the first result differs more than the second.
bool differs_more(ImageState state, const PixelDiff& pixels, ImageState than,
                  const PixelDiff& than_pixels) {
  if (state != than) return state > than;
  return std::pair(pixels.changed, pixels.differing) >
         std::pair(than_pixels.changed, than_pixels.differing);
}

constexpr const char* kFinerAlone = "the pixels differ only in alpha or below 8 bits";

std::string words(const PixelDiff& found, bool finer_differs) {
  if (found.baseline != found.current) {
    std::string sizes =
        fmt::format("{} x {} pixels became {} x {}", found.baseline.width, found.baseline.height,
                    found.current.width, found.current.height);
    if (!have_common_part(found.baseline, found.current)) return sizes;
    PixelDiff common = found;
    common.current = common.baseline;
    return sizes + "; in the part that both have " + words(common, false);
  }
  if (found.changed > 0)
    return fmt::format("{} changed ({:.3g} %), the largest cluster at {}, {}",
                       counted(found.changed, "pixel"), 100.0 * found.changed_share,
                       found.largest_cluster.x, found.largest_cluster.y);
  if (found.differing > 0)
    return fmt::format("{} differ{} by no more than noise and anti-aliasing explain",
                       counted(found.differing, "pixel"), found.differing == 1 ? "s" : "");
  if (finer_differs) return kFinerAlone;
  return "the pixels are equal";
}

std::string words_of_ignored(const PixelDiff& found) {
  return fmt::format("{} ignored, which differ", counted(found.ignored, "pixel"));
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

/// The heat map of the part that both images have.
HeatMap heat_of(const Image& baseline, const PixelComparison& found) {
  const PixelDiff& pixels = found.pixels;
  return heat_map(baseline,
                  {std::min(pixels.baseline.width, pixels.current.width),
                   std::min(pixels.baseline.height, pixels.current.height)},
                  found.marks);
}

void compare_decoded(std::string_view before, std::string_view after, const ImageOptions& options,
                     HeatMap* heat, ImageDiff& diff) {
  Side baseline, current;
  parallel_invoke([&] { read_side(before, baseline); }, [&] { read_side(after, current); });
  diff.baseline_renderer = renderer(baseline.png);
  diff.current_renderer = renderer(current.png);
  diff.reason = unreadable(baseline.reason, current.reason);
  if (!diff.reason.empty()) return;
  diff.is_decoded = true;
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
    diff.reason = words_of_ignored(found.pixels);
  }
  if (heat && found.pixels.differing > 0) *heat = heat_of(baseline.png.image, found);
}

/// The images of one side, or the reason why they cannot be read.
class DecodedSide {
 public:
  DecodedSide(std::string_view bytes, DecodedFormat format) {
    guarded([&] { reader_.emplace(bytes, format); });
  }

  /// Empty after the last, and if it cannot be read.
  std::optional<ImageHead> next() {
    std::optional<ImageHead> head;
    if (reader_) guarded([&] { head = reader_->next(); });
    return head;
  }
  /// Empty if they cannot be read.
  std::optional<ImageStrip> rows(int count) {
    std::optional<ImageStrip> strip;
    if (reader_) guarded([&] { strip = reader_->rows(count); });
    return strip;
  }

  std::uint64_t finer_digest() const { return reader_ ? reader_->finer_digest() : 0; }
  const std::string& reason() const { return reason_; }

 private:
  template <typename Work>
  void guarded(const Work& work) {
    try {
      work();
    } catch (const InvalidInput& error) {
      reason_ = error.what();
      reader_.reset();
    }
  }

  std::optional<ImageReader> reader_;
  std::string reason_;
};

/// What two images show, over white or over black, whichever differs more.
struct DecodedComparison {
  ImageState state = ImageState::kIdentical;
  PixelDiff pixels;
  std::string reason;
  HeatMap heat;
};

DecodedComparison comparison_of(StripDiff strips, const ImageOptions& options) {
  DecodedComparison found{.pixels = strips.pixels(), .reason = {}, .heat = {}};
  found.state = state_of(found.pixels, options);
  found.reason = words(found.pixels, false);
  if (strips.differs_where_ignored()) {
    found.state = std::max(found.state, ImageState::kWithinTolerance);
    found.reason = words_of_ignored(found.pixels);
  }
  found.heat = std::move(strips).heat();
  return found;
}

/// What a viewer shows over black: an opaque image is the same there.
Image over_black(const ImageStrip& strip) {
  return strip.over_black ? *strip.over_black : strip.over_white;
}

/// Compares the next image of both sides. @return What was read, if a side cannot be read.
DecodedComparison compared(const ImageHead& was, const ImageHead& is, DecodedSide& baseline,
                           DecodedSide& current, const ImageOptions& options, bool with_heat) {
  StripDiff white({was.width, was.height}, {is.width, is.height}, options, with_heat);
  std::optional<StripDiff> black;
  while (const int count = white.next_rows()) {
    std::optional<ImageStrip> before, after;
    parallel_invoke([&] { before = baseline.rows(count); }, [&] { after = current.rows(count); });
    if (!before || !after) break;
    // Rows above are opaque: over black they are what they are over white.
    if (!black && (before->over_black || after->over_black)) black = white;
    if (black) black->add(over_black(*before), over_black(*after));
    white.add(std::move(before->over_white), std::move(after->over_white));
  }
  DecodedComparison on_white = comparison_of(std::move(white), options);
  if (!black) return on_white;
  DecodedComparison on_black = comparison_of(*std::move(black), options);
  if (!differs_more(on_black.state, on_black.pixels, on_white.state, on_white.pixels))
    return on_white;
  on_black.reason += ", seen over black";
  return on_black;
}

/// Compares files image by image, and keeps the result of the one that differs most.
class ImageComparer {
 public:
  ImageComparer(DecodedSide& baseline, DecodedSide& current, const ImageOptions& options,
                bool with_heat)
      : baseline_(baseline), current_(current), options_(options), with_heat_(with_heat) {}

  void add(const ImageHead& was, const ImageHead& is) {
    ++count_;
    if (was.duration_ms != is.duration_ms && other_.empty())
      other_ = fmt::format("frame {} is shown for {} ms, and was for {} ms", count_, is.duration_ms,
                           was.duration_ms);
    if (was.profile != is.profile && other_.empty()) other_ = "its colour profile changed";
    DecodedComparison next = compared(was, is, baseline_, current_, options_, with_heat_);
    if (count_ == 1 || differs_more(next.state, next.pixels, worst_.state, worst_.pixels)) {
      worst_ = std::move(next);
      worst_number_ = count_;
    }
  }

  /// @param noun  Of an image: "frame".
  /// @param more  Images that the baseline alone has, less those that the current alone has.
  void conclude(const char* noun, int more, HeatMap* heat, ImageDiff& diff) {
    diff.pixels = worst_.pixels;
    diff.state = worst_.state;
    diff.reason = std::move(worst_.reason);
    if (baseline_.finer_digest() != current_.finer_digest() &&
        diff.state == ImageState::kIdentical) {
      diff.state = ImageState::kWithinTolerance;
      diff.reason = kFinerAlone;
    }
    if (count_ > 1 && diff.state != ImageState::kIdentical)
      diff.reason = fmt::format("{} {} of {}: {}", noun, worst_number_, count_, diff.reason);
    if (more != 0)
      other_ = fmt::format("{} became {}", counted(count_ + std::max(more, 0), noun),
                           counted(count_ + std::max(-more, 0), noun));
    if (!other_.empty()) {
      diff.reason = diff.state == ImageState::kIdentical ? other_ : other_ + "; " + diff.reason;
      diff.state = ImageState::kDifferent;
    }
    if (heat) *heat = std::move(worst_.heat);
  }

 private:
  DecodedSide &baseline_, &current_;
  const ImageOptions& options_;
  bool with_heat_;
  int count_ = 0;
  DecodedComparison worst_;
  int worst_number_ = 0;
  std::string other_;  ///< What else changed.
};

bool has_pages(DecodedFormat format) {
  return format == DecodedFormat::kPdf || format == DecodedFormat::kTiff;
}

/// The state, the reason and the pixels of a comparison by decoded images.
ImageDiff frame_diff(std::string_view before, std::string_view after, DecodedFormat format,
                     const ImageOptions& options, HeatMap* heat) {
  ImageDiff diff;
  // A waiting thread takes no other pair meanwhile: it would hold the pixels of both.
  run_isolated([&] {
    DecodedSide baseline(before, format), current(after, format);
    ImageComparer comparer(baseline, current, options, heat != nullptr);
    int more = 0;
    while (true) {
      const std::optional<ImageHead> was = baseline.next(), is = current.next();
      if (!was && !is) break;
      if (was && is)
        comparer.add(*was, *is);
      else
        more += was ? 1 : -1;
    }
    diff.reason = unreadable(baseline.reason(), current.reason());
    diff.is_decoded = diff.reason.empty();
    if (diff.is_decoded)
      comparer.conclude(has_pages(format) ? "page" : "frame", more, heat, diff);
  });
  return diff;
}

/// Takes over what frame_diff() found.
void take(ImageDiff found, ImageDiff& diff) {
  diff.state = found.state;
  diff.reason = std::move(found.reason);
  diff.pixels = found.pixels;
  diff.is_decoded = found.is_decoded;
}

/// What is seen over black only, where PNGs of equal pixels over white differ in transparency.
void compare_over_black(std::string_view before, std::string_view after,
                        const ImageOptions& options, HeatMap* heat, ImageDiff& diff) {
  ImageDiff on_black = frame_diff(before, after, DecodedFormat::kPng, options, heat);
  if (on_black.state == ImageState::kDifferent) take(std::move(on_black), diff);
}

/// Whether the pixels of both are held whole; sets the renderers.
/// @throws InvalidInput if a file cannot be read.
bool are_held_whole(std::string_view before, std::string_view after, ImageDiff& diff) {
  const PngFile baseline = read_png_remarks(before), current = read_png_remarks(after);
  diff.baseline_renderer = renderer(baseline);
  diff.current_renderer = renderer(current);
  return is_held_whole(baseline.header) && is_held_whole(current.header);
}

bool may_be_held_whole(std::string_view before, std::string_view after, ImageDiff& diff) {
  try {
    return are_held_whole(before, after, diff);
  } catch (const InvalidInput&) {
    return true;  // Its side gets the reason.
  }
}

/// Files in other colour spaces are different: what their values show is.
void compare_colours(std::string_view before, std::string_view after, ImageDiff& diff) {
  if (diff.state == ImageState::kUnreadable) return;
  const PngColour was = read_png_remarks(before).colour, is = read_png_remarks(after).colour;
  if (was.content == is.content) return;
  std::string other = fmt::format("the colour space changed: {} \u2192 {}", was.label,
                                  was.label == is.label ? "another of this name" : is.label);
  diff.reason = diff.state == ImageState::kIdentical ? other : other + "; " + diff.reason;
  diff.state = ImageState::kDifferent;
}

void compare_pngs(std::string_view before, std::string_view after, const ImageOptions& options,
                  HeatMap* heat, ImageDiff& diff) {
  if (!are_same_pngs(before, after, diff)) {
    if (may_be_held_whole(before, after, diff)) {
      run_isolated([&] { compare_decoded(before, after, options, heat, diff); });
      if (diff.reason == kFinerAlone) compare_over_black(before, after, options, heat, diff);
    } else {
      take(frame_diff(before, after, DecodedFormat::kPng, options, heat), diff);
    }
  }
  compare_colours(before, after, diff);
}

enum class ImageFormat { kPng, kSvg, kDecoded, kEmpty, kPointer, kOther };

/// Whether the bytes begin as UTF-16 does, with its mark or with "<" in two bytes.
bool is_utf16(std::string_view bytes) {
  using namespace std::string_view_literals;
  return bytes.starts_with("\xFF\xFE"sv) || bytes.starts_with("\xFE\xFF"sv) ||
         bytes.starts_with("<\0"sv) || bytes.starts_with("\0<"sv);
}

/// The kind by the first bytes of the content, whatever the name of the file.
ImageFormat kind_of(std::string_view bytes) {
  if (bytes.empty()) return ImageFormat::kEmpty;
  if (decoded_format(bytes)) return ImageFormat::kDecoded;
  if (bytes.starts_with("\x89PNG")) return ImageFormat::kPng;
  if (bytes.starts_with("version https://git-lfs")) return ImageFormat::kPointer;
  if (is_utf16(bytes)) return ImageFormat::kSvg;
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  return start != std::string_view::npos && bytes[start] == '<' ? ImageFormat::kSvg
                                                                : ImageFormat::kOther;
}

std::string kind_problem(ImageFormat kind) {
  if (kind == ImageFormat::kEmpty) return "is empty";
  if (kind == ImageFormat::kPointer)
    return "is a pointer of Git LFS, not the image: run git lfs pull";
  return kind == ImageFormat::kOther ? "is not an image of a format that is compared" : "";
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

/// Whether only the structure of an SVG differs, or what no viewer draws by itself: definitions and
/// clip paths. Another structure may look the same.
bool may_be_drawn_the_same(const SvgDiff& svg) {
  if (svg.structure > 0) return true;
  return std::ranges::all_of(svg.changes, [](const SvgChange& change) {
    return change.tolerated || change.element.find("/defs") != std::string::npos ||
           change.element.find("clipPath") != std::string::npos;
  });
}

/// Draws both SVGs, and takes equal images for equal.
void compare_drawn(std::string_view before, std::string_view after, ImageOptions options,
                   HeatMap* heat, ImageDiff& diff) {
  // Rounded outlines of letters, as svgo writes them, differ by up to 17 of 255 in some pixels. A
  // mark on flat ground is found from 12 on, whatever the noise.
  options.noise = std::max(options.noise, 12.0);
  ImageDiff drawn;
  try {
    std::string baseline, current;
    run_isolated([&] { baseline = drawn_svg(before), current = drawn_svg(after); });
    compare_pngs(baseline, current, options, heat, drawn);
  } catch (const InvalidInput& error) {
    diff.reason += fmt::format("; not drawn: {}", error.what());
    return;
  }
  diff.pixels = drawn.pixels;
  diff.reason += "; drawn by librsvg, " + drawn.reason;
  if (drawn.state <= ImageState::kWithinTolerance) diff.state = ImageState::kWithinTolerance;
}

void compare_svgs(std::string_view before, std::string_view after, const ImageOptions& options,
                  HeatMap* heat, ImageDiff& diff) {
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
  if (diff.state == ImageState::kDifferent && may_be_drawn_the_same(*diff.svg)) {
    compare_drawn(before, after, options, heat, diff);
  } else if (heat && diff.state != ImageState::kIdentical) {
    ImageDiff drawn;  // The elements decide.
    compare_drawn(before, after, options, heat, drawn);
  }
}

void set_equal(ImageDiff& diff) {
  diff.state = ImageState::kIdentical;
  diff.reason = "the files are equal";
}

/// "animated PNG", "JPEG".
std::string_view words(ImageFormat kind, std::string_view bytes) {
  if (kind == ImageFormat::kDecoded) return label(*decoded_format(bytes));
  return kind == ImageFormat::kPng ? "PNG" : "SVG";
}

}  // namespace

ImageDiff image_diff(const std::filesystem::path& baseline, const std::filesystem::path& current,
                     const ImageOptions& options, HeatMap* heat) {
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
  if (words(first, before) != words(second, after)) {
    diff.state = ImageState::kDifferent;
    diff.reason =
        fmt::format("the format changed: {} \u2192 {}", words(first, before), words(second, after));
  } else if (first == ImageFormat::kDecoded) {
    if (before == after)
      set_equal(diff);
    else
      take(frame_diff(before, after, *decoded_format(before), options, heat), diff);
    if (*decoded_format(before) == DecodedFormat::kApng) compare_colours(before, after, diff);
  } else if (first == ImageFormat::kPng) {
    compare_pngs(before, after, options, heat, diff);
  } else {
    compare_svgs(before, after, options, heat, diff);
  }
  return diff;
}

HeatMap heat_map(const std::filesystem::path& baseline, const std::filesystem::path& current,
                 const ImageOptions& options) {
  HeatMap heat;
  image_diff(baseline, current, options, &heat);
  return heat;
}

}  // namespace mapproof
