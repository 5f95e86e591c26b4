#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "tests/reports/diff/small_study.hpp"
#include "tests/reports/diff/value_cases.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

const std::vector<Figure>& figures() {
  static const std::vector<Figure> all = SmallStudy().figures();
  return all;
}

/// A change of one figure's value, drawn again.
using FigureChange = std::function<void(Figure&)>;

ValueCase changed_figure(const Figure& figure, const std::string& what, Verdict verdict,
                         std::vector<std::string> cause, const FigureChange& change) {
  return {.name = figure.id + ": " + what,
          .id = figure.id,
          .verdict = verdict,
          .cause = std::move(cause),
          .passes = false,
          .change =
              [figure, change](const fs::path& folder) {
                Figure changed = figure;
                change(changed);
                write_study_figure(changed, report_theme(), folder);
              },
          .alone = true};
}

/// The i-th layer of that kind in the first panel.
template <typename Kind>
Kind& layer(Figure& figure, std::size_t i = 0) {
  for (Layer& layer : figure.panels[0].layers)
    if (Kind* found = std::get_if<Kind>(&layer); found != nullptr && i-- == 0) return *found;
  throw std::out_of_range("no such layer");
}

void add_words(const Figure& figure, std::vector<ValueCase>& cases) {
  const auto style = [&](const std::string& what, std::vector<std::string> cause,
                         const FigureChange& change) {
    cases.push_back(changed_figure(figure, what, Verdict::kStyle, std::move(cause), change));
  };
  style("title", {"title"}, [](Figure& f) { f.title += " again"; });
  style("caption", {"only texts", "caption"}, [](Figure& f) { f.caption += " More."; });
  style("alternative text", {"alternative text"}, [](Figure& f) { f.alt += " More."; });
  style("note", {"note (A note)"}, [](Figure& f) {
    f.notes.push_back({"A note", ThemeColour::kText});
  });
  style("panel title", {"panel 1: title"}, [](Figure& f) { f.panels[0].title = "A panel"; });
  style("x label", {"label of x"}, [](Figure& f) { f.panels[0].x.label += " more"; });
  style("y label", {"label of y"}, [](Figure& f) { f.panels[0].y.label = "other [m]"; });
  style("limits of x", {"limits of x"}, [](Figure& f) { f.panels[0].x.limits = Range{-3, 400}; });
  style("limits of y", {"limits of y"}, [](Figure& f) { f.panels[0].y.limits = Range{-1, 4}; });
  style("ticks", {"ticks of x", "whole numbers"}, [](Figure& f) { f.panels[0].x.whole = true; });
  style("aspect", {"aspect"},
        [](Figure& f) { f.panels[0].equal_aspect = !f.panels[0].equal_aspect; });
  style("bare", {"frame"}, [](Figure& f) { f.panels[0].bare = true; });
}

void add_map_styles(const Figure& figure, std::vector<ValueCase>& cases) {
  const auto style = [&](const std::string& what, std::vector<std::string> cause,
                         const FigureChange& change) {
    cases.push_back(changed_figure(figure, what, Verdict::kStyle, std::move(cause), change));
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const auto name = [&](const char* what) { return fmt::format("{} of scatter {}", what, i); };
    style(name("colour"), {"colour", "series7"},
          [i](Figure& f) { layer<Scatter>(f, i).colour = ThemeColour::kSeries7; });
    style(name("marker"), {"marker", "triangle"},
          [i](Figure& f) { layer<Scatter>(f, i).marker = Marker::kTriangle; });
    style(name("fill"), {"filled"},
          [i](Figure& f) { layer<Scatter>(f, i).filled = !layer<Scatter>(f, i).filled; });
    style(name("size"), {"size"}, [i](Figure& f) { layer<Scatter>(f, i).size *= 1.3; });
    style(name("legend entry dropped"), {"label (was "},
          [i](Figure& f) { layer<Scatter>(f, i).label = ""; });
    style(name("label"), {"label", "other words"},
          [i](Figure& f) { layer<Scatter>(f, i).label = "other words"; });
  }
  style("error colour", {"colour muted"},
        [](Figure& f) { layer<Segments>(f).colour = ThemeColour::kSeries3; });
  style("error dash", {"dash solid \u2192 dashed"},
        [](Figure& f) { layer<Segments>(f).dash = Dash::kDashed; });
  style("error width", {"width"}, [](Figure& f) { layer<Segments>(f).width = 2.0; });
  style("legend order", {"order of layers"}, [](Figure& f) {
    auto& layers = f.panels[0].layers;
    std::swap(layers[1], layers[2]);
  });
}

