#include "reports/diff/kept_heat_maps.hpp"

#include <system_error>
#include <utility>

#include "reports/diff/images/image_diff.hpp"
#include "reports/diff/items.hpp"

namespace mapproof {
namespace {

/// Of both files; 0 if they cannot be read.
std::uint64_t bytes_of(const ImageFile& file) {
  std::error_code first, second;
  const std::uint64_t baseline = std::filesystem::file_size(file.baseline, first);
  const std::uint64_t current = std::filesystem::file_size(file.current, second);
  return first || second ? 0 : baseline + current;
}

}  // namespace

std::optional<HeatMapFile> heat_map_file(HeatMap map) {
  if (map.width < 1 || map.height < 1) return std::nullopt;
  HeatMapFile file{
      .png = {}, .size = {map.width, map.height}, .changed_share = map.changed_share()};
  file.png = encode_png(std::move(map));
  return file;
}

void compare_and_keep(ImageFile& file, const ImageOptions& options, HeatMapRoom& room) {
  const std::uint64_t bytes = bytes_of(file);
  const bool is_kept =
      bytes > 0 && room.has(bytes) && !media_type(file.format).empty() && file.format != "svg";
  HeatMap map;
  file.diff = image_diff(file.baseline, file.current, options, is_kept ? &map : nullptr);
  file.heat = heat_map_file(std::move(map));
  if (file.heat) room.take(bytes);
}

std::optional<HeatMapFile> heat_map_file(const ImageFile& file, const ImageOptions& options) {
  return file.heat ? file.heat : heat_map_file(heat_map(file.baseline, file.current, options));
}

}  // namespace mapproof
