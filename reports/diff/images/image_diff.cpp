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
#include "render/image/png_read.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/diff/images/flat_ground.hpp"
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
    return fmt::format("{} pixels changed ({:.3g} %), the largest cluster at {}, {}", found.changed,
                       100.0 * found.changed_share, found.largest_cluster.x,
                       found.largest_cluster.y);
  if (found.differing > 0)
    return fmt::format("{} pixels differ by no more than noise and anti-aliasing explain",
                       found.differing);
  if (finer_differs) return kFinerAlone;
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

/// The heat map of the part that both images have.
Image heat_of(const Image& baseline, const PixelComparison& found) {
  const PixelDiff& pixels = found.pixels;
  return heat_map(upper_left(baseline, {std::min(pixels.baseline.width, pixels.current.width),
                                        std::min(pixels.baseline.height, pixels.current.height)}),
                  found.marks);
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
  if (heat && found.pixels.differing > 0) *heat = heat_of(baseline.png.image, found);
}

/// The images of one side, or the reason why they cannot be read.
class DecodedSide {
 public:
  DecodedSide(std::string_view bytes, DecodedFormat format) {
    guarded([&] { reader_.emplace(bytes, format); });
  }

  /// Empty after the last, and if it cannot be read.
  std::optional<DecodedImage> next() {
    std::optional<DecodedImage> image;
    if (reader_) guarded([&] { image = reader_->next(); });
    return image;
  }

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
  PixelComparison found;
  Image baseline;  ///< Over that ground.
};

DecodedComparison compared_over(Image baseline, Image current, const ImageOptions& options) {
  PixelComparison found = pixel_diff(baseline, std::move(current), options);
  const ImageState state = state_of(found.pixels, options);
  return {state, std::move(found), std::move(baseline)};
}

/// What a viewer shows over black: an opaque image is the same there.
Image over_black(const DecodedImage& image) {
  return image.over_black ? *image.over_black : image.over_white;
}

DecodedComparison compared(DecodedImage baseline, DecodedImage current,
                           const ImageOptions& options) {
  std::optional<DecodedComparison> black;
  if (baseline.over_black || current.over_black)
    black = compared_over(over_black(baseline), over_black(current), options);
  DecodedComparison white =
      compared_over(std::move(baseline.over_white), std::move(current.over_white), options);
  return black && differs_more(black->state, black->found.pixels, white.state, white.found.pixels)
             ? *std::move(black)
             : std::move(white);
}

/// Compares files image by image, and keeps the result of the one that differs most.
class ImageComparer {
 public:
  ImageComparer(const ImageOptions& options, DecodedFormat format)
      : options_(options), noun_(format == DecodedFormat::kPdf ? "page" : "frame") {}

  void add(DecodedImage baseline, DecodedImage current) {
    ++count_;
    if (baseline.duration_ms != current.duration_ms && durations_.empty())
      durations_ = fmt::format("frame {} is shown for {} ms, and was for {} ms", count_,
                               current.duration_ms, baseline.duration_ms);
    DecodedComparison next = compared(std::move(baseline), std::move(current), options_);
    if (count_ == 1 ||
        differs_more(next.state, next.found.pixels, worst_.state, worst_.found.pixels)) {
      worst_ = std::move(next);
      worst_number_ = count_;
    }
  }

  /// @param more  Images that the baseline alone has, less those that the current alone has.
  void conclude(int more, Image* heat, ImageDiff& diff) {
    diff.pixels = worst_.found.pixels;
    diff.state = worst_.state;
    diff.reason = words(worst_.found.pixels, false);
    if (count_ > 1 && diff.state != ImageState::kIdentical)
      diff.reason = fmt::format("{} {} of {}: {}", noun_, worst_number_, count_, diff.reason);
    std::string others = durations_;
    if (more != 0)
      others = fmt::format("{} became {}", counted(count_ + std::max(more, 0), noun_),
                           counted(count_ + std::max(-more, 0), noun_));
    if (!others.empty()) {
      diff.reason = diff.state == ImageState::kIdentical ? others : others + "; " + diff.reason;
      diff.state = ImageState::kDifferent;
    }
    if (heat && worst_.found.pixels.differing > 0) *heat = heat_of(worst_.baseline, worst_.found);
  }

 private:
  const ImageOptions& options_;
  const char* noun_;
  int count_ = 0;
  DecodedComparison worst_;
  int worst_number_ = 0;
  std::string durations_;
};

/// The state, the reason and the pixels of a comparison by decoded images.
ImageDiff frame_diff(std::string_view before, std::string_view after, DecodedFormat format,
                     const ImageOptions& options, Image* heat) {
  DecodedSide baseline(before, format), current(after, format);
  ImageComparer comparer(options, format);
  int more = 0;
  while (true) {
    std::optional<DecodedImage> was = baseline.next(), is = current.next();
    if (!was && !is) break;
    if (was && is)
      comparer.add(*std::move(was), *std::move(is));
    else
      more += was ? 1 : -1;
  }
  ImageDiff diff;
  diff.reason = unreadable(baseline.reason(), current.reason());
  if (diff.reason.empty()) comparer.conclude(more, heat, diff);
  return diff;
}

/// Takes over what frame_diff() found.
void take(ImageDiff found, ImageDiff& diff) {
  diff.state = found.state;
  diff.reason = std::move(found.reason);
  diff.pixels = found.pixels;
}

/// What is seen over black only, where PNGs of equal pixels over white differ in transparency.
void compare_over_black(std::string_view before, std::string_view after,
                        const ImageOptions& options, Image* heat, ImageDiff& diff) {
  ImageDiff on_black = frame_diff(before, after, DecodedFormat::kPng, options, heat);
  if (on_black.state != ImageState::kDifferent) return;
  on_black.reason += ", seen over black";
  take(std::move(on_black), diff);
}

void compare_pngs(std::string_view before, std::string_view after, const ImageOptions& options,
                  Image* heat, ImageDiff& diff) {
  if (are_same_pngs(before, after, diff)) return;
  // A waiting thread takes no other pair meanwhile: it would hold the pixels of both.
  run_isolated([&] { compare_decoded(before, after, options, heat, diff); });
  if (diff.reason == kFinerAlone) compare_over_black(before, after, options, heat, diff);
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
                   Image* heat, ImageDiff& diff) {
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
                  Image* heat, ImageDiff& diff) {
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
  if (diff.state == ImageState::kDifferent && may_be_drawn_the_same(*diff.svg))
    compare_drawn(before, after, options, heat, diff);
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
  if (words(first, before) != words(second, after)) {
    diff.state = ImageState::kDifferent;
    diff.reason =
        fmt::format("the format changed: {} \u2192 {}", words(first, before), words(second, after));
  } else if (first == ImageFormat::kDecoded) {
    if (before == after)
      set_equal(diff);
    else
      take(frame_diff(before, after, *decoded_format(before), options, heat), diff);
  } else if (first == ImageFormat::kPng) {
    compare_pngs(before, after, options, heat, diff);
  } else {
    compare_svgs(before, after, options, heat, diff);
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
