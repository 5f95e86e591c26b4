#include "core/association/stretch_search.hpp"

namespace mapproof {

std::string_view name(AssociationFault fault) {
  return fault == AssociationFault::kSwapped ? "swapped"
         : fault == AssociationFault::kWrong ? "wrong"
                                             : "mixed";
}

StretchSearch::StretchSearch(const StretchCosts& costs, const std::vector<int>& order, int number)
    : given_(costs), number_(number) {
  for (const Eigen::MatrixXf& of_id : costs.costs) {
    Eigen::MatrixXf sum = Eigen::MatrixXf::Zero(of_id.rows(), of_id.cols() + 1);
    for (std::size_t k = 0; k < order.size(); ++k)
      sum.col(static_cast<Eigen::Index>(k) + 1) =
          sum.col(static_cast<Eigen::Index>(k)) + of_id.col(order[k]);
    sums_.push_back(std::move(sum));
  }
}

float StretchSearch::least(const Eigen::VectorXf& costs) const {
  float sum = 0.0F;
  for (Eigen::Index k = 0; k < costs.size(); k += given_.segment)
    sum += costs.segment(k, given_.segment).minCoeff();
  return sum;
}

/// Whether a block of the order has evidence about the IDs that the fault takes away.
bool StretchSearch::concerned(AssociationFault fault, std::size_t a, std::size_t b,
                              Eigen::Index block) const {
  const auto has = [&](std::size_t id) {
    return (sums_[id].col(block + 1) - sums_[id].col(block)).maxCoeff() > 0.0F;
  };
  return has(a) || (fault == AssociationFault::kSwapped && has(b));
}

const std::pair<Eigen::VectorXf, Eigen::VectorXf>& StretchSearch::costs(AssociationFault fault,
                                                                        std::size_t a,
                                                                        std::size_t b, int begin,
                                                                        int end) {
  const Eigen::MatrixXf& A = sums_[a];
  const Eigen::MatrixXf& B = sums_[b];
  const Eigen::Index count = A.cols() - 1;
  costs_.first.noalias() = A.col(count) - (A.col(end) - A.col(begin));
  costs_.second.noalias() = B.col(count) + (A.col(end) - A.col(begin));
  if (fault == AssociationFault::kSwapped) {
    costs_.first += B.col(end) - B.col(begin);
    costs_.second -= B.col(end) - B.col(begin);
  }
  return costs_;
}

AssociationHypothesis StretchSearch::best(AssociationFault fault, std::size_t a, std::size_t b) {
  const auto count = static_cast<int>(sums_[a].cols()) - 1;
  std::vector<char> is_concerned(static_cast<std::size_t>(count));
  for (int block = 0; block < count; ++block)
    is_concerned[static_cast<std::size_t>(block)] = concerned(fault, a, b, block) ? 1 : 0;
  const float as_given = least(sums_[a].col(count)) + least(sums_[b].col(count));
  AssociationHypothesis found{
      .fault = fault, .first = given_.ids[a], .second = given_.ids[b], .order = number_};
  for (int begin = 0; begin < count; ++begin) {
    if (is_concerned[static_cast<std::size_t>(begin)] == 0) continue;
    for (int end = begin + 1; end <= count; ++end) {
      if (end - begin == count || is_concerned[static_cast<std::size_t>(end) - 1] == 0) continue;
      const auto& [first, second] = costs(fault, a, b, begin, end);
      const auto gain = static_cast<double>(as_given - least(first) - least(second));
      if (gain <= found.gain) continue;
      found.gain = gain;
      found.begin = begin;
      found.end = end;
    }
  }
  return found;
}

}  // namespace mapproof
