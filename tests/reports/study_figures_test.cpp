#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "core/experiment/run.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "reports/sections/figures/method_styles.hpp"
#include "reports/sections/study_report.hpp"
#include "tests/reports/section_text.hpp"
#include "tests/reports/synthetic_study.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

using test::synthetic_study;

/// The ids of a group's figures; empty if there is no such group.
std::vector<std::string> ids_of(const StudyFigures& figures, const std::string& group) {
  std::vector<std::string> ids;
  for (const FigureGroup& candidate : figures.groups)
    if (candidate.id == group)
      for (const Figure& figure : candidate.figures) ids.push_back(figure.id);
  return ids;
}

TEST(StudyFigures, AreTheCurvesOfBothFamiliesAndTheMedianMapOfEachMethod) {
  const Study study = synthetic_study(5, 1);
  const StudyFigures figures = test::synthetic_figures(study);
  EXPECT_EQ(ids_of(figures, "curves"),
            (std::vector<std::string>{"mpe-visibility-global", "mpe-visibility-graph",
                                      "mpe-bearing-global", "mpe-bearing-graph",
                                      "moe-visibility-global", "moe-visibility-graph",
                                      "moe-bearing-global", "moe-bearing-graph"}));
  EXPECT_EQ(ids_of(figures, "maps").back(), "map-bearing-isomap");
  for (const Figure* figure : all_figures(figures))
    if (figure->id == "map-bearing-isomap") {
      EXPECT_EQ(figure->record_ids.front(), "layout-3-pose-1/bearing/isomap-K6/2000");
    }
}

TEST(StudyFigures, DoWithoutMapsThatCannotBeRead) {
  const Study study = synthetic_study(2, 1);
  const StudyFigures figures =
      study_figures(study, {},
                    {.maps = [](const RunId&) { return std::vector<MapRecord>{}; },
                     .details = [](const RunId&) { return std::nullopt; }});
  EXPECT_TRUE(ids_of(figures, "maps").empty());
  EXPECT_FALSE(ids_of(figures, "curves").empty());
  EXPECT_TRUE(ids_of(figures, "cost").empty());
}

Experiment experiment_with_everything() {
  Experiment experiment = test::small_experiment();
  experiment.layouts = 2;
  experiment.poses = 3;
  for (SensorStudy& sensor : experiment.sensors)
    sensor.methods = {{Method::kLpca, {}}, {Method::kIsomap, {5, 6, 7, 8}}};
  experiment.sensors.back().methods[1].parameters.pop_back();  // Three are no curve.
  const MethodSetting isomap{Method::kIsomap, 6.0};
  const auto variation = [&](const char* id, Factor factor, std::vector<double> levels) {
    return Variation{.id = id,
                     .sensor = Sensor::kVisibility,
                     .factor = factor,
                     .levels = std::move(levels),
                     .step = 200,
                     .placement = std::nullopt,
                     .settings = {{Method::kLpca, std::nullopt}, isomap}};
  };
  experiment.variations = {variation("noise", Factor::kNoise, {0.0, 0.1}),
                           variation("anchors", Factor::kAnchors, {3, 4, 6}),
                           variation("together", Factor::kOnlySeenTogether, {0, 1})};
  experiment.variations[2].settings = {{Method::kIsomap, 5.0}, isomap};
  const auto figure = [](const char* id, FigureKind kind) {
    return PaperFigure{.id = id, .kind = kind, .methods = {}, .example = {}};
  };
  experiment.figures = {
      figure("fig-1", FigureKind::kIdea), figure("fig-2", FigureKind::kMeasurement),
      figure("fig-4", FigureKind::kErrorCurve), figure("fig-7", FigureKind::kMap)};
  experiment.figures[2].methods = {Method::kIsomap};
  experiment.figures[3].methods = {Method::kIsomap};
  experiment.figures[3].example = PublishedValue{.setting = isomap, .mpe_m = 0.1};
  return experiment;
}

TEST(StudyFigures, TitlesOfSomeOfTheMethodsSayOfWhich) {
  Experiment experiment = experiment_with_everything();
  experiment.variations.clear();
  experiment.figures.clear();
  experiment.sensors.resize(1);
  experiment.sensors[0].methods.push_back({Method::kLle, {6.0}});
  Study study{.experiment = experiment, .provenance = {}, .runs = {}};
  for (const RunId& id : runs_of(experiment))
    study.runs.push_back(simulate_run(experiment, id).run);
  const StudyFigures figures =
      study_figures(study, {},
                    {.maps = [](const RunId&) { return std::vector<MapRecord>{}; },
                     .details = [](const RunId&) { return std::nullopt; }});
  std::map<std::string, std::string> titles;
  for (const Figure* figure : all_figures(figures)) titles[figure->id] = figure->title;
  const std::string graph = titles.at("mpe-visibility-graph");
  EXPECT_NE(graph.find("of the 2 on a neighbour graph"), std::string::npos) << graph;
  const std::string alone = titles.at("mpe-visibility-global");  // Has no rank.
  EXPECT_EQ(alone.find("lowest"), std::string::npos) << alone;
}

