#include "core/base/text/retired_names.hpp"

#include <algorithm>
#include <array>

namespace mapproof {
namespace {

using enum NameKind;

constexpr std::array kRetired = {
    RetiredName{kOption, "--kind", "--sensor"},
    RetiredName{kOption, "--with-kind", "--with-sensor"},
    RetiredName{kOption, "--true-landmarks", "--ground-truth"},
    RetiredName{kOption, "--ground-truth-landmarks", "--ground-truth"},
    RetiredName{kOption, "--known-landmarks", "--anchors"},
    RetiredName{kOption, "diff --out", "--page"},
    RetiredName{kOption, "--check-labels", "--check-ids"},
    RetiredName{kOption, "--repair-labels", "--repair-ids"},
    RetiredName{kOption, "--labels-unsure", "--uncertain-ids"},
    RetiredName{kOption, "--follow", "--incremental"},
    RetiredName{kValue, "last-good", "last-passing"},
    RetiredName{kValue, "common-steps", "pairwise-complete"},
    RetiredName{kKey, "truth", "ground_truth"},
    RetiredName{kKey, "truth_m", "ground_truth_m"},
    RetiredName{kKey, "readings", "measurements"},
    RetiredName{kKey, "pictures", "images"},
    RetiredName{kKey, "night", "nightly_run"},
    RetiredName{kKey, "nights", "nightly_runs"},
    RetiredName{kKey, "place", "location"},
    RetiredName{kKey, "ink", "colour"},
    RetiredName{kKey, "look", "scan"},
    RetiredName{kKey, "look", "style"},
    RetiredName{kKey, "looks", "scans"},
    RetiredName{kKey, "picture", "image"},
    RetiredName{kKey, "sightings", "detections"},
    RetiredName{kKey, "truth_differs", "ground_truth_differs"},
    RetiredName{kKey, "turn_rad", "rotation_rad"},
    RetiredName{kKey, "turn_rad", "heading_change_rad"},
    RetiredName{kKey, "turn_sigma_rad", "heading_change_sigma_rad"},
    RetiredName{kKey, "trials", "outcomes"},
    RetiredName{kKey, "series", "methods"},
    RetiredName{kKey, "series", "method"},
    RetiredName{kKey, "order_digest", "experiment_digest"},
    RetiredName{kKey, "certainty", "uncertainty"},
    RetiredName{kColumn, "ellipse_turn_deg", "ellipse_rotation_deg"},
    RetiredName{kFormat, "mapproof.trial_experiment", "mapproof.topic_experiment"},
    RetiredName{kFormat, "mapproof.trial_study", "mapproof.topic_study"},
    RetiredName{kFormat, "mapproof.trial_part", "mapproof.topic_part"},
    RetiredName{kFormat, "mapproof.sightings", "mapproof.detections"},
    RetiredName{kExperiment, "labels", "association"},
    RetiredName{kExperiment, "online", "incremental"},
    RetiredName{kExperiment, "certainty", "uncertainty"},
};

}  // namespace

std::span<const RetiredName> retired_names() { return kRetired; }

std::string_view replacement_of(NameKind kind, std::string_view name,
                                std::span<const std::string_view> among) {
  const auto found = std::ranges::find_if(kRetired, [&](const RetiredName& retired) {
    return retired.kind == kind && retired.name == name &&
           (among.empty() || std::ranges::find(among, retired.now) != among.end());
  });
  return found == kRetired.end() ? std::string_view{} : found->now;
}

}  // namespace mapproof
