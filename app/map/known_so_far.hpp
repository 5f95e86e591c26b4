#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/map/reference.hpp"
#include "core/model/map_record.hpp"

namespace mapproof {

/// What files say of the landmarks that a growing map holds so far. Anchors that are not on it are
/// left out, and all of them, with a status, while those that are do not span the plane.
/// @param record  Names and estimate are read; statuses are added to.
Reference known_so_far(MapRecord& record, const std::optional<NamedPointsFile>& anchors,
                       const std::optional<NamedPointsFile>& truth);

/// What has to be said of the files in the end, a sentence each: names that never came, landmarks
/// whose truth is not known.
std::vector<std::string> remarks_of_reference(const MapRecord& record,
                                              const std::optional<NamedPointsFile>& anchors,
                                              const std::optional<NamedPointsFile>& truth);

}  // namespace mapproof
