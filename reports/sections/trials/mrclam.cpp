#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "reports/sections/trials/topic_text.hpp"
#include "reports/sections/trials/trial_means.hpp"

namespace mapproof {
namespace {

std::string mrclam_question(const TrialExperiment&) {
  return "Robots in a hall see landmarks by their barcodes, with range and bearing. How good a map "
         "can be made of these scans alone, without poses or odometry: from which landmarks are "
         "seen together, from bearings, from ranges, from range and bearing together? The scans of "
         "all robots are pooled. Errors are of the landmarks that are not anchors, after the "
         "affine "
         "map to the anchors: the four landmarks furthest out along the diagonals. And if labels "
         "are wrong: can they be found from the scans themselves, and corrected?";
}

double series_value(const TrialPart& part, std::string_view series, std::string_view quantity) {
  const auto trial = std::ranges::find(part.trials, series, &Trial::series);
  return trial == part.trials.end() ? kNaN : trial_value(*trial, quantity);
}

/// "Visibility, ISOMAP (1.46 m)": the best of some series on a set; empty if none has an error.
std::string best_alone(const TrialStudy& study, const TrialPart& part, std::string_view start) {
  const TrialSeries* best = nullptr;
  for (const TrialSeries& series : study.design.series) {
    const double error = series_value(part, series.id, "mpe_m");
    if (!series.id.starts_with(start) || std::isnan(error)) continue;
    if (best == nullptr || error < series_value(part, best->id, "mpe_m")) best = &series;
  }
  return best == nullptr
             ? std::string()
             : fmt::format("{} ({:.3f} m)", best->label, series_value(part, best->id, "mpe_m"));
}

std::vector<std::string> mrclam_conclusions(const TrialStudy& study) {
  std::vector<std::string> sentences;
  for (const TrialPart& part : study.parts) {
    const double error = series_value(part, "pairs", "mpe_m");
    if (std::isnan(error)) {
      sentences.push_back(fmt::format(
          "{}: no error can be determined; {:.0f} landmarks are mapped from range and bearing.",
          part.id, std::max(0.0, series_value(part, "pairs", "mapped"))));
      continue;
    }
    sentences.push_back(
        fmt::format("{}: range and bearing together put the landmarks {:.3f} m off (MPE), {:.3f} m "
                    "after a rigid fit; the error is over distances of pairs, without poses.",
                    part.id, error, series_value(part, "pairs", "rigid_m")));
    std::vector<std::string> others;
    for (const char* start : {"visibility", "bearing", "range"})
      if (const std::string best = best_alone(study, part, start); !best.empty())
        others.push_back(best);
    if (!others.empty())
      sentences.push_back(fmt::format("{}: the best of each sensor alone: {}.", part.id,
                                      listed(others, others.size() + 1)));
    if (const double swapped = series_value(part, "swapped", "mpe_m"); !std::isnan(swapped))
      sentences.push_back(fmt::format(
          "{}: with two landmark IDs swapped in half of the scans the map is {:.3f} m off, "
          "corrected "
          "{:.3f} "
          "m; with a landmark called by another's name in all scans {:.3f} m, corrected {:.3f} m.",
          part.id, swapped, series_value(part, "swapped-corrected", "mpe_m"),
          series_value(part, "misnamed", "mpe_m"),
          series_value(part, "misnamed-corrected", "mpe_m")));
  }
  return sentences;
}

}  // namespace

const TopicWords kMrclamWords = {
    .topic = "mrclam", .question = mrclam_question, .conclusions = mrclam_conclusions};

}  // namespace mapproof
