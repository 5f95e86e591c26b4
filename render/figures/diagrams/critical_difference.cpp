#include "render/figures/diagrams/critical_difference.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/statistics/nemenyi.hpp"
#include "render/figures/parts.hpp"
#include "render/figures/words.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostMethods = 30;
constexpr double kBarStep = 0.4;  // Between bars, in rows of labels.

void require_consistent(const CriticalDifferenceSpec& spec) {
  const auto refuse = [&spec](const std::string& what) {
    throw InvalidInput("figure " + printable(spec.id) + ": " + what);
  };
  if (spec.methods.size() > kMostMethods) refuse("more than 30 methods");
  if (!(spec.critical_difference > 0.0) || !std::isfinite(spec.critical_difference))
    refuse("the critical difference is not positive");
  for (const RankedMethod& method : spec.methods)
    if (!(method.mean_rank >= 1.0 && method.mean_rank <= static_cast<double>(spec.methods.size())))
      refuse("the mean rank of " + printable(method.label) + " is out of range");
}

/// Draws in rows of labels: 0 is the axis of ranks, labels count downward.
class Diagram {
 public:
  explicit Diagram(const CriticalDifferenceSpec& spec) : spec_(spec), methods_(spec.methods) {
    std::ranges::stable_sort(methods_, {}, &RankedMethod::mean_rank);
    std::vector<double> ranks;
    for (const RankedMethod& method : methods_) ranks.push_back(method.mean_rank);
    groups_ = alike_groups(ranks, spec.critical_difference);
    highest_ = std::max(2.0, static_cast<double>(methods_.size()));
  }

  Panel panel() {
    draw_axis();
    draw_difference();
    for (std::size_t g = 0; g < groups_.size(); ++g) draw_group(g);
    for (std::size_t i = 0; i < methods_.size(); ++i) draw_method(i);
    Panel panel;
    panel.bare = true;
    const double margin = 0.02 * (highest_ - 1.0);
    panel.x.limits = Range{1.0 - margin, highest_ + margin};
    panel.y.limits = Range{-first_row() - static_cast<double>(left_count()) + 0.4, 2.9};
    panel.layers = {lines_, bars_, difference_, open_difference_, dots_, numbers_, left_, right_};
    std::erase_if(panel.layers, is_empty);
    return panel;
  }

  const std::vector<RankedMethod>& methods() const { return methods_; }
  const std::vector<std::vector<int>>& groups() const { return groups_; }

  /// No two mean ranks can then differ by the critical difference.
  bool beyond_axis() const { return 1.0 + spec_.critical_difference > highest_; }

 private:
  void draw_axis() {
    add_line(lines_, {1.0, 0.0}, {highest_, 0.0});
    const int step = highest_ > 16.0 ? 5 : highest_ > 6.0 ? 2 : 1;
    for (int rank = 1; rank <= static_cast<int>(highest_); ++rank) {
      add_line(lines_, {static_cast<double>(rank), 0.0}, {static_cast<double>(rank), 0.25});
      if ((rank - 1) % step == 0)
        add_text(numbers_, {static_cast<double>(rank), 0.75}, std::to_string(rank));
    }
  }

  /// The length of the critical difference above the axis; an arrow if it is longer than the axis.
  void draw_difference() {
    const double end = std::min(1.0 + spec_.critical_difference, highest_);
    add_line(difference_, {1.0, 1.55}, {1.0, 1.85});
    if (beyond_axis()) {
      add_line(open_difference_, {1.0, 1.7}, {end, 1.7});
    } else {
      add_line(difference_, {1.0, 1.7}, {end, 1.7});
      add_line(difference_, {end, 1.55}, {end, 1.85});
    }
    add_text(numbers_, {(1.0 + end) / 2.0, 2.4}, "CD = " + significant(spec_.critical_difference));
  }

  void draw_group(std::size_t g) {
    const double y = -kBarStep * static_cast<double>(g + 1);
    const double reach = 0.008 * (highest_ - 1.0);
    add_line(bars_, {methods_[groups_[g].front()].mean_rank - reach, y},
             {methods_[groups_[g].back()].mean_rank + reach, y});
  }

