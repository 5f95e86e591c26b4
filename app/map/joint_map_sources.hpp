#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/map/one_sensor.hpp"
#include "core/records/observations/observations.hpp"

namespace mapproof {

/// All names of the files' landmarks, in the order in which they come.
/// @throws IoError naming the file if a kind of sensor is there twice, or a file shares fewer than
///         three landmarks with those before it.
std::vector<std::string> joint_names(const std::vector<ObservationSource>& sources);

/// Checks method and steps, and brings the files' histories into common rows; what a file does not
/// name is missing throughout. @throws IoError naming the file.
std::vector<ObservationHistory> common_histories(const std::vector<ObservationSource>& sources,
                                                 const std::vector<std::string>& names,
                                                 const MapOptions& options);

/// The truth that comes with the first file that has one, in the rows of `names`.
std::optional<Points> common_truth(const std::vector<ObservationSource>& sources,
                                   const std::vector<std::string>& names);

/// Names, kinds and steps of the files, for the report, and a remark of what is not in all of them.
void describe_sources(const std::vector<ObservationSource>& sources,
                      const std::vector<std::string>& names, MapResult& result);

/// Rows that no sensor saw, with a remark. @throws IoError unless they are to be dropped or a log
/// says so; or if a file shows none at all.
std::vector<Eigen::Index> unseen_by_all(const std::vector<ObservationSource>& sources,
                                        const std::vector<ObservationHistory>& histories,
                                        const MapOptions& options, MapResult& result);

}  // namespace mapproof
