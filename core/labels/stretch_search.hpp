#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace mapproof {

/// How labels may be wrong over a stretch.
enum class LabelFault {
  kSwapped,  ///< Two landmarks bear each other's label.
  kWrong,    ///< Detections under one label are of another landmark.
  kInPart,   ///< Some of them are, whenever.
};

/// The name used in files: "swapped", "wrong", "mixed".
std::string_view name(LabelFault fault);

/// A stretch of blocks over which labels may be wrong.
struct LabelHypothesis {
  LabelFault fault = LabelFault::kSwapped;
  int first = 0;   ///< The label; kSwapped: the lower of the two.
  int second = 0;  ///< kSwapped: the other; kWrong: whose detections they are.
  int order = 0;   ///< Which of the blocks' orders the stretch is one in.
  int begin = 0;   ///< Places in that order, [begin, end).
  int end = 0;
  double gain = 0.0;  ///< By how much it lowers the cost that was asked for, m^2.
  Eigen::RowVector2d first_m = Eigen::RowVector2d::Zero();   ///< Where both landmarks then are,
  Eigen::RowVector2d second_m = Eigen::RowVector2d::Zero();  ///< or may be looked for first.
};

/// What the detections under some labels cost, block by block, for each value of what is not known
/// of their landmarks: costs of stretches are sums of columns, of labels that share a landmark too.
struct StretchCosts {
  std::vector<int> labels;
  std::vector<Eigen::MatrixXf> costs;  ///< Of each label: values x blocks.
  Eigen::Index segment = 1;  ///< Each so many values are those of one unknown; the cheapest counts.
};

/// Two labels over all stretches of one order of blocks.
class StretchSearch {
 public:
  /// @param costs  Has to outlive the search.
  /// @param order  All blocks, in the order whose stretches are looked at.
  /// @param number  Of that order, for the hypotheses.
  StretchSearch(const StretchCosts& costs, const std::vector<int>& order, int number);

  /// The stretch in which the fault of the a-th and b-th label gains the most; its gain is 0 if
  /// none gains. Both landmarks' places are left for the caller to fill.
  /// @note O(blocks^2 * values) time.
  LabelHypothesis best(LabelFault fault, std::size_t a, std::size_t b);

  /// What both landmarks cost at each value under a hypothesis of the a-th and b-th label.
  const std::pair<Eigen::VectorXf, Eigen::VectorXf>& costs(LabelFault fault, std::size_t a,
                                                           std::size_t b, int begin, int end);

 private:
  bool concerned(LabelFault fault, std::size_t a, std::size_t b, Eigen::Index block) const;
  float least(const Eigen::VectorXf& costs) const;

  const StretchCosts& given_;
  std::vector<Eigen::MatrixXf> sums_;  ///< Column k: of the first k blocks.
  int number_;
  std::pair<Eigen::VectorXf, Eigen::VectorXf> costs_;
};

}  // namespace mapproof
