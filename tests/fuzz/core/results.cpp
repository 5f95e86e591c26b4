// Tables of results, their study.json, and maps.
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "core/json/text_input.hpp"
#include "core/records/evaluations/pose_errors_csv.hpp"
#include "core/records/maps/map_csv.hpp"
#include "core/records/maps/map_json.hpp"
#include "core/records/metrics/metrics_json.hpp"
#include "core/records/studies/results_study_json.hpp"
#include "core/records/studies/results_table.hpp"
#include "tests/fuzz/properties.hpp"
#include "tests/fuzz/target.hpp"

namespace mapproof::fuzz {
namespace {

/// A table under the quantities of the dictionary.
void read_results_table(std::string_view bytes) {
  const Quantities quantities;
  round_trip(
      bytes, [&](auto text, auto& source) { return parse_results_csv(text, source, quantities); },
      results_csv);
}

const Added kResultsCsv({.name = "results-csv",
                         .run = read_results_table,
                         .seeds = {"study/results.csv", "slam_study/results.csv"}});
const Added kResultsHead({.name = "results-study",
                          .run = [](auto bytes) { parse_results_study(bytes, kSource); }});

/// A map with its uncertainty.
struct CertainMap {
  MapRecord map;
  std::optional<MapUncertainty> uncertainty;
};

const Added kMap(
    {.name = "map",
     .run =
         [](auto bytes) {
           round_trip(
               bytes,
               [](auto text, auto& source) {
                 return CertainMap{parse_map(text, source), parse_map_uncertainty(text, source)};
               },
               [](const CertainMap& read) { return map_json(read.map, read.uncertainty); });
         },
     .seeds = {"maps"}});
const Added kMapCsv({.name = "map-csv", .run = [](auto bytes) {
                       round_trip(
                           bytes,
                           [](auto text, auto& source) {
                             return parse_map_csv(checked_text(text, source), source);
                           },
                           [](const MapRecord& map) { return map_csv(map); });
                     }});

/// Metrics of other programs: no two of one name, no number beyond the limit.
void read_metrics(std::string_view bytes) {
  const Metrics read = parse_metrics(bytes, kSource, Better::kLower);
  std::set<std::pair<std::string, std::string>> names;
  for (const Metric& metric : read.metrics) {
    if (!names.emplace(metric.suite, metric.name).second)
      found("a metric is there once", metric.name);
    if (std::abs(metric.value) > 1e100) found("a value is within the limit", metric.name);
    quantity_of(metric);
  }
}
const Added kMetrics({.name = "metrics", .run = read_metrics, .seeds = {"metrics"}});

const Added kPoseErrors({.name = "pose-errors", .run = [](auto bytes) {
                           round_trip(
                               bytes,
                               [](auto text, auto& source) {
                                 return parse_pose_errors_csv(checked_text(text, source), source);
                               },
                               pose_errors_csv);
                         }});

}  // namespace
}  // namespace mapproof::fuzz
