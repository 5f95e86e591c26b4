#include <utility>

#include <fmt/format.h>

#include "app/result_json.hpp"
#include "app/study/folder_report.hpp"
#include "app/study/study_outputs.hpp"
#include "core/records/studies/results_of.hpp"
#include "core/records/studies/study_store.hpp"
#include "core/records/studies/topic_store.hpp"
#include "reports/sections/opening.hpp"
#include "reports/sections/results/results_figures.hpp"
#include "reports/sections/results/results_report.hpp"
#include "reports/sections/results/topic_records.hpp"
#include "reports/sections/topics/topic_text.hpp"

namespace mapproof {
namespace {

/// Data sets are distinguished; simulated runs are repeats.
std::vector<std::string> parts_apart(const TopicStudy& study) {
  std::vector<std::string> parts;
  for (const DataSet& set : study.experiment.data) parts.push_back(set.id);
  return parts.empty() ? std::vector<std::string>{""} : parts;
}

nlohmann::ordered_json mean_values(const TopicStudy& study, const ResultsView& view,
                                   const Condition& at, const ResultsLine& line) {
  nlohmann::ordered_json result{{"setup", at.setup.get()},
                                {"method", line.method},
                                {"levels", nlohmann::ordered_json::object()}};
  for (const Level& level : at.levels)
    result["levels"][level.factor] = number_or_null(std::get<double>(level.value));
  if (!line.run.empty()) result["part"] = line.run;
  for (const Quantity& quantity : study.design.quantities) {
    const auto mean = view.mean(at, line, quantity);
    result[quantity.id] = mean ? number_or_null(mean->mean) : nlohmann::ordered_json(nullptr);
  }
  return result;
}

/// Methods are compared by what the design judges them by first; by all of it would be too much.
/// Few groups show nothing about chance.
std::vector<MethodComparison> compare_series(const ResultsView& view) {
  std::vector<MethodComparison> comparisons = compare_methods(view);
  std::erase_if(comparisons, [&](const MethodComparison& comparison) {
    return !has_groups_for_tests(comparison) ||
           comparison.quantity->id != view.study().quantities.front();
  });
  return comparisons;
}

nlohmann::ordered_json topic_object(const TopicStudy& study) {
  nlohmann::ordered_json object{
      {"experiment", study.experiment.name},  {"topic", study.experiment.topic},
      {"seed", study.experiment.seed},        {"parts", study.parts.size()},
      {"conclusions", conclusions_of(study)}, {"results", nlohmann::ordered_json::array()}};
  const ResultsStudy labelled = labelled_results(study);
  const ResultsView view(labelled);
  const auto add = [&](const Condition& at, const ResultsLine& line) {
    if (view.statuses(at, line).runs > 0)
      object["results"].push_back(mean_values(study, view, at, line));
  };
  for (const TopicSetup& setup : study.design.setups)
    for (std::size_t i = 0; i < study.design.methods.size(); ++i)
      for (const Condition& at : conditions_of(setup))
        for (const std::string& part : parts_apart(study))
          add(at, {.method = study.design.methods[i].id, .run = part, .label = {}, .index = i});
  return object;
}

std::string topic_text(const TopicStudy& study) {
  std::string text;
  for (const std::string& conclusion : conclusions_of(study)) text += conclusion + "\n";
  return text;
}

/// Whether the number is as it should be, then what it is compared with.
std::string judged_detail(const TopicHeadline& headline) {
  if (headline.verdict.empty() || headline.detail.empty())
    return headline.verdict + headline.detail;
  return headline.verdict + "; " + headline.detail;
}

std::vector<std::string> warnings_and_shortfall(const TopicStudy& study,
                                                const TopicHeadline& headline) {
  std::vector<std::string> warnings = warnings_of(study);
  if (warnings.empty() && headline.falls_short && !headline.verdict.empty())
    warnings.push_back(headline.verdict);
  return warnings;
}

FolderReport topic_report(const std::filesystem::path& folder, const std::string& command) {
  const TopicStudy study = read_topic_study(folder);
  const std::vector<Session> sessions = read_sessions(folder);
  ResultsStudy labelled = labelled_results(study);
  labelled.question = question_of(study.experiment);
  const ResultsView view(labelled);
  const std::vector<MethodComparison> comparisons = compare_series(view);
  StudyFigures figures = results_figures(view, comparisons);
  FigureGroup maps = topic_maps(study, labelled.name);
  if (!maps.empty()) figures.groups.push_back(std::move(maps));
  const TopicHeadline headline = headline_of(study);
  std::vector<std::string> headline_figures;
  if (FigureGroup evidence = topic_evidence(study, labelled, headline); !evidence.empty()) {
    headline_figures.push_back(evidence.figures.front().id);
    figures.groups.insert(figures.groups.begin(), std::move(evidence));
  } else if (!headline.quantity.empty()) {
    headline_figures = figures_of_quantity(view, headline.quantity);
  }
  ResultsReportInput input{.view = view,
                           .comparisons = comparisons,
                           .figures = figures,
                           .provenance = topic_provenance(study, sessions, command, labelled.name),
                           .conclusions = conclusions_of(study),
                           .compared_with = std::string(compared_with_of(study.experiment)),
                           .headline = Highlights::Item{.label = headline.label,
                                                        .value = headline.value,
                                                        .detail = judged_detail(headline),
                                                        .falls_short = headline.falls_short},
                           .headline_figures = std::move(headline_figures),
                           .incomplete = topic_incomplete(study),
                           .warnings = warnings_and_shortfall(study, headline),
                           .footer = fmt::format("Made by mapproof {} ({}).",
                                                 study.provenance.version, study.provenance.commit),
                           .date = date_of(sessions)};
  if (auto seconds = topic_seconds_table(study, labelled.name))
    input.cost.push_back(*std::move(seconds));
  FolderReport result{
      .folder = folder,
      .origin = StudyOrigin::kTopic,
      .report = results_report(input),
      .in_company = results_sections(input),
      .group = labelled.title,
      .runs = study.parts.size(),
      .reached_aim = headline.verdict.empty() ? std::nullopt : std::optional(!headline.falls_short),
      .incomplete = input.incomplete};
  add_images(figures, result);
  return result;
}

StudyNumbers topic_numbers(const std::filesystem::path& folder) {
  const TopicStudy study = read_topic_study(folder);
  return {.text = topic_text(study), .object = topic_object(study)};
}

}  // namespace

const StudyOutputs kTopicOutputs = {
    .study = "mapproof.topic_study", .report = topic_report, .numbers = topic_numbers};

}  // namespace mapproof
