#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/certainty/history_certainty.hpp"
#include "core/certainty/pair_certainty.hpp"
#include "core/model/detection_log.hpp"
#include "core/model/map_record.hpp"

namespace mapproof {

/// How sure each landmark of a map is, in the frame that the map is in; empty, with a remark, if
/// there is no map.
/// @param record   The map of the first `record.step` observations.
/// @param remarks  Told of landmarks without an ellipse.
std::optional<MapCertainty> map_uncertainty(const MapRecord& record,
                                            const ObservationHistory& history,
                                            const HistoryCertaintyOptions& options,
                                            std::vector<std::string>& remarks);

/// The same of a map of measured pairs, from scans drawn anew in blocks.
std::optional<MapCertainty> pair_map_uncertainty(const MapRecord& record, const DetectionLog& log,
                                                 const CertaintyFrame& frame,
                                                 const PairCertaintyOptions& options,
                                                 std::vector<std::string>& remarks);

}  // namespace mapproof
