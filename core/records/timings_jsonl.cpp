#include "core/records/timings_jsonl.hpp"

#include <limits>
#include <system_error>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/json/json_text.hpp"
#include "core/json/text_input.hpp"
#include "core/records/json_values.hpp"
#include "core/records/slam_values.hpp"

namespace mapproof {
namespace {

constexpr std::string_view kTimingsSchema = "mapproof.timings";
constexpr double kLongest_s = std::numeric_limits<double>::max();

Timing read_timing(const JsonCursor& value) {
  std::vector<std::string_view> keys = {"kind", "layout", "pose", "sensor", "step", "seconds"};
  Timing timing;
  timing.setting = read_setting(value, keys);
  value.allow_only(keys);
  timing.run = {.layout = value.at("layout").integer32(1, kMostLayouts),
                .pose = value.at("pose").integer32(1, kMostPoses)};
  timing.sensor = read_sensor(value.at("sensor"));
  timing.step = value.at("step").integer32(0, kMostSteps);
  timing.seconds = value.at("seconds").number(0.0, kLongest_s);
  return timing;
}

SlamTiming read_slam_timing(const JsonCursor& value) {
  value.allow_only({"kind", "run", "method", "seconds"});
  return {.run = read_id(value.at("run")),
          .method = read_slam_method(value.at("method")),
          .seconds = value.at("seconds").number(0.0, kLongest_s)};
}

FactorizationCost read_factorization(const JsonCursor& value) {
  value.allow_only({"kind", "landmarks", "steps", "seconds"});
  return {.landmarks = value.at("landmarks").integer32(1, kMostLandmarks),
          .steps = value.at("steps").integer(1, kMostSteps),
          .seconds = value.at("seconds").number(0.0, kLongest_s)};
}

TrialSeconds read_trial_seconds(const JsonCursor& value) {
  value.allow_only({"kind", "part", "series", "seconds"});
  return {.part = value.at("part").text(200),
          .series = read_id(value.at("series")),
          .seconds = value.at("seconds").number(0.0, kLongest_s)};
}

Session read_session(const JsonCursor& value) {
  value.allow_only(
      {"kind", "command", "started_utc", "host", "jobs", "seconds", "peak_memory_mib"});
  Session session{.command = value.at("command").text(kLongestText),
                  .started_utc = value.at("started_utc").text(),
                  .host = value.at("host").text(),
                  .jobs = value.at("jobs").integer32(0, 1'000'000),
                  .seconds = value.at("seconds").number(0.0, kLongest_s),
                  .peak_memory_mib = std::nullopt};
  if (const auto peak = value.find("peak_memory_mib"))
    session.peak_memory_mib = peak->number(0.0, std::numeric_limits<double>::max());
  return session;
}

void read_line(std::string_view line, const std::string& source, Timings& timings) {
  const JsonDocument document = parse_json(line, source);
  const JsonCursor root = document.cursor();
  if (root.is_object() && root.find("schema")) {
    root.allow_only({"schema"});
    return expect_schema(root, kTimingsSchema);
  }
  const std::string kind = root.at("kind").text();
  if (kind == "map")
    timings.maps.push_back(read_timing(root));
  else if (kind == "slam")
    timings.slam.methods.push_back(read_slam_timing(root));
  else if (kind == "factorization")
    timings.slam.factorization.push_back(read_factorization(root));
  else if (kind == "trial")
    timings.trials.push_back(read_trial_seconds(root));
  else if (kind == "session")
    timings.sessions.push_back(read_session(root));
  else
    root.at("kind").fail("expected map, slam, factorization, trial or session, got " +
                         in_quotes(kind));
}

}  // namespace

std::string timings_header() { return json_line({{"schema", schema_value(kTimingsSchema)}}); }

std::string timing_line(const Timing& timing) {
  nlohmann::ordered_json value = {{"kind", "map"},
                                  {"layout", timing.run.layout},
                                  {"pose", timing.run.pose},
                                  {"sensor", name(timing.sensor)}};
  put_setting(value, timing.setting);
  value["step"] = timing.step;
  value["seconds"] = timing.seconds;
  return json_line(value);
}

std::string timing_line(const SlamTiming& timing) {
  return json_line({{"kind", "slam"},
                    {"run", timing.run},
                    {"method", info(timing.method).name},
                    {"seconds", timing.seconds}});
}

std::string timing_line(const FactorizationCost& cost) {
  return json_line({{"kind", "factorization"},
                    {"landmarks", cost.landmarks},
                    {"steps", cost.steps},
                    {"seconds", cost.seconds}});
}

std::string timing_line(const TrialSeconds& timing) {
  return json_line({{"kind", "trial"},
                    {"part", timing.part},
                    {"series", timing.series},
                    {"seconds", timing.seconds}});
}

std::string session_line(const Session& session) {
  nlohmann::ordered_json value = {
      {"kind", "session"},    {"command", session.command}, {"started_utc", session.started_utc},
      {"host", session.host}, {"jobs", session.jobs},       {"seconds", session.seconds}};
  if (session.peak_memory_mib) value["peak_memory_mib"] = *session.peak_memory_mib;
  return json_line(value);
}

Timings parse_timings(std::string_view text, const std::string& source) {
  Timings timings;
  std::size_t number = 1;
  for (std::size_t end; (end = text.find('\n')) != std::string_view::npos; ++number) {
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    read_line(line, fmt::format("{}: line {}", source, number), timings);
  }
  return timings;
}

void mend_lines(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return;
  const std::string text = read_file(path);
  if (text.empty() || text.back() == '\n') return;
  const std::size_t last = text.rfind('\n');
  write_file(path, last == std::string::npos ? std::string_view()
                                             : std::string_view(text).substr(0, last + 1));
}

void start_lines(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::exists(path, error) && std::filesystem::file_size(path, error) > 0) return;
  write_file(path, timings_header());
}

}  // namespace mapproof
