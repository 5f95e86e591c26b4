#include "core/records/studies/timings_jsonl.hpp"

#include <system_error>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/json/json_document.hpp"
#include "core/json/json_text.hpp"
#include "core/json/record_reader.hpp"
#include "core/json/record_writer.hpp"
#include "core/records/studies/study_folder.hpp"

namespace mapproof {
namespace {

constexpr std::string_view kTimingsSchema = "mapproof.timings";

void read_line(std::string_view line, const std::string& source, Timings& timings) {
  const JsonDocument document = parse_json(line, source);
  const JsonCursor root = document.cursor();
  if (root.is_object() && root.find("schema")) {
    root.allow_only({"schema"});
    return expect_schema(root, kTimingsSchema);
  }
  const auto sort = [&]<typename T>(T& one) {
    if constexpr (std::is_same_v<T, Timing>)
      timings.maps.push_back(std::move(one));
    else if constexpr (std::is_same_v<T, SlamTiming>)
      timings.slam.methods.push_back(std::move(one));
    else if constexpr (std::is_same_v<T, FactorizationCost>)
      timings.slam.factorization.push_back(std::move(one));
    else if constexpr (std::is_same_v<T, MethodSeconds>)
      timings.outcomes.push_back(std::move(one));
    else if constexpr (std::is_same_v<T, ShardSession>)
      timings.shards.push_back(std::move(one));
    else if constexpr (std::is_same_v<T, TaskRecords>)
      timings.records.push_back(std::move(one));
    else
      timings.sessions.push_back(std::move(one));
  };
  auto read = from_json_value<TimingLine>(root);
  std::visit(sort, read);
}

}  // namespace

std::string timings_header() { return json_line({{"schema", schema_value(kTimingsSchema)}}); }

std::string timing_line(const Timing& timing) { return json_line(to_json_value(timing)); }
std::string timing_line(const SlamTiming& timing) { return json_line(to_json_value(timing)); }
std::string timing_line(const FactorizationCost& cost) { return json_line(to_json_value(cost)); }
std::string timing_line(const MethodSeconds& timing) { return json_line(to_json_value(timing)); }
std::string session_line(const Session& session) { return json_line(to_json_value(session)); }
std::string shard_line(const ShardSession& session) { return json_line(to_json_value(session)); }
std::string records_line(const TaskRecords& records) { return json_line(to_json_value(records)); }

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

std::vector<ReadTimingLine> readable_lines(const std::filesystem::path& folder) {
  std::string text;
  try {
    text = read_file(folder / kTimingsFile);
  } catch (const IoError&) {
    return {};
  }
  std::vector<ReadTimingLine> lines;
  for (std::size_t start = 0, end; (end = text.find('\n', start)) != std::string::npos;
       start = end + 1) {
    std::string line = text.substr(start, end + 1 - start);
    try {
      const JsonDocument document = parse_json(line, kTimingsFile);
      auto read = from_json_value<TimingLine>(document.cursor());
      lines.push_back({.text = std::move(line), .line = std::move(read)});
    } catch (const IoError&) {
      continue;
    }
  }
  return lines;
}

void mend_lines(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kTimingsFile;
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return;
  const std::string text = read_file(path);
  if (text.empty() || text.back() == '\n') return;
  const std::size_t last = text.rfind('\n');
  OutputFolder(folder).write(kTimingsFile, last == std::string::npos
                                               ? std::string_view()
                                               : std::string_view(text).substr(0, last + 1));
}

void start_lines(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kTimingsFile;
  std::error_code error;
  if (std::filesystem::exists(path, error) && std::filesystem::file_size(path, error) > 0) return;
  OutputFolder(folder).write(kTimingsFile, timings_header());
}

}  // namespace mapproof