  /// Down from the axis, then out to the label: the better half to the left.
  void draw_method(std::size_t i) {
    const double rank = methods_[i].mean_rank;
    const bool to_left = i < left_count();
    const auto row = static_cast<double>(to_left ? i : methods_.size() - 1 - i);
    const double y = -first_row() - row;
    add_line(lines_, {rank, 0.0}, {rank, y});
    add_line(lines_, {rank, y}, {to_left ? 1.0 : highest_, y});
    add_point(dots_, {rank, 0.0});
    dots_.marks.push_back({fmt::format("method-{}", i + 1),
                           {{"method", methods_[i].label}, {"rank", data_number(rank)}}});
    const std::string text = fmt::format("{} {:.2f}", methods_[i].label, rank);
    const double side = 0.012 * (highest_ - 1.0);
    if (to_left)
      add_text(left_, {1.0 - side, y}, text);
    else
      add_text(right_, {highest_ + side, y}, text);
  }

  std::size_t left_count() const { return (methods_.size() + 1) / 2; }
  /// Below all bars.
  double first_row() const { return kBarStep * static_cast<double>(groups_.size()) + 0.8; }

  const CriticalDifferenceSpec& spec_;
  std::vector<RankedMethod> methods_;
  std::vector<std::vector<int>> groups_;
  double highest_ = 2.0;
  Segments lines_{.colour = ThemeColour::kText, .width = 0.6};
  Segments bars_{.colour = ThemeColour::kSeries2, .width = 3.0};
  Segments difference_{.colour = ThemeColour::kText};
  Segments open_difference_{.colour = ThemeColour::kText, .arrow = true};
  Scatter dots_{.colour = ThemeColour::kText, .size = 0.7};
  Texts numbers_;
  Texts left_{.align = Align::kEnd};
  Texts right_{.align = Align::kStart};
};

std::string words_of(const Diagram& diagram) {
  std::string text;
  for (const RankedMethod& method : diagram.methods())
    text += fmt::format(" {} {:.2f};", method.label, method.mean_rank);
  if (!text.empty()) text.back() = '.';
  for (const std::vector<int>& group : diagram.groups()) {
    std::vector<std::string> names;
    for (const int i : group) names.push_back(diagram.methods()[i].label);
    text += " No difference between " + listed(names, 12) + ".";
  }
  return text;
}

std::string probability(double p) { return p < 0.001 ? "p < 0.001" : "p = " + significant(p, 2); }

}  // namespace

Figure critical_difference_figure(const CriticalDifferenceSpec& spec) {
  require_consistent(spec);
  Diagram diagram(spec);
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = spec.record_ids;
  figure.panels.push_back(diagram.panel());
  const std::string units = counted(static_cast<std::size_t>(std::max(spec.units, 0)), spec.unit);
  figure.notes.push_back(
      {fmt::format("Mean ranks over {}; Friedman {}.", units, probability(spec.friedman_p))});
  if (spec.friedman_p > spec.alpha)
    figure.notes.push_back({"The Friedman test finds no difference: the bars have no meaning.",
                            ThemeColour::kWarning});
  if (!spec.methods.empty() && diagram.beyond_axis())
    figure.notes.push_back(
        {"CD is longer than the axis (arrow): with so few units no difference is significant.",
         ThemeColour::kWarning});
  if (spec.methods.empty())
    figure.notes.push_back({"There are no methods.", ThemeColour::kWarning});
  figure.caption = fmt::format(
      "Mean ranks of {} over {}, the best to the left. Bars join methods that do not differ: their "
      "ranks are less than the critical difference {} apart (Nemenyi, α = {}). Friedman test: {}.",
      counted(spec.methods.size(), "method"), units, significant(spec.critical_difference),
      data_number(spec.alpha), probability(spec.friedman_p));
  figure.alt = fmt::format("Critical-difference diagram, CD {}. Mean ranks:{}",
                           significant(spec.critical_difference), words_of(diagram));
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
