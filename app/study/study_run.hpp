#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>

#include "app/console.hpp"
#include "app/study/study_request.hpp"
#include "core/model/study.hpp"

namespace mapproof {

/// What a session is known by in the records.
struct SessionNames {
  std::string command;  ///< What makes the study again.
  std::string host;
};

/// Measures a session from its construction on.
class SessionClock {
 public:
  SessionClock();
  double seconds() const;
  Session session(const SessionNames& names, int jobs) const;

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::string started_utc_;
};

/// Runs what a folder does not hold yet, with a progress line, and notes the session.
/// @throws IoError, InvalidInput.
void make_study(const StudyRequest& request, const std::filesystem::path& folder, int jobs,
                const SessionNames& names, const Console& console);

/// The kind of processor that the program runs on, as the system names it, with its architecture:
/// "AMD EPYC 7763 64-Core Processor (x86_64)". Records are equal to the byte on one kind.
std::string processor_kind();

/// The same of a text like that of /proc/cpuinfo; where it has no name, as on ARM, the numbers of
/// maker and part; "unknown (riscv64)" where it has nothing of that.
std::string processor_kind(std::string_view cpuinfo, std::string_view architecture);

}  // namespace mapproof
