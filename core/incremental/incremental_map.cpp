#include "core/incremental/incremental_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

void grow_square(Eigen::MatrixXd& matrix, Eigen::Index size) {
  const Eigen::Index before = matrix.rows();
  matrix.conservativeResize(size, size);
  matrix.rightCols(size - before).setZero();
  matrix.bottomRows(size - before).setZero();
}

}  // namespace

void IncrementalLog::add(const ScanKey& scan, const std::vector<Detection>& detections) {
  if (scan.robot < 0 || scan.robot > std::ssize(robots_) || !std::isfinite(scan.key))
    throw InvalidInput("robots are numbered as they appear, and their scans need a step or a time");
  if (scan.robot == std::ssize(robots_)) robots_.emplace_back();
  Robot& robot = robots_[static_cast<std::size_t>(scan.robot)];
  if (!robot.keys.empty() && scan.key <= robot.keys.back())
    throw InvalidInput("a robot's scans must be in ascending order");
  for (Detection seen : detections) {
    seen.step = static_cast<int>(robot.keys.size());
    robot.detections.push_back(seen);
  }
  robot.keys.push_back(scan.key);
  ++steps_;
}

DetectionLog IncrementalLog::log(const std::vector<std::string>& names, bool is_timed) const {
  DetectionLog log;
  log.names = names;
  log.scans = scans();
  for (const Robot& robot : robots_) {
    for (Detection seen : robot.detections) {
      seen.step += log.steps;
      log.detections.push_back(seen);
    }
    log.steps += static_cast<int>(robot.keys.size());
    if (is_timed) log.times_s.insert(log.times_s.end(), robot.keys.begin(), robot.keys.end());
  }
  return log;
}

std::vector<ScanKey> IncrementalLog::scans() const {
  std::vector<ScanKey> scans;
  for (std::size_t k = 0; k < robots_.size(); ++k)
    for (const double key : robots_[k].keys) scans.push_back({static_cast<int>(k), key});
  return scans;
}

std::vector<NoticedMove> MovedWatch::check(const IncrementalLog& scans, const DetectionLog& log) {
  ++checks_;
  next_ = log.steps + std::max(1, log.steps / 4);
  MovedOptions options = options_;
  options.level /= static_cast<double>(checks_) * (checks_ + 1);
  const std::vector<ScanKey> all = scans.scans();
  std::vector<NoticedMove> fresh;
  for (const MovedLandmark& found : find_moved(log, options).moved) {
    const NoticedMove now{found, all[static_cast<std::size_t>(found.step)]};
    const auto known = std::ranges::find_if(
        moved_, [&](const NoticedMove& move) { return move.found.landmark == found.landmark; });
    if (known != moved_.end()) {
      *known = now;  // More scans determine the time better.
      continue;
    }
    moved_.push_back(now);
    fresh.push_back(now);
  }
  return fresh;
}

DetectionLog MovedWatch::split(const IncrementalLog& scans, DetectionLog log) const {
  if (moved_.empty()) return log;
  const std::vector<ScanKey> all = scans.scans();
  const bool is_timed = !log.times_s.empty();
  for (const NoticedMove& moved : moved_) {
    const auto fresh = static_cast<int>(log.names.size());
    log.names.push_back(log.names[static_cast<std::size_t>(moved.found.landmark)] + " (moved)");
    for (Detection& seen : log.detections) {
      const ScanKey& scan = all[static_cast<std::size_t>(seen.step)];
      const bool is_later = is_timed ? scan.key >= moved.from.key : scan >= moved.from;
      if (seen.landmark == moved.found.landmark && is_later) seen.landmark = fresh;
    }
  }
  sort_detections(log.detections);
  return log;
}

void PairSums::grow(Eigen::Index landmarks) {
  if (landmarks < landmarks_) throw InvalidInput("sums over pairs cannot lose landmarks");
  landmarks_ = landmarks;
  const Eigen::Index room = products_.rows();
  if (landmarks <= room) return;
  // Twice the room, so that landmarks that arrive one by one do not cost a copy each.
  const Eigen::Index size = std::max(landmarks, 2 * room);
  for (Eigen::MatrixXd* matrix : {&products_, &counts_}) grow_square(*matrix, size);
  if (sensor_ != Sensor::kBearing) grow_square(squares_, size);
  if (sensor_ == Sensor::kRange) grow_square(values_, size);
  first_.conservativeResize(size);
  first_.tail(size - room).setZero();
}

void PairSums::add(const std::vector<StepEntry>& step) {
  std::vector<StepEntry> entries = step;
  std::ranges::sort(entries, {}, &StepEntry::landmark);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    StepEntry& entry = entries[k];
    if (entry.landmark < 0 || entry.landmark >= landmarks() || !std::isfinite(entry.value))
      throw InvalidInput("a step needs finite values of known landmarks");
    if (k > 0 && entries[k - 1].landmark == entry.landmark)
      throw InvalidInput("a step lists a landmark twice");
    if (sensor_ == Sensor::kVisibility && entry.value == 0.0) lists_detections_ = false;
    if (sensor_ != Sensor::kRange) continue;
    const double square = entry.value * entry.value;
    if (counts_(entry.landmark, entry.landmark) == 0.0) first_(entry.landmark) = square;
    entry.value = square - first_(entry.landmark);
  }
  if (sensor_ == Sensor::kBearing)
    add_bearings(entries);
  else
    add_values(entries);
  ++steps_;
}

