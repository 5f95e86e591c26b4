#include "reports/sections/findings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/median.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/method_ranks.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostNamed = 4;

std::string percent(double value, int decimals = 2) { return page_number(value, decimals) + " %"; }

std::string relative(double ours, double paper) {
  return page_number(100.0 * (ours - paper) / paper, 1, true) + " %";
}

std::string method_label(Method method) { return std::string(info(method).label); }

std::string with_interval(const MeanEstimate& mpe) {
  const auto interval = interval_of(mpe);
  if (!interval) return error_text(mpe.mean);
  const bool is_great = interval->high > kGreatestError_m;
  // The ends have the decimals of the mean.
  const std::string mean = significant(mpe.mean);
  const std::size_t point = mean.find('.');
  const int decimals = point == std::string::npos ? 0 : static_cast<int>(mean.size() - point - 1);
  const std::string low = number_text(interval->low, decimals);
  return fmt::format(
      "{} (95 % interval {} to {})", error_text(mpe.mean),
      is_great ? error_text(interval->low) : low,
      is_great ? error_text(interval->high) : number_text(interval->high, decimals) + " m");
}

/// " ISOMAP, K = 6 follows with 0.12 m: no significant difference, p = 0.12 over 5 layouts."; empty
/// without a test, and where over the runs that all have another method is the best.
std::string next_words(const SensorComparison& comparison,
                       std::span<const SettingSummary> methods) {
  if (!comparison.paired || !has_groups_for_tests(*comparison.paired)) return "";
  const auto& compared = comparison.paired->methods;
  if (comparison.settings[compared[0].method] != best_of(methods)->setting) return "";
  const MethodSetting& next = comparison.settings[compared[1].method];
  const auto found = std::ranges::find(methods, next, &SettingSummary::setting);
  if (found == methods.end() || !found->mpe_m) return "";
  return fmt::format(" {} follows with {}: {}.", label(next), error_text(found->mpe_m->mean),
                     difference_words(*comparison.paired, "layout"));
}

/// "Bearing: SMACOF, kNN weights, K = 7 is best, …"
Paragraph best_finding(std::span<const SettingSummary> methods,
                       const SensorComparison& comparison) {
  const SettingSummary& best = *best_of(methods);
  Paragraph text;
  text.phrases.push_back(strong(title_of(best.sensor)));
  text.phrases.push_back(phrase(fmt::format(": after {} ", counted(best.step, "observation"))));
  text.phrases.push_back(strong(label(best.setting)));
  text.phrases.push_back(phrase(fmt::format(
      " is the most accurate of {}: MPE {}, MOE {}.", counted(std::ssize(methods), "method"),
      with_interval(*best.mpe_m), percent(best.moe_percent->mean))));
  if (std::string next = next_words(comparison, methods); !next.empty())
    text.phrases.push_back(phrase(std::move(next)));
  if (best.published)
    text.phrases.push_back(
        phrase(fmt::format(" The paper printed {} and {} for this method: ours differs by {}.",
                           error_text(best.published->mpe_m), percent(best.published->moe_percent),
                           relative(best.mpe_m->mean, best.published->mpe_m))));
  const SettingSummary* paper_best = best_published(methods);
  if (paper_best != nullptr && paper_best->setting.method != best.setting.method)
    text.phrases.push_back(phrase(fmt::format(" The paper\u2019s best of these methods is {}, {}.",
                                              label(paper_best->published->setting),
                                              error_text(paper_best->published->mpe_m))));
  return text;
}

/// "a; b; and 3 more": labels hold commas of their own.
std::string in_series(const std::vector<std::string>& items) {
  const std::size_t shown = std::min(items.size(), kMostNamed);
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) text += (i == 0 ? "" : "; ") + items[i];
  if (shown < items.size()) text += fmt::format("; and {} more", items.size() - shown);
  return text;
}

