#include "core/statistics/friedman.hpp"

#include <algorithm>
#include <numeric>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/statistics/ties.hpp"

namespace mapproof {
namespace {

/// Squared ranks are multiples of 1/4 and their sums exact; their quotients are not.
constexpr double kRounding = 1e-12;

double chi_square_of(const Eigen::MatrixXd& ranks_of_units) {
  const double n = static_cast<double>(ranks_of_units.rows());
  const double k = static_cast<double>(ranks_of_units.cols());
  const double middle = n * (k + 1.0) / 2.0;
  const double between = (ranks_of_units.colwise().sum().array() - middle).square().sum();
  const double spread = ranks_of_units.squaredNorm() - n * k * (k + 1.0) * (k + 1.0) / 4.0;
  return spread > 0.0 ? (k - 1.0) * between / spread : 0.0;
}

}  // namespace

Eigen::RowVectorXd ranks(const Eigen::RowVectorXd& values) {
  if (!values.allFinite()) throw InvalidInput("ranks: a value is not finite");
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](Eigen::Index i) { return values(i); });
  Eigen::RowVectorXd ranks(values.size());
  const auto same = [&](std::size_t a, std::size_t b) {
    return values(order[a]) == values(order[b]);
  };
  for_each_tie(order.size(), same, [&](std::size_t first, std::size_t end, double rank) {
    for (; first < end; ++first) ranks(order[first]) = rank;
  });
  return ranks;
}

FriedmanTest friedman(Eigen::MatrixXd values) {
  if (values.rows() < 2) throw InvalidInput("friedman: at least two units are needed");
  if (values.cols() < 2) throw InvalidInput("friedman: at least two methods are needed");
  for (Eigen::Index i = 0; i < values.rows(); ++i) values.row(i) = ranks(values.row(i));
  const Eigen::MatrixXd& of_units = values;

  FriedmanTest test;
  test.units = static_cast<int>(values.rows());
  test.methods = static_cast<int>(values.cols());
  const Eigen::RowVectorXd means = of_units.colwise().mean();
  test.mean_ranks.assign(means.begin(), means.end());
  test.chi_square = chi_square_of(of_units);

  const double freedom = test.methods - 1.0;
  const double most = test.units * freedom;  // chi-square where all units agree.
  const boost::math::chi_squared chi_squared(freedom);
  test.chi_square_p = boost::math::cdf(boost::math::complement(chi_squared, test.chi_square));
  if (most - test.chi_square <= kRounding * most) {
    test.f = kInfinity;
    test.f_p = 0.0;
    return test;
  }
  test.f = (test.units - 1.0) * test.chi_square / (most - test.chi_square);
  const boost::math::fisher_f fisher_f(freedom, freedom * (test.units - 1.0));
  test.f_p = boost::math::cdf(boost::math::complement(fisher_f, test.f));
  return test;
}

}  // namespace mapproof
