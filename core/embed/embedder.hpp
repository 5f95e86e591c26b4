#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/embed/landmark_isomap.hpp"
#include "core/embed/landmark_mvu.hpp"
#include "core/embed/lle.hpp"
#include "core/embed/smacof.hpp"
#include "core/model/embedding.hpp"
#include "core/model/method.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {

/// What holds for every method of an embedder.
struct EmbedderOptions {
  /// Leave pairs of landmarks never seen together out of the neighbour graph (visibility only;
  /// with infinite distances they are out in any case).
  bool only_seen_together = false;
  SmacofOptions smacof;
  /// Weighted SMACOF is stopped early: full convergence makes worse maps.
  SmacofOptions smacof_knn{.relative_fall = 1e-2, .max_iterations = 1000};
  LleOptions lle;
  LandmarkIsomapOptions landmark_isomap;
  LandmarkMvuOptions landmark_mvu;
};

/// Every mapping method over the same proximities; starts that several of them share are computed
/// once.
class Embedder {
 public:
  /// @param proximities  Of landmarks that were all observed; fewer than 3 make every embedding
  ///        kFailed. Pairs without a common step (infinite distance) take the shortest path over
  ///        the others where a method needs all distances, and the embedding has a status of it.
  explicit Embedder(Proximities proximities, EmbedderOptions options = {});

  /// @return kFailed, with NaN coordinates, if the method cannot give a map of these data. The
  ///         statuses of a map that the method started from are among those of the result.
  Embedding embed(const MethodSetting& setting);

  /// The method with a parameter to start from, if it has one: K = 6 or as many as there can be,
  /// the median of the squared distances (to two digits) as sigma2, degree 2.
  MethodSetting usual_setting(Method method) const;

 private:
  std::vector<Status> caveats(const Embedding& map, const MethodSetting& setting);
  std::optional<Status> obstacle(const MethodSetting& setting) const;
  Embedding solve(const MethodSetting& setting);
  Embedding with_all_distances(Embedding embedding) const;
  Embedding weighted_smacof(int neighbours);
  Embedding on_graph_of(Method method, int neighbours);
  Embedding by_references(Method method, const ConnectedGraph& graph, int neighbours);
  Embedding on_neighbourhoods(Method method, int neighbours);
  const NeighbourLists& nearest(int neighbours);
  Eigen::Index size() const { return proximities_.squared_distances.rows(); }
  const Eigen::MatrixXd& distances();
  const Eigen::MatrixXd& complete_distances();
  const Eigen::MatrixXd& complete_squares() const;
  Eigen::MatrixXd completed_inner_products() const;
  const Embedding& linear();
  const Embedding& equal_weights();

  EmbedderOptions options_;
  Proximities proximities_;
  Eigen::MatrixXd distances_;  ///< Empty until needed; may hold infinities.
  /// Distances and squares, all finite if the data allow; empty where nothing had to be completed.
  Eigen::MatrixXd completed_distances_;
  Eigen::MatrixXd completed_squares_;
  NeighbourLists nearest_;  ///< The first so many of each landmark, nearest first.
  int nearest_count_ = 0;
  Eigen::Index completed_pairs_ = 0;
  bool seen_apart_ = false;  ///< Some landmarks share no step even over others.
  double apart_ = 0.0;       ///< Landmarks as far as this were never seen together.
  double cutoff_ = 0.0;      ///< Landmarks as far as this are not neighbours of any other.
  int groups_ = 1;           ///< Of landmarks of which no two were seen together with another's.
  std::optional<Embedding> linear_;
  std::optional<Embedding> equal_weights_;
};

/// The map of histories whose distances are no array, with what the observations do not determine:
/// equal to that of Embedder but for rounding.
/// @param setting  Of a method that has_references().
/// @note See landmark_isomap(), landmark_mvu() and connected_neighbour_graph().
Embedding embed_large(const HistoryDistances& distances, const MethodSetting& setting,
                      const EmbedderOptions& options = {});

/// A map of what one sensor detected of landmarks that were all seen, without an array of landmarks
/// and steps. Landmark ISOMAP of all sensors and LPCA of visibility hold none of landmarks and
/// landmarks either.
/// @param setting  Without a parameter: it is set to the usual one of these data.
/// @throws InvalidInput as visibility_distances().
Embedding embed_detected(const DetectionLog& log, Sensor sensor, MethodSetting& setting,
                         const EmbedderOptions& options = {});

/// What decides how a history is mapped.
struct HistoryExtent {
  Sensor sensor = Sensor::kVisibility;
  Eigen::Index landmarks = 0;
  Eigen::Index steps = 0;
  bool misses_any = false;  ///< Some value is missing.
  bool is_list = false;     ///< Visibility that is mapped faster by lists of what was seen.
};

HistoryExtent extent_of(const HistoryBlocks& history, Eigen::Index steps);
HistoryExtent extent_of(const DetectionLog& log, Sensor sensor);

/// Whether the method's map comes from products with the vectors, without distances: LPCA of
/// complete histories of many landmarks.
bool maps_by_vectors(Method method, const HistoryExtent& history);

/// The memory that a map of so many landmarks takes at most besides its observations, bytes: for
/// the array of all distances and its copies, or for the paths to the references.
double needed_bytes(Method method, Eigen::Index landmarks, const EmbedderOptions& options = {});

/// The same of a history that may be mapped by its vectors.
double needed_bytes(Method method, const HistoryExtent& history,
                    const EmbedderOptions& options = {});

/// K = 6, or as many as there can be.
double usual_neighbours(Eigen::Index landmarks);

/// An alternative to proximities(): takes a history of landmarks that were all observed, and how
/// many steps to use.
using ProximityRule = std::function<Proximities(const ObservationHistory&, Eigen::Index)>;

/// Maps the landmarks seen in the first `steps` observations of a history; the others get NaN rows
/// and the status kLandmarkUnseen, which names the first ten.
class HistoryEmbedder {
 public:
  /// @param rule  Empty: proximities(). Not called if no landmark was seen.
  /// @throws InvalidInput unless 1 <= steps <= history.steps().
  HistoryEmbedder(const HistoryBlocks& history, Eigen::Index steps,
                  EmbedderOptions options = {}, const ProximityRule& rule = {});

  /// @return M rows, as many as the history has landmarks.
  Embedding embed(const MethodSetting& setting);

  /// See Embedder.
  MethodSetting usual_setting(Method method) const { return embedder_->usual_setting(method); }

 private:
  Eigen::Index landmarks_;
  std::vector<Eigen::Index> seen_;
  std::vector<Status> statuses_;
  std::optional<Embedder> embedder_;
};

/// One map of a history, by the array of all distances only where the method needs it: Landmark
/// ISOMAP does not, nor LPCA of many landmarks.
/// @param setting  Without a parameter: it is set to the usual one of these data.
/// @throws InvalidInput as HistoryEmbedder.
Embedding embed_history(const HistoryBlocks& history, Eigen::Index steps, MethodSetting& setting,
                        const EmbedderOptions& options = {});

}  // namespace mapproof
