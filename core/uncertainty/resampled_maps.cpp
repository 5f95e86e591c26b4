#include "core/uncertainty/resampled_maps.hpp"

#include <utility>

#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

/// The drawn columns of a matrix that holds one column per step, or two: cosines, then sines.
void draw_columns(const Eigen::MatrixXd& from, Eigen::Index steps,
                  const std::vector<Eigen::Index>& drawn, Eigen::MatrixXd& to) {
  const Eigen::Index parts = from.cols() / steps;
  const auto count = std::ssize(drawn);
  // Eigen frees a matrix before it allocates the larger one: without memory it would free it again.
  if (to.rows() != from.rows() || to.cols() != parts * count) to = Eigen::MatrixXd();
  to.resize(from.rows(), parts * count);
  for (Eigen::Index part = 0; part < parts; ++part)
    for (std::ptrdiff_t k = 0; k < count; ++k)
      to.col(part * count + k) = from.col(part * steps + drawn[static_cast<std::size_t>(k)]);
}

/// Less the mean of each row's observed entries, as features() has it.
void centre(Features& rows) {
  if (rows.observed.size() == 0) {
    const Eigen::VectorXd means = rows.values.rowwise().mean();
    rows.values.colwise() -= means;
    return;
  }
  const Eigen::ArrayXd counts = rows.observed.rowwise().sum().array().max(1.0);
  const Eigen::VectorXd means = rows.values.rowwise().sum().array() / counts;
  rows.values = rows.observed.cwiseProduct(rows.values.colwise() - means);
}

}  // namespace

ResampledMaps::ResampledMaps(const ObservationHistory& history, Eigen::Index steps,
                             EmbedderOptions options, ProximityRule rule)
    : sensor_(history.sensor), steps_(steps), options_(options), rule_(std::move(rule)) {
  require_steps(history, steps);
  if (rule_)
    history_ = history;
  else
    rows_ = features(history, steps);
}

std::vector<Eigen::Index> ResampledMaps::draw(const std::vector<Eigen::Index>& steps) {
  const bool complete = rows_.observed.size() == 0;
  draw_columns(rows_.values, steps_, steps, drawn_.values);
  if (!complete) draw_columns(rows_.observed, steps_, steps, drawn_.observed);
  // Seen as unseen_landmarks() has it: ones of visibility, values of other sensors.
  std::vector<Eigen::Index> seen;
  const bool visibility = sensor_ == Sensor::kVisibility;
  for (Eigen::Index i = 0; i < rows_.values.rows(); ++i)
    if (visibility ? drawn_.values.row(i).sum() > 0.0
                   : complete || drawn_.observed.row(i).sum() > 0.0)
      seen.push_back(i);
  if (std::ssize(seen) < rows_.values.rows()) {
    drawn_.values = Eigen::MatrixXd(drawn_.values(seen, Eigen::all));
    if (!complete) drawn_.observed = Eigen::MatrixXd(drawn_.observed(seen, Eigen::all));
  }
  if (sensor_ == Sensor::kRange) centre(drawn_);
  return seen;
}

std::vector<Points> ResampledMaps::maps_of(const std::vector<Eigen::Index>& drawn,
                                           const std::vector<MethodSetting>& settings) {
  if (rule_) {
    ObservationHistory steps{.sensor = sensor_, .names = history_.names, .values = {}};
    steps.values = history_.values(Eigen::all, drawn);
    HistoryEmbedder embedder(steps, steps.steps(), options_, rule_);
    std::vector<Points> found;
    for (const MethodSetting& setting : settings)
      found.push_back(embedder.embed(setting).coordinates);
    return found;
  }
  const std::vector<Eigen::Index> seen = draw(drawn);
  const Points nowhere = Points::Constant(rows_.values.rows(), 2, kNaN);
  std::vector<Points> maps(settings.size(), nowhere);
  if (seen.empty()) return maps;
  Embedder embedder(proximities(drawn_, sensor_), options_);
  for (std::size_t k = 0; k < settings.size(); ++k)
    maps[k](seen, Eigen::all) = embedder.embed(settings[k]).coordinates;
  return maps;
}

}  // namespace mapproof
