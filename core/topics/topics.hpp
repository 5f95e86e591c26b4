#pragma once

#include <span>
#include <string_view>

#include "core/topics/topic.hpp"

namespace mapproof {

/// How often the confidence ellipses of a map hold the mean of the maps of many walks in the same
/// world, and how often the ground truth: by sensor, method and number of steps, and by the length
/// of the blocks.
extern const Topic kUncertaintyTopic;

/// How well the criteria that need no ground truth pick among methods and parameters.
extern const Topic kChoiceTopic;

/// Wrong data association: bearings with confused landmark IDs, entry by entry or row by row over
/// stretches; the association is estimated with the map, against the share that is confused.
extern const Topic kAssociationTopic;

/// Missing entries: bearings missing at random, beyond a sensor's limited range, and behind other
/// landmarks; missing data are filled or left, and mapped, against the share that is missing.
extern const Topic kMissingTopic;

/// Whether several sensors in one map are better than the best of them alone.
extern const Topic kMixedTopic;

/// Landmarks that move once: how far they must move to be noticed, named and dated, and how often a
/// landmark that did not move is named.
extern const Topic kMovedTopic;

/// Real robots' scans of surveyed landmarks (MRCLAM [leung2011]): one map per sensor and method,
/// without poses and odometry, against the survey; the pairs that range and bearing measured, and
/// the uncertainty of each landmark.
extern const Topic kMrclamTopic;

/// How far incremental maps lie from those of the whole history, and the cost of each.
extern const Topic kIncrementalTopic;

/// Sub-maps compared with the whole map: by their size, by their overlap, and where a sensor of
/// limited range leaves data missing.
extern const Topic kSubmapsTopic;

/// Landmark ISOMAP compared with ISOMAP, by the number of reference landmarks.
extern const Topic kReferencesTopic;

/// Errors of maps over the size of the room, the number and diameter of landmarks, the sensor's
/// reach, its noise, the steps and the number of anchors, by one factor or two at a time.
extern const Topic kSweepTopic;

/// Whether faults of range-only logs are reported: simulated drives with one fault each.
extern const Topic kDoubtTopic;

/// All topics, in the order of their studies. A new one is added to core/topics/topics.cpp.
std::span<const Topic* const> all_topics();

/// The topic of that name; null if there is none.
const Topic* topic_named(std::string_view name);

}  // namespace mapproof
