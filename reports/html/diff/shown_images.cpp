#include "reports/html/diff/shown_images.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/parallel.hpp"
#include "core/base/text/base64.hpp"
#include "render/image/png_read.hpp"
#include "render/output/write_figure.hpp"
#include "render/plot/layout.hpp"
#include "render/svg/svg.hpp"
#include "render/theme/theme.hpp"
#include "reports/diff/figures/change_figure.hpp"
#include "reports/diff/images/pixel_diff.hpp"
#include "reports/diff/items.hpp"
#include "reports/diff/kept_heat_maps.hpp"
#include "reports/diff/shared_causes.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMostPixels = std::int64_t{1} << 28;

bool has_both(const ImageFile& file) { return !file.baseline.empty() && !file.current.empty(); }

/// The priority of an image on the page; 0: nothing to show.
int interest(const ImageFile& file) {
  const int of_format = file.format == "png" ? 1 : 0;
  if (media_type(file.format).empty()) return 0;
  if (!has_both(file)) return 2 + of_format;
  switch (file.diff.state) {
    case ImageState::kDifferent:
      return 6 + of_format;
    case ImageState::kWithinTolerance:
      return 4 + of_format;
    default:
      return 0;
  }
}

const ImageFile* most_telling(const DiffItem& item) {
  const ImageFile* best = nullptr;
  for (const ImageFile& file : item.images)
    if (interest(file) > (best == nullptr ? 0 : interest(*best))) best = &file;
  return best;
}

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i)
    number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

/// Reads the size from the header; a browser reads the rest.
ImageSize png_size(const std::string& bytes, const fs::path& path) {
  constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
  if (bytes.size() < 24 || !bytes.starts_with(kSignature))
    throw IoError(path.string(), "is not a PNG");
  const std::int64_t width = number_at(bytes, 16), height = number_at(bytes, 20);
  if (width < 1 || height < 1 || width > kMostPixels || height > kMostPixels / width)
    throw IoError(path.string(), fmt::format("{} x {} pixels are not shown", width, height));
  return {static_cast<int>(width), static_cast<int>(height)};
}

ShownImage read_image(const fs::path& path, const std::string& format, const std::string& note,
                      std::size_t limit) {
  const std::string bytes = read_input(path, limit);
  ShownImage image;
  image.note = note;
  if (format == "png") image.size = png_size(bytes, path);
  image.uri = fmt::format("data:{};base64,{}", media_type(format), base64(bytes));
  return image;
}

/// What is made for one item.
struct Plan {
  const ImageFile* file = nullptr;
  bool heat = false;
  bool change = false;
  std::string absent;
};

std::string unreadable_reason(const DiffItem& item) {
  for (const ImageFile& file : item.images)
    if (has_both(file) && file.diff.state == ImageState::kUnreadable)
      return "Not shown: " + file.format + " cannot be read.";
  for (const ImageFile& file : item.images)
    if (media_type(file.format).empty())
      return "Not shown: browsers show no " + file.format + " in a page.";
  return "";
}

std::uintmax_t bytes_of(const ImageFile& file) {
  std::uintmax_t bytes = 0;
  for (const fs::path& path : {file.baseline, file.current}) {
    std::error_code error;
    const std::uintmax_t size = path.empty() ? 0 : fs::file_size(path, error);
    if (!error) bytes += size;
  }
  return bytes;
}

std::string full_text(const ImageBudget& budget) {
  return fmt::format("Not shown: this page already has its {:.3g} MB (--page-size).",
                     static_cast<double>(budget.page_bytes) / 1e6);
}

