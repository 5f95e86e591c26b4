#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/model/slam/slam_study.hpp"
#include "core/model/study.hpp"
#include "core/model/topic_study.hpp"
#include "core/records/studies/slam_fields.hpp"
#include "core/records/text_forms.hpp"
#include "core/records/value_fields.hpp"

namespace mapproof {

// The fields of the lines of timings.jsonl (core/json/fields.hpp).

namespace record_rules {

inline constexpr FieldRule kSeconds = {.minimum = 0.0};

}  // namespace record_rules

template <typename Visitor>
void fields(Visitor& v, Timing& timing) {
  v.tag("kind", "map");
  v.field("layout", timing.run.layout, {.minimum = 1, .maximum = kMostLayouts});
  v.field("pose", timing.run.pose, {.minimum = 1, .maximum = kMostPoses});
  v.field("sensor", timing.sensor);
  any_setting_fields(v, timing.setting);
  v.field("step", timing.step, record_rules::kStep);
  v.field("seconds", timing.seconds, record_rules::kSeconds);
}

template <typename Visitor>
void fields(Visitor& v, SlamTiming& timing) {
  v.tag("kind", "slam");
  v.field("run", timing.run, {.description = "Its id.", .max_bytes = 64, .form = &kPlainId});
  v.field("method", timing.method);
  v.field("seconds", timing.seconds, record_rules::kSeconds);
}

template <typename Visitor>
void fields(Visitor& v, FactorizationCost& cost) {
  v.tag("kind", "factorization");
  v.field("landmarks", cost.landmarks, {.minimum = 1, .maximum = kMostLandmarks});
  v.field("steps", cost.steps, {.minimum = 1, .maximum = kMostSteps});
  v.field("seconds", cost.seconds, record_rules::kSeconds);
}

template <typename Visitor>
void fields(Visitor& v, MethodSeconds& timing) {
  v.tag("kind", "method");
  v.field("part", timing.part, {.description = "Its id.", .max_bytes = 200});
  v.field("method", timing.method, record_rules::kMethod);
  v.field("seconds", timing.seconds, record_rules::kSeconds);
}

template <typename Visitor>
void fields(Visitor& v, Session& session) {
  v.tag("kind", "session");
  v.field("command", session.command, {.max_bytes = kLongestText});
  v.field("started_utc", session.started_utc, {.description = "ISO 8601."});
  v.field("host", session.host);
  v.field("jobs", session.jobs, {.minimum = 0, .maximum = 1e6});
  v.field("seconds", session.seconds, record_rules::kSeconds);
  v.field("peak_memory_mib", session.peak_memory_mib,
          {.description = "Of the process, at its end.", .minimum = 0.0, .key = Key::kIfAny});
}

/// A line behind the first one.
using TimingLine = std::variant<Timing, SlamTiming, FactorizationCost, MethodSeconds, Session>;

/// timings.jsonl: one JSON object per line: the schema, then {"kind": "map", ...},
/// {"kind": "slam", ...}, {"kind": "factorization", ...}, {"kind": "method", ...} or
/// {"kind": "session", ...}.
///
/// Lines are appended, a batch at a time, by OutputFolder::append(): to rewrite the whole file for
/// every run would cost the square of their number, and a kill can only tear the last line, which
/// readers leave out and mend_lines() removes.
struct Timings {
  std::vector<Timing> maps;
  SlamTimings slam;
  std::vector<MethodSeconds> outcomes;
  std::vector<Session> sessions;
};

/// The first line.
std::string timings_header();

std::string timing_line(const Timing& timing);
std::string timing_line(const SlamTiming& timing);
std::string timing_line(const FactorizationCost& cost);
std::string timing_line(const MethodSeconds& timing);
std::string session_line(const Session& session);

/// All whole lines in their order. @throws IoError naming the line.
Timings parse_timings(std::string_view text, const std::string& source);

/// Removes a last line without an end from the timings.jsonl of a study's folder. @throws IoError.
void mend_lines(const std::filesystem::path& folder);

/// Writes the first line if that file is empty or not there. @throws IoError.
void start_lines(const std::filesystem::path& folder);

}  // namespace mapproof
