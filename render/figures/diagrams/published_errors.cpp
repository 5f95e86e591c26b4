#include "render/figures/diagrams/published_errors.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/parts.hpp"
#include "render/figures/words.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kLongestMethodLabel = 30;  ///< Characters; the rest of a name is cut.

bool is_drawn(double error_m) { return std::isfinite(error_m) && error_m > 0.0; }

/// Those that a logarithmic axis takes, the greatest error first: row 0 is lowest.
std::vector<PublishedError> drawn_methods(const PublishedErrorsSpec::Sensor& sensor) {
  std::vector<PublishedError> methods;
  for (PublishedError method : sensor.methods) {
    if (!is_drawn(method.mean_m)) continue;
    if (method.published_m && !is_drawn(*method.published_m)) method.published_m.reset();
    methods.push_back(std::move(method));
  }
  std::ranges::stable_sort(methods, std::greater<>(), &PublishedError::mean_m);
  return methods;
}

/// How the published errors lie to our intervals.
struct Agreement {
  std::ptrdiff_t compared = 0;  ///< Methods with an interval and a published error.
  std::ptrdiff_t within = 0;
  std::ptrdiff_t ours_smaller = 0;  ///< Of those outside.
};

Agreement agreement_of(const std::vector<PublishedErrorsSpec::Sensor>& sensors) {
  Agreement all;
  for (const PublishedErrorsSpec::Sensor& sensor : sensors)
    for (const PublishedError& method : sensor.methods) {
      if (!method.interval || !method.published_m) continue;
      ++all.compared;
      if (*method.published_m > method.interval->high)
        ++all.ours_smaller;
      else if (*method.published_m >= method.interval->low)
        ++all.within;
    }
  return all;
}

std::string title_of(const Agreement& all) {
  if (all.compared == 0) return "Errors of the methods, ours and published";
  return fmt::format("{} of {} published errors lie within our 95 % intervals", all.within,
                     all.compared);
}

std::string note_of(const Agreement& all) {
  const std::ptrdiff_t outside = all.compared - all.within;
  if (outside == 0) return "";
  if (all.ours_smaller == outside)
    return outside == 1 ? "In the other one our error is smaller."
                        : fmt::format("In the other {} our error is smaller.", outside);
  return fmt::format("Of the other {}, our error is smaller in {} and larger in {}.", outside,
                     all.ours_smaller, outside - all.ours_smaller);
}

Mark mark_of(const PublishedError& method, std::size_t panel, const char* whose, double error_m) {
  return {fmt::format("{}-{}-{}", whose, panel, method.key),
          {{"method", method.label}, {"mpe", data_number(error_m)}}};
}

void add_panel(Figure& figure, const PublishedErrorsSpec::Sensor& sensor) {
  const std::vector<PublishedError> methods = drawn_methods(sensor);
  const std::size_t number = figure.panels.size();
  Panel& panel = figure.panels.emplace_back();
  panel.title = sensor.title;
  panel.x = {.label = "MPE [m]", .scale = Scale::kLog};
  panel.y = {.label = ""};
  panel.y.limits = Range{-0.6, std::max(1.0, static_cast<double>(methods.size())) - 0.4};
  Segments intervals{.label = "95 % interval", .colour = ThemeColour::kSeries1, .width = 2.5};
  Scatter ours{.label = "ours", .colour = ThemeColour::kSeries1, .marker = Marker::kCircle};
  Scatter published{.label = "published",
                    .colour = ThemeColour::kSeries2,
                    .marker = Marker::kDiamond,
                    .filled = false,
                    .size = 1.3};
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const PublishedError& method = methods[i];
    const double y = static_cast<double>(i);
    panel.y.names.push_back(printable(method.label, kLongestMethodLabel));
    if (method.interval && is_drawn(method.interval->low))
      add_line(intervals, {method.interval->low, y}, {method.interval->high, y});
    add_point(ours, {method.mean_m, y});
    ours.marks.push_back(mark_of(method, number, "ours", method.mean_m));
    if (!method.published_m) continue;
    add_point(published, {*method.published_m, y});
    published.marks.push_back(mark_of(method, number, "published", *method.published_m));
  }
  panel.layers = {intervals, ours, published};
  std::erase_if(panel.layers, is_empty);
}

}  // namespace

Figure published_errors_figure(const PublishedErrorsSpec& spec) {
  const Agreement agreement = agreement_of(spec.sensors);
  Figure figure;
  figure.id = spec.id;
  figure.title = title_of(agreement);
  if (const std::string note = note_of(agreement); !note.empty()) figure.notes.push_back({note});
  figure.record_ids = spec.record_ids;
  std::vector<std::string> sources, errors;
  for (const PublishedErrorsSpec::Sensor& sensor : spec.sensors) {
    add_panel(figure, sensor);
    sources.push_back(sensor.source);
    for (const PublishedError& method : sensor.methods)
      if (method.published_m)
        errors.push_back(fmt::format("{} {} (published {})", method.label,
                                     significant(method.mean_m, 3),
                                     significant(*method.published_m, 3)));
  }
  figure.caption = fmt::format(
      "Mean position error (MPE) of each method at its best parameter, with the 95 % interval of "
      "the mean, and the error printed in {}, which may belong to another parameter. The methods "
      "are in the order of our errors.",
      listed(sources, 4));
  figure.alt = fmt::format("MPE in metres, ours and published: {}.",
                           errors.empty() ? "none" : listed(errors, 12));
  figure.shared_x = figure.panels.size() > 1;
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