std::vector<Plan> plans(const DiffResult& result, const ImageBudget& budget) {
  constexpr double kBase64 = 4.0 / 3.0;
  const double most = kImageShare * static_cast<double>(budget.page_bytes) / kBase64;
  std::vector<Plan> all;
  double used = 0.0;
  std::size_t heat_maps = 0, changes = 0;
  for (const DiffItem& item : result.items) {
    Plan plan;
    if (item.judgement.verdict != Verdict::kIdentical) {
      plan.file = most_telling(item);
      if (plan.file == nullptr) plan.absent = unreadable_reason(item);
    }
    if (plan.file != nullptr && is_repeated(result, item)) {
      plan.absent = "Not shown: others above have the same cause.";
      plan.file = nullptr;
    }
    if (plan.file != nullptr && used + static_cast<double>(bytes_of(*plan.file)) > most) {
      plan.absent = full_text(budget);
      plan.file = nullptr;
    }
    if (plan.file != nullptr) {
      used += static_cast<double>(bytes_of(*plan.file));
      plan.heat = has_both(*plan.file) && heat_maps < budget.heat_maps;
      heat_maps += plan.heat ? 1 : 0;
    }
    plan.change = item.judgement.verdict > Verdict::kRenderer && changes < budget.heat_maps &&
                  !is_repeated(result, item);
    changes += plan.change ? 1 : 0;
    all.push_back(std::move(plan));
  }
  return all;
}

/// Why two images are shown without a heat map.
std::string no_heat_reason(const Plan& plan) {
  if (!plan.heat) return "No heat map: the page already holds its maximum number of heat maps.";
  const auto& pixels = plan.file->diff.pixels;
  if (pixels && pixels->baseline != pixels->current) return "No heat map: the sizes differ.";
  if (plan.file->format == "svg")
    return "No heat map: drawn, both look the same, or rsvg-convert is not installed.";
  return "No heat map: no pixel differs.";
}

Image drawn(const Figure& figure) { return read_png(figure_png(figure, report_theme())).image; }

/// A heat map, and the share of its pixels that changed.
struct Heat {
  ShownImage image;
  double changed_share = 0.0;
};

Heat shown_heat(const HeatMapFile& file, const std::string& note) {
  return {{"data:image/png;base64," + base64(file.png), std::nullopt, note}, file.changed_share};
}

/// Of values whose limits differ: drawn again on common axes, as a shifted limit moves everything.
std::optional<Heat> heat_on_common_axes(const FigureValues& values, const ImageOptions& options) {
  const auto both = on_common_axes(values);
  if (!both) return std::nullopt;
  const Image baseline = drawn(both->first);
  ImageOptions whole = options;
  whole.ignored.clear();  // Boxes are of the files' pixels.
  const PixelComparison found = pixel_diff(baseline, drawn(both->second), whole);
  if (found.pixels.baseline != found.pixels.current || found.pixels.differing == 0)
    return std::nullopt;
  return shown_heat(*heat_map_file(heat_map(baseline, found.pixels.baseline, found.marks)),
                    "values drawn on common axes");
}

std::optional<Heat> heat_image(const ImageFile& file, const ImageOptions& options) {
  const std::optional<HeatMapFile> map = heat_map_file(file, options);
  if (!map) return std::nullopt;
  const auto& pixels = file.diff.pixels;
  if (file.format == "svg") return shown_heat(*map, "drawn by librsvg");
  if (pixels && !have_common_part(pixels->baseline, map->size))
    return shown_heat(*map, "one pixel for several");
  Heat heat = shown_heat(*map, "");
  heat.image.size = map->size;
  return heat;
}

/// That of reports, so narrow that its smallest words have 10 px in the column of a phone.
Theme phone_theme() {
  constexpr double kColumn_px = 345.0, kWords_px = 10.0;
  Theme theme = report_theme();
  const double width_pt = kColumn_px * theme.tick_font_pt / kWords_px;
  theme.height_pt *= width_pt / theme.width_pt;
  theme.width_pt = width_pt;
  return theme;
}

ShownImage svg_image(const Figure& figure, const Theme& theme) {
  constexpr double kPixelsPerPoint = 96.0 / 72.0;
  const Drawing drawing = lay_out(figure, theme);
  const auto pixels = [](double length_pt) {
    return static_cast<int>(std::lround(kPixelsPerPoint * length_pt));
  };
  return {fmt::format("data:{};base64,{}", media_type("svg"), base64(to_svg(drawing))),
          ImageSize{pixels(drawing.width), pixels(drawing.height)}, ""};
}

