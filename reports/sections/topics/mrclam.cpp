#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/figures/map_walls.hpp"
#include "reports/sections/topics/topic_means.hpp"
#include "reports/sections/topics/topic_text.hpp"

namespace mapproof {
namespace {

std::string mrclam_question(const TopicExperiment&) {
  return "Robots in a hall see landmarks by their barcodes, with range and bearing. How good a map "
         "can be made of these scans alone, without poses or odometry: from which landmarks are "
         "seen together, from bearings, from ranges, from range and bearing together? The scans of "
         "all robots are pooled. Errors are of the landmarks that are not anchors, after the "
         "affine map to the anchors: the four landmarks furthest out along the diagonals. And if "
         "landmark IDs are wrong: can they be found from the scans themselves, and corrected?";
}

double method_value(const TopicPart& part, std::string_view method, std::string_view quantity) {
  const auto outcome = std::ranges::find(part.outcomes, method, &TopicOutcome::method);
  return outcome == part.outcomes.end() ? kNaN : topic_value(*outcome, quantity);
}

/// "Visibility, ISOMAP (1.46 m)": the best of some methods on a set; empty if none has an error.
std::string best_alone(const TopicStudy& study, const TopicPart& part, std::string_view start) {
  const StudiedMethod* best = nullptr;
  for (const StudiedMethod& method : study.design.methods) {
    const double error = method_value(part, method.id, "mpe_m");
    if (!method.id.starts_with(start) || std::isnan(error)) continue;
    if (best == nullptr || error < method_value(part, best->id, "mpe_m")) best = &method;
  }
  return best == nullptr ? std::string()
                         : fmt::format("{} ({})", best->label,
                                       error_text(method_value(part, best->id, "mpe_m")));
}

std::vector<std::string> mrclam_conclusions(const TopicStudy& study) {
  std::vector<std::string> sentences;
  for (const TopicPart& part : study.parts) {
    const auto metres_of = [&part](const char* method) {
      return error_text(method_value(part, method, "mpe_m"));
    };
    const double error = method_value(part, "pairs", "mpe_m");
    if (std::isnan(error)) {
      sentences.push_back(fmt::format(
          "{}: no error can be determined; {:.0f} landmarks are mapped from range and bearing.",
          part.id, std::max(0.0, method_value(part, "pairs", "mapped"))));
      continue;
    }
    sentences.push_back(fmt::format(
        "{}: range and bearing together put the landmarks {} off (MPE), {} "
        "after a rigid fit; the error is over distances of pairs, without poses.",
        part.id, error_text(error), error_text(method_value(part, "pairs", "rigid_m"))));
    std::vector<std::string> others;
    for (const char* start : {"visibility", "bearing", "range"})
      if (const std::string best = best_alone(study, part, start); !best.empty())
        others.push_back(best);
    if (!others.empty())
      sentences.push_back(fmt::format("{}: the best of each sensor alone: {}.", part.id,
                                      listed(others, others.size() + 1)));
    if (const double swapped = method_value(part, "swapped", "mpe_m"); !std::isnan(swapped))
      sentences.push_back(fmt::format(
          "{}: with two landmark IDs swapped in half of the scans the map is {} off, "
          "corrected {}; with one landmark under another's ID in all scans {}, corrected {}.",
          part.id, error_text(swapped), metres_of("swapped-corrected"), metres_of("misnamed"),
          metres_of("misnamed-corrected")));
  }
  return sentences;
}

/// Whether the map of a set cannot be used: a quarter of its landmark triples and more are turned
/// the wrong way round, where half are by chance.
bool is_unusable(const TopicPart& part) {
  return method_value(part, "pairs", "moe_percent") > kMostTurned_percent;
}

std::vector<std::string> mrclam_warnings(const TopicStudy& study) {
  std::vector<std::string> sentences;
  for (const TopicPart& part : study.parts) {
    const double given = method_value(part, "pairs", "mpe_m");
    const double corrected = method_value(part, "swapped-corrected", "mpe_m");
    if (is_unusable(part))
      sentences.push_back(fmt::format("no usable map of {}: MOE {:.0f} %, where 50 % are chance",
                                      part.id, method_value(part, "pairs", "moe_percent")));
    // The correction puts right what the log itself holds, besides what was exchanged in the copy.
    else if (corrected < 0.5 * given)
      sentences.push_back(fmt::format(
          "barcodes of {} are exchanged in the log itself: {} off as given, {} with landmark IDs "
          "corrected",
          part.id, error_text(given), error_text(corrected)));
  }
  return sentences;
}

/// "0.0641 m to 1.15 m"
std::string range_of(const std::vector<double>& errors_m) {
  const auto [least, most] = std::ranges::minmax(errors_m);
  return error_text(least) + (least < most ? " to " + error_text(most) : "");
}

TopicHeadline mrclam_headline(const TopicStudy& study) {
  const auto failed = std::ranges::count_if(study.parts, is_unusable);
  const bool none_usable = failed == std::ssize(study.parts);
  std::vector<double> together, alone;
  for (const TopicPart& part : study.parts) {
    const double error = method_value(part, "pairs", "mpe_m");
    if (std::isnan(error) || (is_unusable(part) && !none_usable)) continue;
    together.push_back(error);
    double least = HUGE_VAL;
    for (const StudiedMethod& method : study.design.methods)
      for (const char* start : {"visibility", "bearing", "range"})
        if (const double single = method_value(part, method.id, "mpe_m");
            method.id.starts_with(start) && single < least)
          least = single;
    if (std::isfinite(least)) alone.push_back(least);
  }
  if (together.empty()) return {};
  return {range_of(together),
          failed == 0 || none_usable ? "MPE from range and bearing together"
                                     : "MPE of usable maps from range and bearing together",
          alone.empty() ? "" : "by the best single sensor " + range_of(alone),
          failed == 0
              ? fmt::format("usable on all of {}", counted(std::ssize(together), "data set"))
              : fmt::format("no usable map of {} of {}", failed,
                            counted(std::ssize(study.parts), "data set")),
          failed > 0,
          "mpe_m"};
}

}  // namespace

const TopicWords kMrclamWords = {.topic = "mrclam",
                                 .question = mrclam_question,
                                 .compared_with = "the best single sensor",
                                 .conclusions = mrclam_conclusions,
                                 .headline = mrclam_headline,
                                 .warnings = mrclam_warnings};

}  // namespace mapproof