void add_curve_styles(const Figure& figure, std::vector<ValueCase>& cases) {
  const auto style = [&](const std::string& what, std::vector<std::string> cause,
                         const FigureChange& change) {
    cases.push_back(changed_figure(figure, what, Verdict::kStyle, std::move(cause), change));
  };
  for (std::size_t i = 0; i < 2; ++i) {
    const auto name = [&](const char* what) { return fmt::format("{} of curve {}", what, i); };
    style(name("colour"), {"colour", "series7"},
          [i](Figure& f) { layer<Polyline>(f, i).colour = ThemeColour::kSeries7; });
    style(name("dash"), {"dash", "long-dash"},
          [i](Figure& f) { layer<Polyline>(f, i).dash = Dash::kLongDash; });
    style(name("marker"), {"marker", "plus"},
          [i](Figure& f) { layer<Polyline>(f, i).marker = Marker::kPlus; });
    style(name("width"), {"width 1"}, [i](Figure& f) { layer<Polyline>(f, i).width = 1.7; });
    style(name("legend entry dropped"), {"label (was "},
          [i](Figure& f) { layer<Polyline>(f, i).label = ""; });
    style(name("band colour"), {"band", "colour"},
          [i](Figure& f) { layer<Band>(f, i).colour = ThemeColour::kSeries6; });
  }
  style("scale", {"scale of y", "log"}, [](Figure& f) {
    f.panels[0].y.scale = Scale::kLog;
    f.panels[0].y.limits = Range{0.001, 1.0};
    for (std::size_t i = 0; i < 2; ++i)
      for (double& low : layer<Band>(f, i).low) low = std::max(low, 0.002);
  });
  cases.back().verdict = Verdict::kStyle;
  style("legend order", {"order of layers"}, [](Figure& f) {
    auto& layers = f.panels[0].layers;
    std::swap(layers[layers.size() - 1], layers[layers.size() - 2]);
  });
}

/// The records that a figure names, whether it varies, and numbers in its texts.
void add_records(std::vector<ValueCase>& cases) {
  cases.push_back(changed_figure(figures()[1], "marked as one that varies", Verdict::kChanged,
                                 {"varies from run to run no \u2192 yes"},
                                 [](Figure& f) { f.varies = true; }));
  for (const Figure& figure : figures())
    cases.push_back(changed_figure(figure, "other records", Verdict::kChanged,
                                   {"it shows other records", "layout-9"},
                                   [](Figure& f) { f.record_ids[0] = "layout-9-pose-1/x/y/1"; }));
}

ValueCase unknown_key(const Figure& figure, const std::string& location) {
  return {.name = figure.id + ": an unknown key in " + location,
          .id = figure.id,
          .verdict = Verdict::kUnreadable,
          .cause = {figure.id + ".figure.json", "colour"},
          .passes = false,
          .change =
              [=](const fs::path& folder) {
                const fs::path file = folder / "figures" / (figure.id + ".figure.json");
                auto root = nlohmann::ordered_json::parse(read_file(file));
                root[nlohmann::ordered_json::json_pointer(location)]["colour"] = 1;
                write_file(file, root.dump(1));
              },
          .alone = true};
}

