#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "core/model/status.hpp"
#include "core/observe/features.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {

/// A plane of few dimensions near the columns of a matrix: a column y of M rows is W x + mean, and
/// a residual.
struct LowRankModel {
  Eigen::MatrixXd loadings;  ///< W, M x q.
  Eigen::VectorXd mean;      ///< M.
  /// What is added to the diagonal where a column's x is solved for: PPCA's variance of noise, the
  /// penalty of regularised PCA.
  double ridge = 0.0;
};

/// Columns of which the same rows were observed: they share one factor.
struct ColumnGroup {
  std::vector<Eigen::Index> rows;  ///< Observed ones, ascending; may be empty.
  std::vector<Eigen::Index> columns;
};

/// @note O(M C log C) time.
std::vector<ColumnGroup> column_groups(const Features& matrix);

/// The coordinates of one group's columns in the plane, given their observed rows.
struct GroupFit {
  Eigen::MatrixXd x;             ///< q x columns.
  Eigen::MatrixXd inverse;       ///< (W_o' W_o + ridge I)^-1 with W_o of the observed rows.
  double log_determinant = 0.0;  ///< Of the matrix inverted.
  double squared_left = 0.0;     ///< |y|^2 - y' W_o x over the centred observed entries.
};

GroupFit fit_group(const Features& matrix, const ColumnGroup& group, const LowRankModel& model);

/// Sums over the columns that the rows' regression on x needs.
struct Moments {
  Moments(Eigen::Index rows, Eigen::Index dimensions);

  /// @param spread  Posterior variance of each of the group's x; zero: x is taken as known.
  void add(const Features& matrix, const ColumnGroup& group, const GroupFit& fit,
           const Eigen::MatrixXd& spread);

  /// The row's loadings and mean that fit its observed entries best, with a penalty on the
  /// loadings; returns its residual sum of squares.
  double regress(Eigen::Index row, double penalty, LowRankModel& model) const;

  Eigen::MatrixXd products;  ///< (q + 1)^2 x M: sums of (x, 1)(x, 1)' of each row, column-major.
  Eigen::MatrixXd values;    ///< q + 1 x M: sums of (x, 1) y of each row.
  Eigen::VectorXd squares;   ///< M: sums of y^2.
  Eigen::MatrixXd all;       ///< (q + 1)^2: sums of (x, 1)(x, 1)' over all columns.
};

/// @throws InvalidInput unless 1 <= q < M, every row was observed once or more, `observed` is empty
///         or of the size of `values`, and all of these are finite.
void require_low_rank(const Features& matrix, Eigen::Index dimensions);

double observed_entries(const Features& matrix);

/// Lower bound of the variance of noise: a small share of the mean square of an observed entry.
/// Data of fewer dimensions than q have no noise, and no greatest likelihood.
double least_noise(const Features& matrix);

/// A start for either method: mean and leading eigenvectors of the rows' covariance, each entry of
/// which is taken over the columns that both rows have.
/// @param dimensions  1 <= q < M.
/// @return `ridge` is the mean of the eigenvalues beyond q, at least least_noise().
LowRankModel pairwise_start(const Features& matrix, Eigen::Index dimensions);

/// How PCA of incomplete data is fitted.
struct RegularisedPcaOptions {
  int dimensions = 10;  ///< q, 1 <= q < M.
  /// Penalty on the squares of W and x, as a share of the largest singular value that the matrix
  /// would have if it were complete, > 0.
  double penalty_share = 0.003;
  double least_fall = 1e-4;  ///< Stop once an iteration reduces the loss by less than this share.
  int max_iterations = 300;  ///< >= 1.
};

/// The plane that fits the observed entries best.
struct RegularisedPca {
  LowRankModel model;
  std::vector<double> losses;    ///< Of each iteration, never rising.
  std::vector<Status> statuses;  ///< kNotConverged if the limit of iterations came first.
};

