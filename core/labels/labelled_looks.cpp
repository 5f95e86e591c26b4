#include "core/labels/labelled_looks.hpp"

#include <algorithm>
#include <tuple>

#include "core/base/errors.hpp"

namespace mapproof {

LabelledLooks labelled_looks(const SightingLog& log, int most_blocks) {
  if (most_blocks < 1) throw InvalidInput("a log is cut into one block or more");
  LabelledLooks looks{log, look_pairs(log), {}, {}};
  looks.blocks = cut_in_blocks(log, looks.pairs, 24);
  const int robots = std::max(1, looks.blocks.count / 24);
  looks.blocks = cut_in_blocks(log, looks.pairs, std::max(1, most_blocks / (robots + 1)));
  for (const std::vector<int>& order : looks.blocks.step_orders) {
    std::vector<std::size_t> places(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) places[static_cast<std::size_t>(order[k])] = k;
    looks.places.push_back(std::move(places));
  }
  return looks;
}

StepStretch greatest_sum(std::size_t order, const Eigen::VectorXd& gains) {
  StepStretch best{order, 0, 0};
  double greatest = 0.0;
  double sum = 0.0;
  std::size_t begin = 0;
  for (Eigen::Index k = 0; k < gains.size(); ++k) {
    if (sum <= 0.0) {
      sum = 0.0;
      begin = static_cast<std::size_t>(k);
    }
    sum += gains(k);
    if (sum > greatest) {
      greatest = sum;
      best = {order, begin, static_cast<std::size_t>(k) + 1};
    }
  }
  return best;
}

int other_label(const LabelHypothesis& one, int label) {
  if (label == one.first) return one.second;
  return one.fault == LabelFault::kSwapped && label == one.second ? one.first : label;
}

std::vector<int> mended_labels(const LabelledLooks& looks, std::vector<int> labels,
                               const LabelHypothesis& one, const StepStretch& stretch) {
  const std::vector<std::size_t>& places = looks.places[stretch.order];
  const std::vector<Sighting>& sightings = looks.log.sightings;
  for (std::size_t row = 0, end = 0; row < sightings.size(); row = end) {
    bool taken = false;  // a landmark is seen once in a look
    for (end = row; end < sightings.size() && sightings[end].step == sightings[row].step; ++end)
      taken = taken || labels[end] == one.second;
    const std::size_t place = places[static_cast<std::size_t>(sightings[row].step)];
    if (place < stretch.begin || place >= stretch.end) continue;
    if (taken && one.fault == LabelFault::kWrong) continue;
    for (std::size_t k = row; k < end; ++k) labels[k] = other_label(one, labels[k]);
  }
  return labels;
}

SightingLog relabelled(const SightingLog& log, const std::vector<int>& labels,
                       const std::vector<char>& left_out) {
  SightingLog result = log;
  result.sightings.clear();
  for (std::size_t k = 0; k < labels.size(); ++k) {
    if (!left_out.empty() && left_out[k] != 0) continue;
    result.sightings.push_back(log.sightings[k]);
    result.sightings.back().landmark = labels[k];
  }
  const auto key = [](const Sighting& one) { return std::tuple(one.step, one.landmark); };
  std::ranges::stable_sort(result.sightings, {}, key);
  const auto repeated = std::ranges::unique(result.sightings, {}, key);
  result.sightings.erase(repeated.begin(), repeated.end());
  return result;
}

}  // namespace mapproof
