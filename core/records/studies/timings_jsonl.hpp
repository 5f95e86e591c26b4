#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/slam_study.hpp"
#include "core/model/study.hpp"
#include "core/model/trial_study.hpp"

namespace mapproof {

/// timings.jsonl: one JSON object a line: the schema, then {"kind": "map", ...},
/// {"kind": "slam", ...}, {"kind": "factorization", ...}, {"kind": "trial", ...} or
/// {"kind": "session", ...}.
///
/// Lines are appended, a batch at a time, by append_file(): to rewrite the whole file for every run
/// would cost the square of their number, and a kill can only tear the last line, which readers
/// leave out and mend_lines() removes.
struct Timings {
  std::vector<Timing> maps;
  SlamTimings slam;
  std::vector<TrialSeconds> trials;
  std::vector<Session> sessions;
};

/// The first line.
std::string timings_header();

std::string timing_line(const Timing& timing);
std::string timing_line(const SlamTiming& timing);
std::string timing_line(const FactorizationCost& cost);
std::string timing_line(const TrialSeconds& timing);
std::string session_line(const Session& session);

/// All whole lines in their order. @throws IoError naming the line.
Timings parse_timings(std::string_view text, const std::string& source);

/// Removes a last line without an end, if there is one. @throws IoError.
void mend_lines(const std::filesystem::path& path);

/// Writes the first line if the file is empty or not there. @throws IoError.
void start_lines(const std::filesystem::path& path);

}  // namespace mapproof
