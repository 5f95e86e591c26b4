#include "app/nightly/metrics_request.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/sha256.hpp"
#include "core/base/text/slug.hpp"
#include "core/records/metrics/metrics_json.hpp"
#include "core/records/studies/results_study_json.hpp"
#include "core/records/studies/results_table.hpp"
#include "core/records/studies/study_folder.hpp"

namespace mapproof {
namespace {

/// A study's name: of the file's, what ids may hold.
std::string study_name(const Metrics& metrics, const std::string& file) {
  std::string name =
      metrics.name.empty() ? slug_of(std::filesystem::path(file).stem().string()) : metrics.name;
  if (name.empty() || name.front() < 'a') name = "metrics" + (name.empty() ? "" : "-" + name);
  return name;
}

ResultsStudy study_of(const Metrics& metrics, const std::string& name) {
  ResultsStudy study;
  study.name = study.title = name;
  study.question = "Numbers of another program.";
  for (const Metric& metric : metrics.metrics) {
    const Quantity quantity = quantity_of(metric);
    study.results.quantities.declare(quantity);
    if (std::ranges::find(study.quantities, quantity.id) == study.quantities.end())
      study.quantities.push_back(quantity.id);
    study.results.rows.push_back({.at = {.setup = metric.suite},
                                  .method = metric.name,
                                  .quantity = quantity.id,
                                  .value = metric.value});
  }
  return study;
}

}  // namespace

MetricsRequest read_metrics_request(const std::string& file, std::optional<Better> better) {
  const Metrics metrics = parse_metrics(read_file(file), file, better);
  MetricsRequest request{.commit = {metrics.commit, ""}};
  if (const std::string page = page_of_remote(metrics.repository); !page.empty())
    request.commit.repository = page;
  const ResultsStudy study = study_of(metrics, study_name(metrics, file));
  request.study.name = study.name;
  request.study.texts = {{kStudyFile, results_study_json(study)},
                         {"results.csv", results_csv(study.results.rows)}};
  request.study.compared_by = sha256_hex("metrics\n" + study.name);
  request.study.digest = sha256_hex(request.study.texts.at(kStudyFile) + "\n" +
                                    request.study.texts.at("results.csv"));
  const auto negative = std::ranges::find_if(metrics.metrics, [](const Metric& metric) {
    return metric.value < 0.0 && metric.better != Better::kNeither && metric.unit != "%";
  });
  if (negative != metrics.metrics.end())
    request.remarks.push_back(
        fmt::format("{}: \"{}\" is {}: values below 0 are shown and not judged, since metrics are "
                    "judged by ratio",
                    file, printable(negative->name, 40), negative->value));
  return request;
}

}  // namespace mapproof
