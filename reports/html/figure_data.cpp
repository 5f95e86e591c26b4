#include "reports/html/figure_data.hpp"

#include <algorithm>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/words.hpp"
#include "reports/html/table_data.hpp"

namespace mapproof {
namespace {

using kainjow::mustache::data;
using kainjow::mustache::list;

constexpr std::size_t kLongCaption = 800;  ///< Longer ones scroll in a box of their own.

/// Drawings stand in a <noscript> element: the script takes them from there as text when they come
/// near, and without a script they are simply shown.
void check_drawing(const std::string& id, const std::string& drawing) {
  if (lower_case(drawing).find("</noscript") != std::string::npos)
    throw InvalidInput("report: the drawing of \"" + id + "\" holds </noscript");
}

/// In the order in which they get room.
std::vector<const FigureBlock*> by_weight(const Report& report) {
  std::vector<const FigureBlock*> all = figures(report);
  const std::vector<std::string>& first = report.opening.figure_ids;
  const auto weight = [&](const FigureBlock* figure) {
    if (std::ranges::find(first, figure->id) != first.end()) return 0;
    return figure->value == "scene" ? 2 : 1;
  };
  std::ranges::stable_sort(all, {}, weight);
  return all;
}

}  // namespace

std::set<std::string> linked_figures(const Report& report, const SvgLookup& svg,
                                     std::size_t drawing_bytes) {
  std::set<std::string> linked;
  if (!svg) return linked;
  std::size_t held = 0;
  for (const FigureBlock* figure : by_weight(report)) {
    const std::size_t bytes = svg(figure->id).size();
    if (held + bytes > drawing_bytes)
      linked.insert(figure->id);
    else
      held += bytes;
  }
  return linked;
}

data figure_data(const FigureBlock& figure, const FigureContext& drawn,
                 const HtmlOptions& options) {
  data out;
  out.set("id", figure.id);
  out.set("title", figure.title);
  out.set("caption", figure.caption);
  out.set("alt", figure.alt);
  out.set("value", figure.value);
  out.set("long", figure.caption.size() > kLongCaption);
  const bool linked = drawn.linked.contains(figure.id);
  const std::string drawing = drawn.svg && !linked ? drawn.svg(figure.id) : "";
  check_drawing(figure.id, drawing);
  out.set("svg", text_or_false(drawing));
  out.set("linked", data(linked));
  out.set("folder", text_or_false(options.figure_folder));
  std::string records;
  for (const std::string& id : figure.record_ids) records += (records.empty() ? "" : "; ") + id;
  out.set("records", text_or_false(records));
  list steps;
  for (const std::string& step : figure.steps) steps.push_back(data("step", step));
  out.set("any_steps", data(!steps.empty()));
  out.set("steps", steps);
  return out;
}

}  // namespace mapproof