/// How many pairs of methods have the paper's order, and which do not.
/// @param methods  All with a score and a published value that can be matched, by ascending MPE.
std::string pairs_text(const std::vector<SettingSummary>& methods) {
  std::vector<std::string> swapped;
  const std::size_t n = methods.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      if (methods[i].published->mpe_m > methods[j].published->mpe_m)
        swapped.push_back(fmt::format("{} < {}", method_label(methods[j].setting.method),
                                      method_label(methods[i].setting.method)));
  if (swapped.empty()) return " The paper has the same order.";
  const std::size_t pairs = n * (n - 1) / 2;
  return fmt::format(" Of {} of methods, {} have the paper\u2019s order; the paper has {}.",
                     counted(static_cast<long long>(pairs), "pair"), pairs - swapped.size(),
                     in_series(swapped));
}

/// Methods from best to worst, and how far the paper has the same order.
Paragraph order_finding(Sensor sensor, std::vector<SettingSummary> methods) {
  std::erase_if(methods, [](const SettingSummary& s) { return !s.mpe_m; });
  std::ranges::stable_sort(methods, {}, [](const SettingSummary& s) { return s.mpe_m->mean; });
  std::string order;
  for (const SettingSummary& s : methods)
    order += fmt::format("{}{} ({})", order.empty() ? "" : " < ", method_label(s.setting.method),
                         error_text(s.mpe_m->mean));
  Paragraph text{{strong(title_of(sensor)), phrase(", by MPE: " + order + ".")}};
  std::erase_if(methods,
                [](const SettingSummary& s) { return !s.published || !s.published->note.empty(); });
  if (methods.size() >= 2) text.phrases.push_back(phrase(pairs_text(methods)));
  return text;
}

/// How many published values lie within our intervals; those with a note cannot be compared.
Paragraph agreement_finding(Sensor sensor, std::span<const SettingSummary> methods) {
  const PublishedAgreement agreement = agreement_of(methods);
  const SettingSummary* farthest = nullptr;
  const auto gap = [](const SettingSummary& s) {
    return std::abs(mpe_difference_m(s) / s.published->mpe_m);
  };
  for (const SettingSummary& s : methods)
    if (s.published && s.mpe_m && s.published->note.empty() &&
        (farthest == nullptr || gap(s) > gap(*farthest)))
      farthest = &s;
  std::string text = ", compared with the paper: ";
  if (agreement.compared > 0)
    text += fmt::format("{} of {} printed MPE lie within our 95 % intervals; ", agreement.within,
                        agreement.compared);
  if (agreement.apart > 0)
    text += fmt::format("{} left out of this, for reasons under the table; ",
                        counted(agreement.apart, "printed value"));
  if (farthest != nullptr)
    text += fmt::format("the largest difference{} is {} for {} ({}, printed {}).",
                        agreement.apart > 0 ? " of the others" : "",
                        relative(farthest->mpe_m->mean, farthest->published->mpe_m),
                        label(farthest->setting), error_text(farthest->mpe_m->mean),
                        error_text(farthest->published->mpe_m));
  if (text.ends_with("; ")) text.replace(text.size() - 2, 2, ".");
  return {{strong(title_of(sensor)), phrase(text)}};
}

/// "3 of 4 orderings hold: not SDE < SMACOF."
Paragraph ordering_finding(Sensor sensor, std::span<const OrderingClaim> claims) {
  int tried = 0;
  int significant_orderings = 0;
  std::vector<std::string> broken;
  for (const OrderingClaim& claim : claims) {
    if (!claim.difference_m) continue;
    ++tried;
    if (claim.holds() && claim.is_significant()) ++significant_orderings;
    if (!claim.holds())
      broken.push_back(fmt::format("{} < {}", method_label(claim.less), method_label(claim.more)));
  }
  std::string text = fmt::format(
      ": {} of the paper\u2019s {} hold, {} of them with an interval of the difference that leaves "
      "0 out.",
      tried - std::ssize(broken), counted(tried, "ordering"), significant_orderings);
  if (!broken.empty()) text += " Not: " + in_series(broken) + ".";
  return {{strong(title_of(sensor)), phrase(text)}};
}

