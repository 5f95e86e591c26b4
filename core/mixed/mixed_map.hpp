#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/embed/embedder.hpp"
#include "core/model/embedding.hpp"
#include "core/model/observation_history.hpp"

namespace mapproof {

struct JointMapOptions {
  int rounds = 20;  ///< >= 1.
};

struct JointMap {
  Embedding embedding;
  std::vector<double> shares;  ///< Of each sensor in the weights of all pairs; their sum is 1.
};

/// One map of several manifolds of observations that are the plane, each bent in its own way
/// [yairi2007, section 6]: of each sensor only the order of its distances is trusted.
///
/// Alternately, each sensor's distances become the increasing function of them that fits the map's
/// best (monotone regression [kruskal1964]), with the variance about it at pairs of such a
/// distance; and the map takes a few steps of SMACOF towards their mean over the sensors, weighted
/// by the inverses of these variances. So a sensor that cannot distinguish far pairs still
/// contributes to near ones.
/// @param distances  Of each sensor, M x M; infinite: not known.
/// @param start      M x 2, finite.
/// @return kFailed if the pairs that some sensor knows leave the landmarks in pieces.
/// @throws InvalidInput if sizes differ or a bound is broken.
/// @note O(M^2 log M) a round and sensor, and O(M^3) for the sparse solve's factor.
JointMap joint_map(const std::vector<Eigen::MatrixXd>& distances, const Points& start,
                   const JointMapOptions& options = {});

/// How badly a map agrees with the order of the sensors' distances: the mean over all pairs that a
/// sensor knows of half the logarithm of the variance about the increasing fit, in units of the
/// map's mean square distance from its centre; at least half of log(1e-4) for each. joint_map()
/// minimizes it, but for rounds; so maps from several starts can be compared.
/// @param map  M x 2, finite, no point.
/// @throws InvalidInput if sizes differ or a bound is broken.
double order_misfit(const std::vector<Eigen::MatrixXd>& distances, const Points& map);

/// The joint map from the start with the least final order_misfit(); of equal ones the first. A
/// sensor whose distortion a single start shared would confirm itself: so each has its start.
/// @param starts  One or more, as joint_map() needs them.
/// @throws InvalidInput without a start, or as joint_map().
JointMap best_joint_map(const std::vector<Eigen::MatrixXd>& distances,
                        const std::vector<Points>& starts, const JointMapOptions& options = {});

/// The increasing values nearest to `values` in least squares, in the order given (pool adjacent
/// violators).
std::vector<double> increasing_fit(const std::vector<double>& values);

/// One sensor's contribution to a map of several.
struct MixedSensor {
  Sensor sensor = Sensor::kVisibility;
  MethodSetting setting;      ///< Of its own map, with its parameter.
  Embedding own;              ///< Of its observations alone, M x 2.
  Embedding by_order;         ///< The same by the joint map's method; empty if `own` is not a map.
  Eigen::MatrixXd distances;  ///< M x M; infinite: not known to this sensor.
  double reliability = 0.0;   ///< See reliability().
  double weight = 0.0;        ///< In the mean distances that the joint map starts from; sum 1.
  double share = 0.0;         ///< In the weights of all pairs of the joint map; sum 1.
};

/// A joint map and its inputs.
struct MixedMap {
  Embedding joint;        ///< M x 2; NaN rows: unseen by every sensor.
  Embedding mean;         ///< The map of the mean distances, likewise; `joint` starts from it too.
  MethodSetting setting;  ///< Of `mean`, with its parameter.
  std::vector<MixedSensor> sensors;
};

/// One map of the same landmarks as several sensors observed them, and each sensor's own: mean
/// distances weighted by reliability are mapped, and joint_map() begins from there and from each
/// sensor's own map by order; the one of the least order_misfit() is taken.
///
/// Steps need not be the same: each sensor's distances are over its own. A landmark that one sensor
/// never saw is placed by the others.
/// @param histories  Of the same landmarks in the same order, of different sensors.
/// @param steps      The first so many of each are used; 0: all.
/// @param setting    Without a parameter: the usual one of each map.
/// @param own        Settings of the sensors' own maps, one each; empty: `setting` of all.
/// @return `joint` is kFailed if the mean distances give no map, and has the statuses of that map.
/// @throws InvalidInput if landmarks differ, sensors repeat, `own` is of another number of sensors,
///         or `steps` is out of bounds.
/// @note S + 1 maps by the method and 2 S + 1 of joint_map() for S sensors.
MixedMap mixed_map(const std::vector<ObservationHistory>& histories, Eigen::Index steps,
                   const MethodSetting& setting, const EmbedderOptions& options = {},
                   const std::vector<MethodSetting>& own = {});

}  // namespace mapproof