/// Data that change only in the figure, not in its records.
void add_data(std::vector<ValueCase>& cases) {
  const Figure& map = figures()[1];
  const Figure& curve = figures()[2];
  const auto data = [&](const Figure& figure, const std::string& what,
                        std::vector<std::string> cause, const FigureChange& change) {
    cause.emplace_back("its records did not change");
    cases.push_back(changed_figure(figure, what, Verdict::kChanged, std::move(cause), change));
  };
  for (const double moved_m : {0.001, 0.01, 0.041, 0.3})
    data(map, fmt::format("estimate of L7 by {} m", moved_m), {"landmark L7 moved", "px)"},
         [=](Figure& f) { layer<Scatter>(f, 2).y[6] += moved_m; });
  data(map, "a marker lost", {"1 point removed (was landmark L5)"}, [](Figure& f) {
    Scatter& points = layer<Scatter>(f, 2);
    points.x.erase(points.x.begin() + 4);
    points.y.erase(points.y.begin() + 4);
    points.marks.erase(points.marks.begin() + 4);
  });
  data(map, "an error line lost", {"1 point removed (was landmark L2)"}, [](Figure& f) {
    Segments& lines = layer<Segments>(f);
    for (auto* values : {&lines.x0, &lines.y0, &lines.x1, &lines.y1})
      values->erase(values->begin() + 1);
    lines.marks.erase(lines.marks.begin() + 1);
  });
  data(map, "the anchors' layer lost", {"scatter \"anchor\": layer removed"}, [](Figure& f) {
    std::erase_if(f.panels[0].layers, [](const Layer& layer) {
      const auto* points = std::get_if<Scatter>(&layer);
      return points != nullptr && points->label == "anchor";
    });
  });
  // Numbers in texts are data, and so is the name of a landmark.
  const auto turn = [](std::string& text) {
    const std::size_t at = text.find_last_of("0123456789");
    if (at == std::string::npos) throw std::out_of_range("no number in: " + text);
    text[at] = text[at] == '9' ? '1' : static_cast<char>(text[at] + 1);
  };
  data(map, "a number in the alternative text", {"alternative text"},
       [=](Figure& f) { turn(f.alt); });
  data(map, "a number in the caption", {"caption"}, [=](Figure& f) { turn(f.caption); });
  data(curve, "a number in the title", {"title"}, [](Figure& f) { f.title += ", 2"; });
  data(map, "another name of a landmark", {"renamed landmark L5 \u2192 landmark L55"},
       [](Figure& f) {
         for (auto& [key, value] : layer<Scatter>(f, 2).marks[4].data)
           if (key == "landmark") value = "L55";
       });
  data(curve, "a point of a curve", {"point 2 of ISOMAP, K = 6 moved"},
       [](Figure& f) { layer<Polyline>(f, 1).y[1] += 0.004; });
  data(curve, "a point of a curve lost", {"1 point removed"}, [](Figure& f) {
    layer<Polyline>(f, 0).x.pop_back();
    layer<Polyline>(f, 0).y.pop_back();
  });
  data(curve, "a band's end", {"moved"}, [](Figure& f) { layer<Band>(f, 0).high[0] += 0.01; });
  data(curve, "a curve lost", {"layer removed"}, [](Figure& f) {
    std::erase_if(f.panels[0].layers, [](const Layer& layer) {
      const auto* line = std::get_if<Polyline>(&layer);
      return line != nullptr && line->label == "LPCA";
    });
  });
}

}  // namespace

std::vector<ValueCase> figure_cases() {
  std::vector<ValueCase> cases;
  for (const Figure& figure : figures()) add_words(figure, cases);
  add_map_styles(figures()[0], cases);
  add_map_styles(figures()[1], cases);
  add_curve_styles(figures()[2], cases);
  add_data(cases);
  add_records(cases);
  for (const char* location : {"", "/panels/0", "/panels/0/x", "/panels/0/layers/0"})
    cases.push_back(unknown_key(figures()[1], location));
  return cases;
}

}  // namespace mapproof::test
