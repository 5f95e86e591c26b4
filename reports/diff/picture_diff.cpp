#include "reports/diff/picture_diff.hpp"

#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_invoke.h>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "render/image/png_check.hpp"
#include "render/image/png_read.hpp"
#include "reports/diff/image_diff.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 30;
constexpr std::string_view kPngStart = "\x89PNG\r\n\x1A\n";

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
  if (!baseline.empty()) reason = "the baseline " + baseline;
  if (!current.empty()) (reason += reason.empty() ? "" : "; ") += "the current file " + current;
  return reason;
}

PictureState state_of(const PixelDiff& pixels, const PictureOptions& options) {
  if (pixels.baseline != pixels.current) return PictureState::kDifferent;
  if (pixels.changed > 0 && pixels.changed_share >= options.changed_share)
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

void compare_pngs(const Side& baseline, const Side& current, const PictureOptions& options,
                  PictureDiff& diff) {
  diff.baseline_renderer = renderer(baseline.png);
  diff.current_renderer = renderer(current.png);
  diff.reason = unreadable(baseline.reason, current.reason);
  if (!diff.reason.empty()) return;
  diff.pixels = image_diff(baseline.png.image, current.png.image, options).pixels;
  diff.state = state_of(*diff.pixels, options);
  const bool finer_differs = baseline.png.finer_digest != current.png.finer_digest;
  if (finer_differs && diff.state == PictureState::kIdentical)
    diff.state = PictureState::kWithinTolerance;
  diff.reason = words(*diff.pixels, finer_differs);
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
  const auto within = [](double value, double least, double most) {
    return value >= least && value <= most;
  };
  for (const PixelBox& box : ignored)
    if (box.width < 1 || box.height < 1) return "ignored: a box needs a width and a height above 0";
  if (!within(noise, 0, 64)) return "noise: must be 0 to 64";
  if (!within(mean_noise, 0, 64)) return "mean_noise: must be 0 to 64";
  if (!within(displacement_px, 0, 4)) return "displacement_px: must be 0 to 4";
  if (!within(changed_share, 0, 1)) return "changed_share: must be 0 to 1";
  if (!(svg_distance >= 0) || !std::isfinite(svg_distance))
    return "svg_distance: must be finite and 0 or more";
  if (!within(svg_colour, 0, 255)) return "svg_colour: must be 0 to 255";
  return "";
}

PictureDiff picture_diff(const std::filesystem::path& baseline,
                         const std::filesystem::path& current, const PictureOptions& options) {
  if (const std::string problem = options.problem(); !problem.empty()) throw InvalidInput(problem);
  const std::string before = read_file(baseline, kMostBytes);
  const std::string after = read_file(current, kMostBytes);
  PictureDiff diff;
  diff.baseline_bytes = before.size();
  diff.current_bytes = after.size();
  Side first, second;
  tbb::parallel_invoke([&] { read_side(before, first); }, [&] { read_side(after, second); });
  compare_pngs(first, second, options, diff);
  return diff;
}

Image heat_map(const std::filesystem::path& baseline, const std::filesystem::path& current,
               const PictureOptions& options) {
  if (const std::string problem = options.problem(); !problem.empty()) throw InvalidInput(problem);
  const std::string before = read_file(baseline, kMostBytes);
  const std::string after = read_file(current, kMostBytes);
  Side first, second;
  tbb::parallel_invoke([&] { read_side(before, first); }, [&] { read_side(after, second); });
  if (!first.reason.empty() || !second.reason.empty()) return {};
  const ImageDiff found = image_diff(first.png.image, second.png.image, options);
  return found.pixels.baseline == found.pixels.current ? heat_map(first.png.image, found.marks)
                                                       : Image{};
}

}  // namespace mapproof