/// How many lines of a figure have the style of one of the mapping methods.
int lines_in_the_style_of_a_method(const Figure& figure) {
  int count = 0;
  for (const Panel& panel : figure.panels)
    for (const Layer& layer : panel.layers)
      if (const auto* line = std::get_if<Polyline>(&layer))
        for (std::size_t i = 0; i < kMethodStyles; ++i) {
          const SeriesStyle style = series_style(i);
          count += line->colour == style.colour && line->dash == style.dash &&
                   line->marker == style.marker;
        }
  return count;
}

TEST(StudyFigures, AreOfEveryKindThatAStudyAllows) {
  Study study{.experiment = experiment_with_everything(), .provenance = {}, .runs = {}};
  std::map<RunId, RunResult> results;
  std::vector<Timing> timings;
  for (const RunId& id : runs_of(study.experiment)) {
    results[id] = simulate_run(study.experiment, id);
    study.runs.push_back(results[id].run);
    timings.insert(timings.end(), results[id].timings.begin(), results[id].timings.end());
  }
  const StudyFigures figures =
      study_figures(study, timings,
                    {.maps = [&](const RunId& run) { return results.at(run).maps; },
                     .details = [&](const RunId& run) { return results.at(run).details; }});
  EXPECT_EQ(ids_of(figures, "observations"), (std::vector<std::string>{"fig-1", "fig-2"}));
  EXPECT_EQ(ids_of(figures, "curves"),
            (std::vector<std::string>{"fig-4", "mpe-visibility-others", "mpe-bearing-global",
                                      "mpe-bearing-graph", "moe-visibility-global",
                                      "moe-visibility-graph", "moe-bearing-global",
                                      "moe-bearing-graph"}));
  EXPECT_EQ(ids_of(figures, "maps"),
            (std::vector<std::string>{"maps-visibility", "errors-visibility", "maps-bearing",
                                      "errors-bearing", "fig-7", "map-visibility-lpca",
                                      "map-visibility-isomap", "map-bearing-lpca",
                                      "map-bearing-isomap"}));
  EXPECT_EQ(ids_of(figures, "forming"),
            (std::vector<std::string>{"forming-visibility", "scatter-visibility", "forming-bearing",
                                      "scatter-bearing"}));
  EXPECT_EQ(ids_of(figures, "parameters"),
            (std::vector<std::string>{"parameter-mpe-visibility-k", "parameter-moe-visibility-k"}));
  EXPECT_EQ(ids_of(figures, "comparison"),
            (std::vector<std::string>{"distances-visibility", "spectrum-visibility",
                                      "distances-bearing", "spectrum-bearing"}))
      << "two methods have no diagram of ranks";
  EXPECT_EQ(ids_of(figures, "conditions"),
            (std::vector<std::string>{"anchors-visibility", "level-noise", "level-together"}));
  for (const Figure* figure : all_figures(figures))
    if (figure->id == "anchors-visibility" || figure->id == "level-together") {
      EXPECT_EQ(lines_in_the_style_of_a_method(*figure), 0) << figure->id;
    }
  EXPECT_EQ(ids_of(figures, "cost"), (std::vector<std::string>{"cost-visibility", "cost-bearing"}));
  for (const Figure* figure : all_figures(figures)) {
    EXPECT_EQ(problem(*figure), "") << figure->id;
    EXPECT_EQ(figure->varies, figure->id.starts_with("cost-")) << figure->id;
    EXPECT_FALSE(figure->alt.empty()) << figure->id;
  }
  const Report report = study_report({study, {}, timings, figures, ""});
  EXPECT_NO_THROW(check(report));
  // Screen readers list sections by their titles.
  std::set<std::string> titles;
  for (const Section& section : report.sections)
    EXPECT_TRUE(titles.insert(section.title).second) << section.title;
  EXPECT_EQ(
      std::ranges::count_if(tables(report),
                            [](const Table* table) { return table->id.starts_with("variation-"); }),
      3);
}

TEST(ShortLabel, KeepsAParameterInOnePiece) {
  EXPECT_EQ(short_label({Method::kSmacofKnn, 7.0}), "SMACOF kNN, K\u00A0=\u00A07");
  EXPECT_EQ(short_label({Method::kLpca, std::nullopt}), "LPCA");
}

