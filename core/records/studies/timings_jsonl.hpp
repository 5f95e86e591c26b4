#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/model/shard.hpp"
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

template <typename Visitor>
void fields(Visitor& v, Shard& shard) {
  v.field("index", shard.index, {.minimum = 1, .maximum = kMostRuns});
  v.field("count", shard.count, {.minimum = 1, .maximum = kMostRuns});
  if (shard.index > shard.count) v.refuse("index", "is above count");
}

template <typename Visitor>
void fields(Visitor& v, ShardSession& session) {
  v.tag("kind", "shard");
  v.field("shard", session.shard, {.description = "Every count-th task, from the index-th on."});
  v.field("tasks", session.tasks,
          {.description = "Of the whole study.", .minimum = 0, .maximum = kMostRuns});
  v.field("plan", session.plan,
          {.description = "SHA-256 of the ids of all tasks, a line each.", .max_bytes = 64});
  v.field("command", session.command, {.max_bytes = kLongestText});
  v.field("processor", session.processor);
}

template <typename Visitor>
void fields(Visitor& v, FileDigest& file) {
  v.type("file_digest");
  v.field("file", file.file, {.description = "Below the study's folder.", .not_empty = true});
  v.field("sha256", file.sha256, {.max_bytes = 64});
}

template <typename Visitor>
void fields(Visitor& v, TaskRecords& records) {
  v.tag("kind", "records");
  v.field("task", records.task,
          {.description = "Counted from 1.", .minimum = 1, .maximum = kMostRuns});
  v.field("id", records.id, {.max_bytes = 200});
  v.field("files", records.files, {.description = "What the task has written."});
}

/// A line behind the first one.
using TimingLine = std::variant<Timing, SlamTiming, FactorizationCost, MethodSeconds, Session,
                                ShardSession, TaskRecords>;

/// timings.jsonl: one JSON object per line: the schema, then {"kind": "map", ...},
/// {"kind": "slam", ...}, {"kind": "factorization", ...}, {"kind": "method", ...} or
/// {"kind": "session", ...}; of a shard also {"kind": "shard", ...} and {"kind": "records", ...}.
///
/// Lines are appended, a batch at a time, by OutputFolder::append(): to rewrite the whole file for
/// every run would cost the square of their number, and a kill can only tear the last line, which
/// readers leave out and mend_lines() removes.
struct Timings {
  std::vector<Timing> maps;
  SlamTimings slam;
  std::vector<MethodSeconds> outcomes;
  std::vector<Session> sessions;
  std::vector<ShardSession> shards;
  std::vector<TaskRecords> records;
};

/// The first line.
std::string timings_header();

std::string timing_line(const Timing& timing);
std::string timing_line(const SlamTiming& timing);
std::string timing_line(const FactorizationCost& cost);
std::string timing_line(const MethodSeconds& timing);
std::string session_line(const Session& session);
std::string shard_line(const ShardSession& session);
std::string records_line(const TaskRecords& records);

/// All whole lines in their order. @throws IoError naming the line.
Timings parse_timings(std::string_view text, const std::string& source);

struct ReadTimingLine {
  std::string text;  ///< With its end.
  TimingLine line;
};

/// The lines of a folder's timings.jsonl behind the schema, in their order. What cannot be read,
/// such as lines that two processes on a file system without locks wrote into each other, is passed
/// over, the whole file if need be.
std::vector<ReadTimingLine> readable_lines(const std::filesystem::path& folder);

/// Removes a last line without an end from the timings.jsonl of a study's folder. @throws IoError.
void mend_lines(const std::filesystem::path& folder);

/// Writes the first line if that file is empty or not there. @throws IoError.
void start_lines(const std::filesystem::path& folder);

}  // namespace mapproof