/// By unit vectors: a sine and a cosine of each, instead of a cosine of each pair.
void PairSums::add_bearings(const std::vector<StepEntry>& entries) {
  std::vector<Eigen::Vector2d> unit;
  unit.reserve(entries.size());
  for (const StepEntry& entry : entries)
    unit.emplace_back(std::cos(entry.value), std::sin(entry.value));
  for (std::size_t b = 0; b < entries.size(); ++b)
    for (std::size_t a = b; a < entries.size(); ++a) {
      products_(entries[a].landmark, entries[b].landmark) += unit[a].dot(unit[b]);
      counts_(entries[a].landmark, entries[b].landmark) += 1.0;
    }
}

void PairSums::add_values(const std::vector<StepEntry>& entries) {
  for (const StepEntry& b : entries)
    for (const StepEntry& a : entries) {
      const Eigen::Index i = a.landmark, j = b.landmark;
      squares_(i, j) += a.value * a.value;
      if (sensor_ == Sensor::kRange) values_(i, j) += a.value;
      if (i < j) continue;
      products_(i, j) += a.value * b.value;
      counts_(i, j) += 1.0;
    }
}

std::vector<Eigen::Index> PairSums::seen() const {
  const Eigen::MatrixXd& reported = sensor_ == Sensor::kVisibility ? products_ : counts_;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < landmarks(); ++i)
    if (reported(i, i) > 0.0) rows.push_back(i);
  return rows;
}

double PairSums::count(Eigen::Index i, Eigen::Index j) const {
  return counts_(std::max(i, j), std::min(i, j));
}

/// Of values less each landmark's mean over all its own steps.
double PairSums::centred_product(Eigen::Index i, Eigen::Index j) const {
  const double product = products_(std::max(i, j), std::min(i, j));
  if (sensor_ != Sensor::kRange) return product;
  const double mean_i = values_(i, i) / count(i, i);
  const double mean_j = values_(j, j) / count(j, j);
  return product - mean_j * values_(i, j) - mean_i * values_(j, i) + count(i, j) * mean_i * mean_j;
}

double PairSums::centred_square(Eigen::Index i, Eigen::Index j) const {
  if (sensor_ == Sensor::kBearing) return count(i, j);
  if (sensor_ == Sensor::kVisibility) return lists_detections_ ? products_(i, i) : squares_(i, j);
  const double mean = values_(i, i) / count(i, i);
  return squares_(i, j) - 2.0 * mean * values_(i, j) + count(i, j) * mean * mean;
}

Proximities PairSums::proximities_of(const std::vector<Eigen::Index>& rows) const {
  const auto n = std::ssize(rows);
  const bool visibility = sensor_ == Sensor::kVisibility;
  Proximities result{.inner_products = Eigen::MatrixXd(n, n),
                     .squared_distances = Eigen::MatrixXd(n, n)};
  if (visibility) result.apart_squared = 2.0;
  for (std::ptrdiff_t b = 0; b < n; ++b)
    for (std::ptrdiff_t a = 0; a < n; ++a) {
      const Eigen::Index i = rows[static_cast<std::size_t>(a)];
      const Eigen::Index j = rows[static_cast<std::size_t>(b)];
      const double common =
          visibility && lists_detections_ ? static_cast<double>(steps_) : count(i, j);
      double product = centred_product(i, j);
      const double square_i = centred_square(i, j), square_j = centred_square(j, i);
      double distance = 0.0;
      if (visibility) {
        product = square_i * square_j > 0.0 ? product / std::sqrt(square_i * square_j) : 0.0;
        distance = 2.0 - 2.0 * product;
      } else {
        const double scale = static_cast<double>(steps_) / std::max(common, 1.0);
        product *= scale;
        distance = scale * (square_i + square_j) - 2.0 * product;
      }
      result.inner_products(a, b) = product;
      result.squared_distances(a, b) = common > 0.0 ? std::max(distance, 0.0) : kInfinity;
    }
  result.squared_distances.diagonal().setZero();
  return result;
}

IncrementalUpdate IncrementalMap::update() const {
  const std::vector<Eigen::Index> seen = sums_.seen();
  IncrementalUpdate result{.embedding = {}, .setting = options_.setting};
  Embedder embedder(seen.empty() ? Proximities{} : sums_.proximities_of(seen), options_.embedder);
  if (!result.setting.parameter) result.setting = embedder.usual_setting(options_.setting.method);
  result.embedding = embedder.embed(result.setting);

  Points all = Points::Constant(landmarks(), 2, kNaN);
  all(seen, Eigen::all) = result.embedding.coordinates;
  result.embedding.coordinates = std::move(all);
  if (std::ssize(seen) < landmarks())
    result.embedding.statuses.push_back(
        status_of<StatusReason::kNotObservedSoFar>(landmarks() - std::ssize(seen), landmarks()));
  if (steps() < kFewestSteps)
    result.embedding.statuses.push_back(status_of<StatusReason::kFewSteps>(steps(), kFewestSteps));
  return result;
}

}  // namespace mapproof
