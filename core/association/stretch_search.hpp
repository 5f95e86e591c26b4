#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace mapproof {

/// The types of wrong data association over a stretch.
enum class AssociationFault {
  kSwapped,  ///< ID swap: two landmarks have each other's ID.
  kWrong,    ///< Detections under one ID are of another landmark.
  kInPart,   ///< Some of them are, at any time.
};

/// The name used in files: "swapped", "wrong", "mixed".
std::string_view name(AssociationFault fault);

/// A stretch of blocks over which IDs may be wrong.
struct AssociationHypothesis {
  AssociationFault fault = AssociationFault::kSwapped;
  int first = 0;   ///< The ID; kSwapped: the lower of the two.
  int second = 0;  ///< kSwapped: the other; kWrong: the landmark of the detections.
  int order = 0;   ///< The order of the blocks that the stretch belongs to.
  int begin = 0;   ///< Indices in that order, [begin, end).
  int end = 0;
  double gain = 0.0;  ///< By how much it reduces the given cost, m^2.
  Eigen::RowVector2d first_m = Eigen::RowVector2d::Zero();   ///< Positions of both landmarks then,
  Eigen::RowVector2d second_m = Eigen::RowVector2d::Zero();  ///< or the first positions to try.
};

/// What the detections under some IDs cost, block by block, for each value of the unknowns of their
/// landmarks: the costs of stretches, and of IDs that share a landmark, are sums of columns.
struct StretchCosts {
  std::vector<int> ids;
  std::vector<Eigen::MatrixXf> costs;  ///< Of each ID: values x blocks.
  Eigen::Index segment = 1;  ///< Each so many values belong to one unknown; the cheapest counts.
};

/// Two IDs over all stretches of one order of blocks.
class StretchSearch {
 public:
  /// @param costs  Has to outlive the search.
  /// @param order  All blocks, in the order whose stretches are searched.
  /// @param number  Of that order, for the hypotheses.
  StretchSearch(const StretchCosts& costs, const std::vector<int>& order, int number);

  /// The stretch in which the fault of the a-th and b-th ID gains the most; its gain is 0 if none
  /// gains. The caller fills in both landmarks' positions.
  /// @note O(blocks^2 * values) time.
  AssociationHypothesis best(AssociationFault fault, std::size_t a, std::size_t b);

  /// What both landmarks cost at each value under a hypothesis of the a-th and b-th ID.
  const std::pair<Eigen::VectorXf, Eigen::VectorXf>& costs(AssociationFault fault, std::size_t a,
                                                           std::size_t b, int begin, int end);

 private:
  bool concerned(AssociationFault fault, std::size_t a, std::size_t b, Eigen::Index block) const;
  float least(const Eigen::VectorXf& costs) const;

  const StretchCosts& given_;
  std::vector<Eigen::MatrixXf> sums_;  ///< Column k: of the first k blocks.
  int number_;
  std::pair<Eigen::VectorXf, Eigen::VectorXf> costs_;
};

}  // namespace mapproof
