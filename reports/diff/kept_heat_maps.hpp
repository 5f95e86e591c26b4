#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "reports/diff/diff_result.hpp"
#include "reports/diff/images/change_map.hpp"
#include "reports/diff/images/image_changes.hpp"

namespace mapproof {

/// How many bytes of images may still have their heat maps kept. Several threads may use it; the
/// last room may be taken by as many images as there are threads.
class HeatMapRoom {
 public:
  explicit HeatMapRoom(std::uint64_t bytes) : bytes_(static_cast<std::int64_t>(bytes)) {}

  bool has(std::uint64_t bytes) const { return static_cast<std::int64_t>(bytes) <= bytes_; }
  void take(std::uint64_t bytes) { bytes_ -= static_cast<std::int64_t>(bytes); }

 private:
  std::atomic<std::int64_t> bytes_;
};

/// Compares the files of an image, and keeps their heat map if there is room. SVGs are not drawn
/// for it alone.
/// @throws as image_diff().
void compare_and_keep(ImageFile& file, const ImageOptions& options, HeatMapRoom& room);

/// @param map  Consumed. @return Empty for an empty one.
std::optional<HeatMapFile> heat_map_file(HeatMap map);

/// The heat map that the comparison kept, else one made now from the files.
/// @return Empty if the files do not differ, or differ much in size.
/// @throws as image_diff().
std::optional<HeatMapFile> heat_map_file(const ImageFile& file, const ImageOptions& options);

}  // namespace mapproof
