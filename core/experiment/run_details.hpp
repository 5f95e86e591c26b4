#pragma once

#include "core/model/experiment.hpp"
#include "core/model/observation_history.hpp"
#include "core/model/run_details.hpp"

namespace mapproof {

/// What figures show of one sensor's history, spectra apart.
///
/// The scan is the one that shows most: for visibility the step with the most hidden landmarks (of
/// those the one with the most visible), for other sensors the step nearest the room's centre; of
/// equals the first.
/// @param history  Of that sensor, along `path`, as long as the last checkpoint or longer.
SensorDetails sensor_details(const SensorStudy& study, const World& world, const Path& path,
                             const ObservationHistory& history);

}  // namespace mapproof