/// What changed, drawn for a wide page and for a narrow one.
void draw_change(const DiffItem& item, const std::optional<FigureValues>& values,
                 ShownImages& shown) {
  std::optional<Figure> figure = change_figure(item, values);
  if (!figure) return;
  shown.change = svg_image(*figure, report_theme());
  figure->columns = 1;
  shown.narrow_change = svg_image(*figure, phone_theme());
}

/// The files of an item's image, and what is made of them.
void read_images(const Plan& plan, const std::optional<FigureValues>& values,
                 const ImageOptions& options, std::size_t limit, ShownImages& shown) {
  const ImageFile& file = *plan.file;
  if (!file.baseline.empty())
    shown.baseline = read_image(file.baseline, file.format, file.diff.baseline_renderer, limit);
  if (!file.current.empty())
    shown.current = read_image(file.current, file.format, file.diff.current_renderer, limit);
  std::optional<Heat> heat;
  if (plan.heat && values) heat = heat_on_common_axes(*values, options);
  if (plan.heat && !heat) heat = heat_image(file, options);
  if (file.diff.pixels) shown.changed_share = file.diff.pixels->changed_share;
  if (heat) {
    shown.changed_share = heat->changed_share;
    shown.heat = std::move(heat->image);
  }
  shown.format = file.format;
  if (has_both(file) && !shown.heat) shown.no_heat = no_heat_reason(plan);
  const auto& pixels = file.diff.pixels;
  if (!pixels || pixels->largest_cluster_pixels == 0) return;
  shown.cluster = pixels->largest_cluster;
  shown.cluster_in = {std::max(pixels->baseline.width, pixels->current.width),
                      std::max(pixels->baseline.height, pixels->current.height)};
}

ShownImages read_all(const DiffItem& item, const Plan& plan, const ImageOptions& options,
                     std::size_t limit) {
  ShownImages shown;
  std::optional<FigureValues> values;
  try {
    if (plan.heat || plan.change) values = figure_values(item);
    if (plan.change) draw_change(item, values, shown);
  } catch (const IoError&) {
    values.reset();  // The verdict reports it.
  }
  shown.absent = plan.absent;
  if (plan.file == nullptr) return shown;
  try {
    read_images(plan, values, options, limit, shown);
  } catch (const IoError& error) {
    ShownImages none;
    none.change = std::move(shown.change);
    none.narrow_change = std::move(shown.narrow_change);
    none.absent = std::string("Not shown: ") + error.what();
    return none;
  }
  return shown;
}

/// Leaves out what was made for which the page has no room, heat maps first.
void drop_images(std::vector<ShownImages>& shown, const ImageBudget& budget) {
  std::size_t room = static_cast<std::size_t>(kImageShare * static_cast<double>(budget.page_bytes));
  for (const ShownImages& images : shown)
    for (const auto* image : {&images.baseline, &images.current})
      if (*image) room -= std::min(room, (*image)->uri.size());
  const auto fits = [&room](const std::optional<ShownImage>& image) {
    if (image && image->uri.size() > room) return false;
    room -= image ? image->uri.size() : 0;
    return true;
  };
  for (ShownImages& images : shown)
    if (!fits(images.change)) images.change = images.narrow_change = std::nullopt;
  for (ShownImages& images : shown)
    if (!fits(images.narrow_change)) images.narrow_change.reset();
  for (ShownImages& images : shown) {
    if (fits(images.heat)) continue;
    images.heat.reset();
    images.no_heat = "No heat map: the page has no room for it (--page-size).";
  }
}

}  // namespace

bool is_repeated(const DiffResult& result, const DiffItem& item) {
  const SharedCause* shared = shared_cause_of(result, item);
  return shared != nullptr &&
         std::ranges::find(shared->ids, item.id) - shared->ids.begin() >= kExamples;
}

std::vector<ShownImages> shown_images(const DiffResult& result, const DiffSettings& settings,
                                      const ImageBudget& budget) {
  const std::vector<Plan> all = plans(result, budget);
  std::vector<ShownImages> shown(all.size());
  parallel_for(all.size(), [&](std::size_t i) {
    const DiffItem& item = result.items[i];
    shown[i] = read_all(item, all[i], settings.images_of(item.id), budget.largest_bytes);
  });
  drop_images(shown, budget);
  return shown;
}

}  // namespace mapproof
