#include "render/scene/rule_layers.hpp"

#include <algorithm>
#include <cmath>

#include "render/theme/font.hpp"
#include "render/theme/ticks.hpp"

namespace mapproof {
namespace {

// Lengths in em.
constexpr double kTick = 0.3;
constexpr double kLabelGap = 1.0;  // From the axis to the middle of its ticks' labels.
constexpr double kNameGap = 2.3;   // To the middle of its own label, at least.
constexpr double kStep = 0.2;      // In the search for its place.
constexpr double kFarthest = 12.0;
constexpr double kApart = 0.35;  // Least space between texts.

bool overlap(const Box& a, const Box& b) {
  return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

/// From the axis to its labels in the picture: across the axis, on the side of `away`.
Point direction(const Rule& rule, const Projection& project) {
  const Point from = project(rule.from), to = project(rule.to);
  const Point3 middle = (rule.from + rule.to) / 2.0;
  const double step = 1e-3 * (rule.to - rule.from).norm();
  const Point a = project(middle), b = project(middle + step * rule.away.normalized());
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  if (!(length > 1e-9)) return {NAN, NAN};
  Point across{-(to.y - from.y) / length, (to.x - from.x) / length};
  if (across.x * (b.x - a.x) + across.y * (b.y - a.y) < 0.0) across = {-across.x, -across.y};
  return across;
}

Align align_of(Point outward) {
  constexpr double kSlanted = 0.35;
  if (std::abs(outward.x) < kSlanted) return Align::kMiddle;
  return outward.x > 0.0 ? Align::kStart : Align::kEnd;
}

}  // namespace

RuleLayers::Text RuleLayers::text_at(Point at, Point outward, double ems, Align align,
                                     const std::string& text) const {
  const Point place{at.x + ems * em_ * outward.x, at.y + ems * em_ * outward.y};
  const double width = shape_text(text).advance * em_;
  const double before = align == Align::kStart ? 0.0 : align == Align::kMiddle ? width / 2 : width;
  const double gap = kApart / 2.0 * em_;
  const Box box{place.x - before - gap, place.y - em_ / 2.0, place.x - before + width + gap,
                place.y + em_ / 2.0};
  return {place, text, box};
}

bool RuleLayers::is_free(const Box& box) const {
  return std::ranges::none_of(taken_, [&box](const Box& other) { return overlap(box, other); });
}

/// @param feet  Set to where the ticks meet the axis, as many as labels.
std::vector<RuleLayers::Text> RuleLayers::tick_labels(const Rule& rule, Point outward, Align align,
                                                      std::vector<Point>& feet) const {
  constexpr int kMostTicks = 6, kFewestTicks = 2;
  std::vector<Text> texts;
  for (int most = kMostTicks; most >= kFewestTicks; --most) {
    const Ticks ticks = linear_ticks(rule.range.low, rule.range.high,
                                     tick_step(rule.range.low, rule.range.high, most));
    texts.clear();
    feet.clear();
    for (std::size_t i = 0; i < ticks.at.size(); ++i) {
      const double share = (ticks.at[i] - rule.range.low) / (rule.range.high - rule.range.low);
      const Point foot = project_(rule.from + share * (rule.to - rule.from));
      if (!is_finite(foot)) continue;
      feet.push_back(foot);
      texts.push_back(text_at(foot, outward, kLabelGap, align, ticks.labels[i]));
    }
    const auto touch = [](const Text& a, const Text& b) { return overlap(a.box, b.box); };
    if (std::ranges::adjacent_find(texts, touch) == texts.end()) break;
  }
  return texts;
}

std::vector<Layer> RuleLayers::add(const Rule& rule) {
  const Point from = project_(rule.from), to = project_(rule.to);
  const Point outward = direction(rule, project_);
  if (!is_finite(from) || !is_finite(to) || !is_finite(outward)) return {};
  Polyline line{.x = {from.x, to.x}, .y = {from.y, to.y}, .ink = Ink::kText, .width = 0.5};
  Segments marks{.ink = Ink::kText, .width = 0.5};
  Texts texts{.align = align_of(outward)};
  const auto write = [&](const Text& one) {
    if (!is_free(one.box)) return false;
    taken_.push_back(one.box);
    texts.x.push_back(one.at.x);
    texts.y.push_back(one.at.y);
    texts.text.push_back(one.text);
    return true;
  };

  std::vector<Point> feet;
  for (const Text& label : tick_labels(rule, outward, texts.align, feet)) write(label);
  for (const Point& foot : feet) {
    marks.x0.push_back(foot.x);
    marks.y0.push_back(foot.y);
    marks.x1.push_back(foot.x + kTick * em_ * outward.x);
    marks.y1.push_back(foot.y + kTick * em_ * outward.y);
  }
  const Point middle = project_((rule.from + rule.to) / 2.0);
  if (is_finite(middle) && !rule.label.empty())
    for (double ems = kNameGap; ems < kFarthest; ems += kStep)
      if (write(text_at(middle, outward, ems, texts.align, rule.label))) break;
  return {std::move(line), std::move(marks), std::move(texts)};
}

}  // namespace mapproof