const Figure* figure_with_id(const StudyFigures& figures, const std::string& id) {
  for (const Figure* figure : all_figures(figures))
    if (figure->id == id) return figure;
  return nullptr;
}

/// Adds a variation of two levels of noise, on which SMACOF, kNN weights, and ISOMAP are tried.
void add_levels(Study& study) {
  study.experiment.variations = {
      Variation{.id = "noise",
                .sensor = Sensor::kVisibility,
                .factor = Factor::kNoise,
                .levels = {0.0, 0.1},
                .step = 2000,
                .placement = std::nullopt,
                .settings = {{Method::kSmacofKnn, 6.0}, {Method::kIsomap, 6.0}}}};
  const Variation& variation = study.experiment.variations.front();
  for (mapproof::Run& run : study.runs)
    for (const double level : variation.levels)
      for (const MethodSetting& setting : variation.settings) {
        const double mpe = (1.0 + level) * test::synthetic_mpe(setting, run.id, variation.step);
        run.variations.push_back(
            {variation.id, level, setting, {}, Score{mpe, 20.0 * mpe, 0.8 * mpe, 20.0 * mpe}});
      }
}

TEST(StudyFigures, TitlesJudgeByThePairedTestOfTheSentences) {
  // Layouts differ more than these two methods do, of which one is the better in every run.
  Study study = synthetic_study(5, 2);
  add_levels(study);
  const StudyFigures figures = test::synthetic_figures(study);
  for (const auto& [id, words] :
       {std::pair("mpe-visibility-graph",
                  "of the 2 on a neighbour graph, SMACOF kNN has the lowest MPE"),
        {"moe-visibility-graph", "SMACOF kNN has the lowest MOE"},
        {"level-noise", "SMACOF kNN has the lowest MPE throughout"},
        {"cost-visibility", "whatever the time, SMACOF kNN has the lowest MPE"}}) {
    const Figure* figure = figure_with_id(figures, id);
    ASSERT_NE(figure, nullptr) << id;
    EXPECT_NE(figure->title.find(words), std::string::npos) << figure->title;
  }
  const std::string caption = figure_with_id(figures, "ranks-visibility")->caption;
  EXPECT_NE(caption.find("The paired test distinguishes ISOMAP"), std::string::npos) << caption;
  const std::string summary = test::words(summary_section(study));
  EXPECT_NE(summary.find("ISOMAP, K = 6 follows with 0.294"), std::string::npos) << summary;
  EXPECT_NE(summary.find(": a significant difference, p"), std::string::npos) << summary;
}

TEST(StudyFigures, TitlesRankNoMethodThatIsTheBetterInSomeLayoutsAlone) {
  Study study = synthetic_study(5, 2);
  for (mapproof::Run& run : study.runs)
    for (RunRecord& record : run.records)
      if (record.setting.method == Method::kIsomap && record.score) {
        const double mpe = test::synthetic_mpe({Method::kSmacofKnn, 6.0}, run.id, record.step) +
                           (run.id.layout % 2 == 0 ? -0.05 : 0.05);
        record.score = Score{mpe, 20.0 * mpe, 0.8 * mpe, 20.0 * mpe};
      }
  const StudyFigures figures = test::synthetic_figures(study);
  const std::string title = figure_with_id(figures, "mpe-visibility-graph")->title;
  EXPECT_NE(title.find("all of the 2 on a neighbour graph have"), std::string::npos) << title;
  const std::string summary = test::words(summary_section(study));
  EXPECT_NE(summary.find(": no significant difference, p"), std::string::npos) << summary;
}

/// The settings on the cost figure of a sensor.
std::size_t costed(const StudyFigures& figures, const std::string& id) {
  std::size_t count = 0;
  if (const Figure* figure = figure_with_id(figures, id))
    for (const Layer& layer : figure->panels[0].layers)
      if (const auto* points = std::get_if<Scatter>(&layer)) count += points->x.size();
  return count;
}

TEST(StudyFigures, LeaveASettingWhoseStartWasNotTimedOutOfTheCosts) {
  const Study study = synthetic_study(2, 1);
  std::vector<Timing> timings = test::synthetic_timings(study);
  const StudyReader none{.maps = [](const RunId&) { return std::vector<MapRecord>{}; },
                         .details = [](const RunId&) { return std::nullopt; }};
  EXPECT_EQ(costed(study_figures(study, timings, none), "cost-bearing"), 4U);
  std::erase_if(timings,
                [](const Timing& timing) { return timing.setting.method == Method::kSmacof; });
  // Without its start, kNN-weighted SMACOF goes too.
  const StudyFigures figures = study_figures(study, timings, none);
  EXPECT_EQ(costed(figures, "cost-bearing"), 2U);
  const Figure& cost = *figure_with_id(figures, "cost-bearing");
  EXPECT_NE(cost.title.find("timed methods"), std::string::npos) << cost.title;
  ASSERT_EQ(cost.notes.size(), 1U);
  EXPECT_TRUE(cost.notes[0].text.starts_with("Not timed, and not shown: SMACOF and SMACOF kNN"))
      << cost.notes[0].text;
}

