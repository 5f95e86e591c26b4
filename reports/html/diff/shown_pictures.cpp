#include "reports/html/diff/shown_pictures.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "core/base/byte_source.hpp"
#include "core/base/errors.hpp"
#include "core/base/parallel.hpp"
#include "render/image/png.hpp"
#include "reports/html/sha256.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMostPixels = std::int64_t{1} << 28;

bool has_both(const PictureFile& file) { return !file.baseline.empty() && !file.current.empty(); }

/// How much a picture has to show; 0: nothing.
int interest(const PictureFile& file) {
  const int of_format = file.format == "png" ? 1 : 0;
  if (file.format != "png" && file.format != "svg") return 0;
  if (!has_both(file)) return 2 + of_format;
  switch (file.diff.state) {
    case PictureState::kDifferent:
      return 6 + of_format;
    case PictureState::kWithinTolerance:
      return 4 + of_format;
    default:
      return 0;
  }
}

const PictureFile* most_telling(const DiffItem& item) {
  const PictureFile* best = nullptr;
  for (const PictureFile& file : item.pictures)
    if (interest(file) > (best == nullptr ? 0 : interest(*best))) best = &file;
  return best;
}

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i)
    number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

/// By its header; a browser reads the rest.
PictureSize png_size(const std::string& bytes, const fs::path& path) {
  constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
  if (bytes.size() < 24 || !bytes.starts_with(kSignature))
    throw IoError(path.string(), "is not a PNG");
  const std::int64_t width = number_at(bytes, 16), height = number_at(bytes, 20);
  if (width < 1 || height < 1 || width > kMostPixels || height > kMostPixels / width)
    throw IoError(path.string(), fmt::format("{} x {} pixels are not shown", width, height));
  return {static_cast<int>(width), static_cast<int>(height)};
}

ShownPicture read_picture(const fs::path& path, const std::string& format,
                          const std::string& renderer, std::size_t limit) {
  const std::string bytes = read_input(path, limit);
  ShownPicture picture;
  picture.renderer = renderer;
  if (format == "png") picture.size = png_size(bytes, path);
  picture.uri =
      (format == "png" ? "data:image/png;base64," : "data:image/svg+xml;base64,") + base64(bytes);
  return picture;
}

/// What is to be read for one item.
struct Plan {
  const PictureFile* file = nullptr;
  bool heat = false;
  std::string absent;
};

std::string unreadable_reason(const DiffItem& item) {
  for (const PictureFile& file : item.pictures)
    if (has_both(file) && file.diff.state == PictureState::kUnreadable)
      return "Not shown: " + file.format + " cannot be read.";
  return "";
}

std::uintmax_t bytes_of(const PictureFile& file) {
  std::uintmax_t bytes = 0;
  for (const fs::path& path : {file.baseline, file.current}) {
    std::error_code error;
    const std::uintmax_t size = path.empty() ? 0 : fs::file_size(path, error);
    if (!error) bytes += size;
  }
  return bytes;
}

std::vector<Plan> plans(const DiffResult& result, const PictureBudget& budget) {
  std::vector<Plan> all;
  std::uintmax_t used = 0;
  std::size_t heat_maps = 0;
  for (const DiffItem& item : result.items) {
    Plan plan;
    if (item.judgement.verdict != Verdict::kIdentical) {
      plan.file = most_telling(item);
      if (plan.file == nullptr) plan.absent = unreadable_reason(item);
    }
    if (plan.file != nullptr && used + bytes_of(*plan.file) > budget.all_bytes) {
      plan.absent = fmt::format("Not shown: the pictures of this page fill {} MiB already.",
                                budget.all_bytes >> 20);
      plan.file = nullptr;
    }
    if (plan.file != nullptr) {
      used += bytes_of(*plan.file);
      plan.heat =
          plan.file->format == "png" && has_both(*plan.file) && heat_maps < budget.heat_maps;
      heat_maps += plan.heat ? 1 : 0;
    }
    all.push_back(std::move(plan));
  }
  return all;
}

/// Of two pictures that are shown without one.
std::string no_heat_reason(const Plan& plan) {
  if (plan.file->format != "png") return "No heat map: only PNGs have one.";
  return plan.heat ? "No heat map: the sizes differ."
                   : "No heat map: as many as a page holds are made of others.";
}

std::optional<ShownPicture> heat_picture(const PictureFile& file, const PictureOptions& options) {
  const Image image = heat_map(file.baseline, file.current, options);
  if (image.width < 1 || image.height < 1) return std::nullopt;
  return ShownPicture{"data:image/png;base64," + base64(encode_png(image)),
                      PictureSize{image.width, image.height}, ""};
}

ShownPictures read_all(const Plan& plan, const PictureOptions& options, std::size_t limit) {
  ShownPictures shown;
  shown.absent = plan.absent;
  if (plan.file == nullptr) return shown;
  const PictureFile& file = *plan.file;
  try {
    if (!file.baseline.empty())
      shown.baseline = read_picture(file.baseline, file.format, file.diff.baseline_renderer, limit);
    if (!file.current.empty())
      shown.current = read_picture(file.current, file.format, file.diff.current_renderer, limit);
    if (plan.heat) shown.heat = heat_picture(file, options);
  } catch (const IoError& error) {
    shown = {};
    shown.absent = std::string("Not shown: ") + error.what();
    return shown;
  }
  shown.format = file.format;
  if (has_both(file) && !shown.heat) shown.no_heat = no_heat_reason(plan);
  if (file.diff.pixels && file.diff.pixels->largest_cluster_pixels > 0)
    shown.cluster = file.diff.pixels->largest_cluster;
  return shown;
}

}  // namespace

std::vector<ShownPictures> shown_pictures(const DiffResult& result, const DiffSettings& settings,
                                          const PictureBudget& budget) {
  const std::vector<Plan> all = plans(result, budget);
  std::vector<ShownPictures> shown(all.size());
  parallel_for(all.size(), [&](std::size_t i) {
    shown[i] = read_all(all[i], settings.pictures_of(result.items[i].id), budget.largest_bytes);
  });
  return shown;
}

}  // namespace mapproof
