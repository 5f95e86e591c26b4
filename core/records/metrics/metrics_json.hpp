#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/json/fields.hpp"
#include "core/records/studies/quantity_fields.hpp"
#include "core/results/quantity.hpp"

namespace mapproof {

/// The schema of a file of metrics that a program writes for nightly runs.
inline constexpr std::string_view kMetricsSchema = "mapproof.metrics";

/// The most metrics that a file may hold.
inline constexpr std::size_t kMostMetrics = 10'000;

/// One number that another program measured.
struct Metric {
  std::string name = {};   ///< At most 200 characters, none of them hidden.
  std::string suite = {};  ///< What metrics of one kind share; empty: none.
  std::string unit = {};   ///< "ms", "ns/iter"; empty: a count or a ratio.
  double value = 0.0;      ///< NaN: it did not come out.
  Better better = Better::kLower;
};

/// The metrics of one moment.
struct Metrics {
  std::string name = {};        ///< Of the study; empty: the file does not say.
  std::string commit = {};      ///< What was measured; empty: the file does not say.
  std::string repository = {};  ///< Its address, "https://github.com/OWNER/NAME"; may be empty.
  std::vector<Metric> metrics = {};
};

template <typename Visitor>
void fields(Visitor& v, Metric& metric) {
  v.type("metric");
  v.field("name", metric.name, {.not_empty = true, .max_bytes = 800});
  v.field("suite", metric.suite,
          {.description = "What metrics of one kind share.", .max_bytes = 800, .key = Key::kIfAny});
  v.field("unit", metric.unit,
          {.description = "\"ms\"; left out: a count or a ratio.",
           .max_bytes = 100,
           .key = Key::kIfAny});
  v.field("value", metric.value,
          {.description = "null: it did not come out.",
           .minimum = -1e100,
           .maximum = 1e100,
           .nullable = true});
  v.field("better", metric.better,
          {.description = "\"lower\": smaller is better, \"higher\": bigger is better; "
                          "\"neither\" is shown and not judged."});
}

template <typename Visitor>
void fields(Visitor& v, Metrics& metrics) {
  v.file(kMetricsSchema, "Numbers that another program measured: mapproof nightly --metrics.");
  v.field("name", metrics.name,
          {.description = "Of the study, [a-z][a-z0-9-]*; left out: that of the file.",
           .max_bytes = 100,
           .key = Key::kIfAny});
  v.field("commit", metrics.commit,
          {.description = "What was measured, in hexadecimal digits.",
           .max_bytes = 64,
           .key = Key::kIfAny});
  v.field("metrics", metrics.metrics, {.min_items = 1, .max_items = kMostMetrics});
}

/// Reads a file of metrics: of schema mapproof.metrics, of github-action-benchmark (the list that
/// its custom tools read, or its data file, of which the last entry of each suite is taken), of
/// Google Benchmark or of pytest-benchmark (of both the median over the repetitions).
/// @param better  Which way a metric improves of which the file does not say it.
/// @throws IoError with the pointer: also for a metric that is there twice, a name or a unit with
///         hidden characters, a value beyond 1e100, and where `better` is needed and empty.
Metrics parse_metrics(std::string_view text, const std::string& source,
                      std::optional<Better> better);

/// The quantity of a metric: "value" with its unit and direction in the id.
Quantity quantity_of(const Metric& metric);

}  // namespace mapproof