/// Printed values that stand at another parameter than ours: the two cannot be compared.
std::string other_parameter_words(std::span<const SettingSummary> methods) {
  std::vector<std::string> pairs;
  for (const SettingSummary& one : methods) {
    if (!one.published || !one.mpe_m || one.published->note.empty()) continue;
    if (one.published->setting == one.setting) continue;
    pairs.push_back(fmt::format("{} at {} here, {} at {} in the paper", error_text(one.mpe_m->mean),
                                label(one.setting), error_text(one.published->mpe_m),
                                label(one.published->setting)));
  }
  if (pairs.empty()) return "";
  return ": not to be compared, because the parameters differ and a note says why: " +
         in_series(pairs) + ".";
}

}  // namespace

const SettingSummary* best_published(std::span<const SettingSummary> methods) {
  const SettingSummary* best = nullptr;
  for (const SettingSummary& s : methods)
    if (s.published && (best == nullptr || s.published->mpe_m < best->published->mpe_m)) best = &s;
  return best;
}

std::string optimism_words(const HalfChoices& choices) {
  std::vector<double> shares;
  const HalfChoice* most = nullptr;
  for (const HalfChoice& choice : choices.methods) {
    const double share = optimism_percent(choice);
    if (!choice.has_choice || !std::isfinite(share)) continue;
    shares.push_back(share);
    if (most == nullptr || share > optimism_percent(*most)) most = &choice;
  }
  if (shares.empty()) return "";
  const double largest = optimism_percent(*most);
  if (shares.size() == 1 && std::abs(largest) < 0.05)
    return fmt::format("on runs that had no part in the choice MPE of {} is the same.",
                       method_label(most->method));
  if (shares.size() == 1)
    return fmt::format("on runs that had no part in the choice MPE of {} is {} {}.",
                       method_label(most->method), percent(std::abs(largest), 1),
                       largest < 0.0 ? "lower" : "higher");
  const auto higher = std::ranges::count_if(shares, [](double share) { return share > 0.0; });
  std::string text =
      fmt::format("on runs that had no part in the choice MPE is higher for {} of {}", higher,
                  counted(std::ssize(shares), "method"));
  if (higher > 0)
    text += fmt::format(", most for {}, by {}; the median is {} %", method_label(most->method),
                        percent(largest, 1), format_number(median(shares), 1, true));
  return text + ".";
}

BulletList sensor_findings(const Study& study, const SensorStudy& sensor,
                           std::span<const SettingSummary> methods) {
  const Sensor which = sensor.sensor.sensor;
  BulletList findings;
  findings.items.push_back(best_finding(methods, compare_methods(study, sensor)));
  if (methods.size() > 1)
    findings.items.push_back(order_finding(which, {methods.begin(), methods.end()}));
  if (std::ranges::any_of(methods, [](const SettingSummary& s) { return s.published && s.mpe_m; }))
    findings.items.push_back(agreement_finding(which, methods));
  if (const std::string other = other_parameter_words(methods); !other.empty())
    findings.items.push_back({{strong(title_of(which)), phrase(other)}});
  const std::vector<OrderingClaim> claims = ordering_claims(study, sensor);
  if (std::ranges::any_of(claims,
                          [](const OrderingClaim& c) { return c.difference_m.has_value(); }))
    findings.items.push_back(ordering_finding(which, claims));
  if (const std::string optimism = optimism_words(half_choices(study, sensor)); !optimism.empty())
    findings.items.push_back({{strong(title_of(which)),
                               phrase(": the parameters are chosen by the runs that they are then "
                                      "judged by, as in the paper; " +
                                      optimism)}});
  return findings;
}

}  // namespace mapproof
