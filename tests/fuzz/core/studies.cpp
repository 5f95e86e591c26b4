// Experiments with the methods of others, and the records of studies.
#include "core/external/method_process.hpp"
#include "core/json/record_writer.hpp"
#include "core/records/experiments/experiment_json.hpp"
#include "core/records/experiments/external_methods.hpp"
#include "core/records/experiments/profiles.hpp"
#include "core/records/experiments/slam_experiment_json.hpp"
#include "core/records/studies/run_json.hpp"
#include "core/records/studies/slam_store.hpp"
#include "core/records/studies/study_page.hpp"
#include "core/records/studies/timings_jsonl.hpp"
#include "core/records/studies/topic_json.hpp"
#include "tests/fuzz/properties.hpp"
#include "tests/fuzz/target.hpp"

namespace mapproof::fuzz {
namespace {

/// A target whose records are read by `parse` and written by `write`.
template <typename Parse, typename Write>
Target of_records(std::string name, Parse parse, Write write, std::vector<std::string> seeds = {}) {
  return {.name = std::move(name),
          .run = [=](std::string_view bytes) { round_trip(bytes, parse, write); },
          .seeds = std::move(seeds)};
}

/// An experiment, and each of its profiles.
template <typename Parse, typename Write>
Target of_experiments(std::string name, std::string_view schema, Parse parse, Write write,
                      std::vector<std::string> seeds = {}) {
  return {.name = std::move(name),
          .run =
              [=](std::string_view bytes) {
                round_trip(
                    bytes, [=](auto text, auto& source) { return parse(text, source, ""); }, write);
                for (const std::string& profile : profile_names(bytes, kSource, schema))
                  parse(bytes, kSource, profile);
              },
          .seeds = std::move(seeds)};
}

const Added kExperiment(of_experiments("experiment", "mapproof.experiment", parse_experiment,
                                       experiment_json, {"experiments"}));
const Added kSlamExperiment(of_experiments("experiment-slam", "mapproof.slam_experiment",
                                           parse_slam_experiment, slam_experiment_json));

const Added kMethods(of_records("methods", parse_external_methods,
                                [](const std::vector<ExternalMethod>& methods) {
                                  return to_json_text(ExternalMethodsFile{methods});
                                }));

/// What a method answers is a map of finite positions, or a failure.
void read_reply(std::string_view bytes) {
  static const ExternalRequest request{.id = "run/bearing/10",
                                       .sensor = "bearing",
                                       .steps = 10,
                                       .landmarks = {"a", "b", "c"},
                                       .input = {},
                                       .parameter = {},
                                       .seed = 7};
  const ExternalReply reply = parse_reply(bytes, request);
  if (reply.failure) return;
  if (reply.coordinates.rows() != 3) found("a row for each landmark", "");
  bool has_position = false;
  for (const auto row : reply.coordinates.rowwise()) {
    if (row.array().isInf().any() || row.array().isNaN().any() != row.array().isNaN().all())
      found("a row is a position or none", std::string(bytes));
    has_position = has_position || row.allFinite();
  }
  if (!has_position) found("a map has a position", std::string(bytes));
}
const Added kReply({.name = "method-reply", .run = read_reply});

const Added kStudy(of_records("study", parse_study,
                              [](const Study& study) {
                                return study_json(study.experiment, study.provenance);
                              },
                              {"study/study.json"}));
const Added kRun(of_records("study-run", parse_run, run_json, {"study/runs"}));
const Added kMaps(of_records("study-maps", parse_maps, maps_json, {"study/maps"}));
const Added kDetails(of_records("study-details", parse_details, details_json, {"study/details"}));

const Added kSlamStudy(of_records("slam-study", parse_slam_study,
                                  [](const SlamStudyStart& order) {
                                    return slam_study_json(order.experiment, order.provenance);
                                  },
                                  {"slam_study/study.json"}));
const Added kSlamRun(of_records("slam-run", parse_slam_run, slam_run_json));
const Added kConvergence(of_records("slam-convergence", parse_convergence, convergence_json,
                                    {"slam_study/convergence"}));
const Added kHistories(of_records("slam-histories", parse_range_histories, range_histories_json,
                                  {"slam_study/histories.json"}));
const Added kSpace(of_records("slam-space", parse_space_run, space_run_json,
                              {"slam_study/space.json"}));

const Added kTopicStudy(of_records("topic-study", parse_topic_study, topic_study_json,
                                   {"topic_study/study.json"}));
const Added kTopicPart(of_records(
    "topic-part",
    [](std::string_view text, const std::string& source) {
      return parse_topic_part(text, source, nullptr);
    },
    [](const ReadTopicPart& read) { return topic_part_json(read.part, read.digest); }));

/// A small page may unpack to 64 MB (Unpacker), a larger one to 300 times its size.
const Added kPage({.name = "page",
                   .run =
                       [](std::string_view bytes) {
                         round_trip(bytes, parse_page, [](const PageData& data) {
                           return with_page_data("<!DOCTYPE html>", data);
                         });
                       },
                   .memory = std::size_t{512} << 20,
                   .memory_per_byte = 2000});

std::string lines_of(const Timings& timings) {
  std::string text = timings_header();
  for (const auto& one : timings.maps) text += timing_line(one);
  for (const auto& one : timings.slam.methods) text += timing_line(one);
  for (const auto& one : timings.slam.factorization) text += timing_line(one);
  for (const auto& one : timings.outcomes) text += timing_line(one);
  for (const auto& one : timings.sessions) text += session_line(one);
  return text;
}

const Added kTimings(of_records("timings", parse_timings, lines_of,
                                {"study/timings.jsonl", "slam_study/timings.jsonl",
                                 "topic_study/timings.jsonl"}));

}  // namespace
}  // namespace mapproof::fuzz
