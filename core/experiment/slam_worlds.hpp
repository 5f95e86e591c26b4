#pragma once

#include <cstdint>

#include "core/model/slam_experiment.hpp"
#include "core/range_slam/factors/convergence.hpp"
#include "core/simulate/range_world.hpp"

namespace mapproof {

/// The simulator's options for so many landmarks and steps.
RangeWorldOptions range_world_options(const SlamWorldOptions& world, const RangeNoiseModel& noise,
                                      int landmarks, int steps);

/// The standard deviations of a noise model.
RangeNoise range_noise(const RangeNoiseModel& noise);

/// The run of an experiment's example: all landmarks ranged to at every second, no odometry.
/// @throws InvalidInput if it has no example.
SlamRun make_example(const SlamExperiment& experiment, std::vector<SlamTiming>& timings);

/// Errors as measurements come in, over all pairs; these run in parallel, and share their worlds,
/// walks and random numbers over the noise models. A pair without a map at some number of steps
/// does not count there.
ConvergenceCurve make_convergence(const SlamExperiment& experiment, const RangeNoiseModel& noise);

/// Every mapping method on ranges and on squared ranges of one world, and the spectral map.
/// @throws InvalidInput if the experiment has no such part.
RangeHistoryStudy make_histories(const SlamExperiment& experiment);

/// The maps of the ranges of one flight in space, with landmarks known and with none.
/// @throws InvalidInput if the experiment has no such part.
SpaceRun make_space_run(const SlamExperiment& experiment);

/// Seconds of factorisation and upgrade over the experiment's grid.
std::vector<FactorizationCost> time_factorization(const SlamExperiment& experiment);

}  // namespace mapproof