/// PCA of a matrix with missing entries: least sum over the observed entries of (y - W x - mean)^2
/// + penalty (|W|^2 + |x|^2), by alternating least squares [ilin2010]. Without the penalty, entries
/// that are hardly constrained diverge.
///
/// The penalty is that of the nuclear norm of W X [hastie2015].
/// @param matrix  M x C, every row observed once or more.
/// @throws InvalidInput if the bounds above are broken.
/// @note As costly as ppca(). Deterministic.
RegularisedPca regularised_pca(const Features& matrix, const RegularisedPcaOptions& options = {});

/// How probabilistic PCA is fitted.
struct PpcaOptions {
  int dimensions = 10;  ///< q, 1 <= q < M.
  /// Stop once an iteration raises the log likelihood by less than this for each observed entry,
  /// >= 0.
  double least_rise = 2e-4;
  int max_iterations = 300;  ///< >= 1.
};

/// Columns y = W x + mean + noise with x ~ N(0, I_q) and noise ~ N(0, noise I).
struct Ppca {
  LowRankModel model;            ///< Its ridge is the variance of the noise.
  double log_likelihood = 0.0;   ///< Of the observed entries, under `model`, nats.
  std::vector<double> rises;     ///< Of the log likelihood, an iteration each.
  std::vector<Status> statuses;  ///< kNotConverged if the limit of iterations came first.
};

/// Probabilistic PCA of a matrix with missing entries by EM [tipping1999] [ilin2010]: each column
/// is a sample of M variables, partly observed. Missing entries count as missing at random.
///
/// Every iteration is followed by the change of coordinates that makes the x of all columns white,
/// which leaves fit and likelihood no worse and EM much faster [liu1998].
/// @param matrix  M x C, every row observed once or more.
/// @throws InvalidInput if the bounds above are broken.
/// @note O(E q^2 + C q^3) time an iteration for E observed entries, less where columns show the
///       same rows. Deterministic: it starts from pairwise_start().
Ppca ppca(const Features& matrix, const PpcaOptions& options = {});

/// What replaces missing entries before distances are computed.
enum class Filling {
  kPairwiseComplete,  ///< Nothing: pairwise-complete sums (see proximities).
  kPpca,              ///< Their expectation under probabilistic PCA.
  kPca,               ///< Their position in the plane of PCA with missing data.
  kMean,              ///< The landmark's mean. Fails: it is here for comparison.
};

/// The name used in files and on the command line: "pairwise-complete", "ppca", "pca", "mean".
std::string_view name(Filling filling);

/// The filling of that name; empty if there is none.
std::optional<Filling> filling_named(std::string_view name);

/// How missing data are filled.
struct FillingOptions {
  Filling filling = Filling::kPpca;
  PpcaOptions ppca;
  RegularisedPcaOptions pca;
};

/// Proximities with the model and the statuses of their filling.
struct FilledProximities {
  Proximities proximities;
  std::vector<Status> statuses;
  LowRankModel
      model;  ///< The model of the filling; empty for kPairwiseComplete and without missing data.
};

/// Which squared distances a model of missing data gives.
enum class CompletedDistances {
  kOfFilled,  ///< Those of the filled values.
  /// PPCA: their expectation under the posterior, longer by the variance of what was filled in.
  /// Worse maps resulted: the model's noise is the residual of its few dimensions, and that is much
  /// the same for near landmarks, so that short distances become too long.
  kExpected,
};

/// Proximities of histories whose missing data are filled from a model of them (see features).
/// @note O(E q^2 + C q^3) for E observed entries; kExpected also O(M^2 q) for each column.
Proximities filled_from(const Features& matrix, Sensor sensor, const LowRankModel& model,
                        CompletedDistances distances);

/// Proximities of all pairs of landmarks, co-visible or not, from histories whose missing data are
/// filled. Without missing data, and for kPairwiseComplete, they are those of proximities().
///
/// @param history  Of landmarks that were all observed (see unseen_landmarks), two or more.
/// @param steps    How many observations to use, from the first.
/// @throws InvalidInput if `steps` or the options are out of bounds.
/// @note kPpca, kPca: see there.
FilledProximities filled_proximities(const ObservationHistory& history, Eigen::Index steps,
                                     const FillingOptions& options);

}  // namespace mapproof
