#include "render/figures/score_text.hpp"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"

namespace mapproof {

std::vector<ErrorWords> error_words(const Score& score) {
  const bool usual = std::isfinite(score.mpe_m);
  const double mpe = usual ? score.mpe_m : score.mpe_all_fitted_m;
  const double moe = usual ? score.moe_percent : score.moe_unmirrored_percent;
  std::vector<ErrorWords> words;
  if (std::isfinite(mpe))
    words.push_back({"MPE", error_text(mpe), "mean position error",
                     usual ? "" : "after the best affine fit to all landmarks"});
  if (std::isfinite(moe))
    words.push_back({"MOE", quantity_text(moe, "%"), "landmark triples with a wrong orientation",
                     usual ? "" : "up to a mirror"});
  return words;
}

std::string score_text(const Score& score) {
  std::string text;
  for (const ErrorWords& error : error_words(score)) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", error.name, error.value);
    if (!error.limit.empty()) text += " " + error.limit;
  }
  return text;
}

std::string title_with_error(const std::string& subject, const std::optional<Score>& score) {
  if (!score) return subject;
  if (std::isfinite(score->mpe_m))
    return fmt::format("{}: {} off in the mean", subject, error_text(score->mpe_m));
  if (std::isfinite(score->mpe_all_fitted_m))
    return fmt::format("{}: {} off after the best affine fit", subject,
                       error_text(score->mpe_all_fitted_m));
  return subject;
}

std::string title_with_error(const std::string& subject, const MapRecord& record) {
  std::string title = title_with_error(subject, record.score);
  if (title != subject) return title;
  if (const auto worst = worst_anchor(record))
    return fmt::format("{}: up to {} off at {} ({})", subject, error_text(worst->error_m),
                       counted(std::ssize(record.anchors), "anchor"), printable(worst->name, 40));
  return subject;
}

std::optional<WorstAnchor> worst_anchor(const MapRecord& record) {
  if (record.frame != Frame::kGroundTruth || !record.ground_truth_m) return std::nullopt;
  const Eigen::VectorXd errors_m = (record.estimate - *record.ground_truth_m).rowwise().norm();
  Eigen::Index worst = -1;
  for (const Eigen::Index anchor : record.anchors)
    if (std::isfinite(errors_m(anchor)) && (worst < 0 || errors_m(anchor) > errors_m(worst)))
      worst = anchor;
  if (worst < 0) return std::nullopt;
  Eigen::Array2d low = record.estimate.row(worst).head<2>().transpose(), high = low;
  for (Eigen::Index i = 0; i < record.estimate.rows(); ++i) {
    const Eigen::Array2d position = record.estimate.row(i).head<2>().transpose();
    if (!position.allFinite()) continue;
    low = low.min(position);
    high = high.max(position);
  }
  const double side_m = (high - low).maxCoeff();
  constexpr double kMost_percent = 10.0;
  WorstAnchor out{.name = record.names[static_cast<std::size_t>(worst)],
                  .error_m = errors_m(worst),
                  .share_percent = side_m > 0.0 ? 100.0 * errors_m(worst) / side_m : kNaN};
  constexpr double kRounding_percent = 1e-7;
  if (record.anchors.size() == 3 && out.share_percent < kRounding_percent) return std::nullopt;
  out.is_contradicted = out.share_percent > kMost_percent;
  return out;
}

}  // namespace mapproof
