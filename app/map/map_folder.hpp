#pragma once

#include <filesystem>

#include "core/model/map_record.hpp"
#include "core/records/studies/folder_lock.hpp"

namespace mapproof {

/// The file that marks a folder as that of a map.
inline constexpr const char* kMapFile = "map.json";

/// Throws unless the folder is new, empty, or marked by `file` as that of an earlier `kind`.
/// @throws IoError saying what is in the way.
void check_result_folder(const std::filesystem::path& folder, const char* file, const char* kind);

/// Throws unless a map may be written there: the folder is new, empty, or holds a map.
/// @throws IoError saying what is in the way.
void check_map_folder(const std::filesystem::path& folder);

/// Throws if the folder holds another map than `map`: of other landmarks, another sensor, method,
/// parameter or number of steps, other anchors or another ground truth. The same one may be made
/// again.
/// @throws IoError saying what differs.
void check_same_map(const std::filesystem::path& folder, const MapRecord& map);

/// The same before `map` is made: parameters that are not known yet are not compared, nor is the
/// method if `any_method`.
void check_may_become(const std::filesystem::path& folder, const MapRecord& map, bool any_method);

/// The folder of a map while it is written: made, checked, locked, and rid of what a killed process
/// left behind.
class MapFolder {
 public:
  /// For any map. @throws IoError as check_map_folder(), or if another process writes there.
  explicit MapFolder(const std::filesystem::path& folder);
  /// For this one. @throws IoError as the checks above, or if another process writes there.
  MapFolder(const std::filesystem::path& folder, const MapRecord& map);

  std::filesystem::path path() const { return folder_.files().path(); }

 private:
  LockedFolder folder_;
};

}  // namespace mapproof
