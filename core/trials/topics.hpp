#pragma once

#include <span>
#include <string_view>

#include "core/trials/topic.hpp"

namespace mapproof {

/// How often the ellipses of a map hold the mean of the maps of many walks in the same world, and
/// how often the truth: by sensor, method and number of steps, and by the length of the blocks.
extern const Topic kCertaintyTopic;

/// How well what can be told of maps without the truth picks among methods and parameters.
extern const Topic kChoiceTopic;

/// Confused labels: bearings whose landmarks are not told apart, entry by entry or row by row over
/// stretches; the correspondence is estimated with the map, against the share that is confused.
extern const Topic kLabelsTopic;

/// Missing entries: bearings with gaps at random, of a sensor of limited range, and behind other
/// landmarks; gaps are filled or left, and mapped, against the share that is missing.
extern const Topic kMissingTopic;

/// Whether several kinds of sensor in one map are better than the best of them alone.
extern const Topic kMixedTopic;

/// Landmarks that move once: how far they must for the move to be noticed, named and dated, and how
/// often one is named that did not move.
extern const Topic kMovedTopic;

/// Real robots' looks at surveyed landmarks (MRCLAM [leung2011]): a map per kind of sensor and
/// method, without poses and odometry, against the survey; the pairs that range and bearing
/// measured, and how sure each landmark is.
extern const Topic kMrclamTopic;

/// How far maps that are carried on as observations arrive lie from those of the whole history, and
/// what each takes.
extern const Topic kOnlineTopic;

/// Sub-maps against the whole map: by their size, by their overlap, and where a sensor of limited
/// range leaves gaps.
extern const Topic kSubmapsTopic;

/// Errors of maps over the size of the room, the number and diameter of landmarks, the sensor's
/// reach, its noise, the steps and the number of anchors, by one factor or two at a time.
extern const Topic kSweepTopic;

/// All topics, in the order of their studies. A new one is added to core/trials/topics.cpp.
std::span<const Topic* const> all_topics();

/// The topic of that name; null if there is none.
const Topic* topic_named(std::string_view name);

}  // namespace mapproof