TEST(StudyFigures, CostOfALoneSettingHoldsItsStart) {
  const Study study = synthetic_study(2, 1);
  const std::vector<Timing> all = test::synthetic_timings(study);
  const StudyReader none{.maps = [](const RunId&) { return std::vector<MapRecord>{}; },
                         .details = [](const RunId&) { return std::nullopt; }};
  std::set<double> parameters;
  for (const Timing& timing : all)
    if (timing.setting.method == Method::kSmacofKnn) parameters.insert(*timing.setting.parameter);
  ASSERT_GT(parameters.size(), 1U);
  int shown = 0;
  for (const double kept : parameters) {
    std::vector<Timing> timings = all;
    std::erase_if(timings, [&](const Timing& timing) {
      const MethodSetting& setting = timing.setting;
      return setting.method == Method::kSmacof ||
             (setting.method == Method::kSmacofKnn && *setting.parameter != kept);
    });
    if (costed(study_figures(study, timings, none), "cost-bearing") == 3U) ++shown;
  }
  EXPECT_EQ(shown, 1) << "with the best parameter alone";
}

TEST(StudyFigures, RankThreeMethodsOrMore) {
  Study study = synthetic_study(5, 2);
  const StudyReader none{.maps = [](const RunId&) { return std::vector<MapRecord>{}; },
                         .details = [](const RunId&) { return std::nullopt; }};
  EXPECT_NE(figure_with_id(study_figures(study, {}, none), "ranks-visibility"), nullptr);
  for (mapproof::Run& run : study.runs)
    std::erase_if(run.records, [](const RunRecord& record) {
      return record.setting.method != Method::kLpca && record.setting.method != Method::kIsomap;
    });
  EXPECT_EQ(figure_with_id(study_figures(study, {}, none), "ranks-visibility"), nullptr);
}

TEST(StudyFigures, CostOfOneMethodIsNoFigure) {
  const Study study = synthetic_study(2, 1);
  std::vector<Timing> timings = test::synthetic_timings(study);
  std::erase_if(timings,
                [](const Timing& timing) { return timing.setting.method != Method::kIsomap; });
  const StudyReader none{.maps = [](const RunId&) { return std::vector<MapRecord>{}; },
                         .details = [](const RunId&) { return std::nullopt; }};
  EXPECT_EQ(figure_with_id(study_figures(study, timings, none), "cost-bearing"), nullptr);
}

TEST(SeriesOfMethod, KeepsColoursOfOneFamilyApart) {
  Experiment experiment;
  for (const bool graph : {false, true}) {
    std::set<ThemeColour> colours;
    for (const MethodInfo& method : all_methods())
      // One more than there are colours; it is compared with the methods of the topic references.
      if (on_graph(method.method) == graph && method.method != Method::kLandmarkMvu) {
        const ThemeColour colour = series_style(series_of_method(experiment, method.method)).colour;
        EXPECT_TRUE(colours.insert(colour).second) << method.name;
      }
  }
  using enum Method;
  for (const std::vector<Method>& of_figure :
       {std::vector{kLpca, kSmacof, kSmacofKnn, kKpcaGaussian, kKpcaPolynomial},  // Fig. 4
        std::vector{kIsomap, kLle, kLaplacianEigenmap, kHessianLle, kSde},        // Fig. 5
        std::vector{kLpca, kSmacof, kSmacofKnn, kIsomap, kLle, kLaplacianEigenmap, kSde},
        std::vector{kIsomap, kSde, kLandmarkIsomap, kLandmarkMvu}}) {  // The topic references.
    std::set<ThemeColour> colours;
    for (const Method method : of_figure)
      colours.insert(series_style(series_of_method(experiment, method)).colour);
    EXPECT_EQ(colours.size(), of_figure.size());
  }
  std::set<std::size_t> series;
  for (const MethodInfo& method : all_methods())
    if (!method.approximates) series.insert(series_of_method(experiment, method.method));
  EXPECT_EQ(*series.rbegin(), series.size() - 1);
  add_external_methods(experiment,
                       {{.name = "umap", .label = "UMAP"}, {.name = "b", .label = "B"}});
  EXPECT_EQ(series_of_method(experiment, method_of(experiment.external_methods[1])),
            series.size() + 1);
}

}  // namespace
}  // namespace mapproof
