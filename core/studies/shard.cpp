#include "core/studies/shard.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <memory>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/sha256.hpp"
#include "core/records/limits.hpp"
#include "core/records/studies/timings_jsonl.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// What a shard's folder says its tasks have written, read when it is first asked for.
class NotedRecords {
 public:
  /// Whether the task's files are what was noted.
  bool are_whole(const fs::path& folder, const std::string& id) {
    if (folder_ != folder) read(folder);
    const auto noted = files_.find(id);
    return noted != files_.end() && std::ranges::all_of(noted->second, [&](const FileDigest& file) {
             try {
               return sha256_hex(read_file(folder / file.file)) == file.sha256;
             } catch (const IoError&) {
               return false;
             }
           });
  }

 private:
  void read(const fs::path& folder) {
    folder_ = folder;
    files_.clear();
    for (ReadTimingLine& read : readable_lines(folder))
      if (auto* records = std::get_if<TaskRecords>(&read.line))
        files_[records->id] = std::move(records->files);
  }

  fs::path folder_;
  std::map<std::string, std::vector<FileDigest>> files_;
};

/// The task with its records noted.
Task noting(const Task& task, int number, const std::shared_ptr<NotedRecords>& noted) {
  return {.id = task.id,
          .is_done =
              [=](const fs::path& folder) {
                return noted->are_whole(folder, task.id) && task.is_done(folder);
              },
          .make =
              [=] {
                StudyPart part = task.make();
                TaskRecords records{.task = number, .id = task.id};
                for (const PartFile& file : part.files)
                  records.files.push_back(
                      {.file = file.file.generic_string(), .sha256 = sha256_hex(file.text)});
                part.timings += records_line(records);
                return part;
              }};
}

}  // namespace

std::optional<Shard> shard_of_text(std::string_view text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, shard.index);
  if (index.ec != std::errc() || index.ptr == end || *index.ptr != '/') return std::nullopt;
  const auto count = std::from_chars(index.ptr + 1, end, shard.count);
  const bool is_shard = count.ec == std::errc() && count.ptr == end && shard.index >= 1 &&
                        shard.index <= shard.count && shard.count <= kMostRuns;
  return is_shard ? std::optional(shard) : std::nullopt;
}

std::string text_of(const Shard& shard) { return fmt::format("{}/{}", shard.index, shard.count); }

int share_size(const Shard& shard, int tasks) {
  return shard.index > tasks ? 0 : (tasks - shard.index) / shard.count + 1;
}

StudyPlan share_of(const StudyPlan& plan, const Shard& shard) {
  StudyPlan share = plan;
  share.tasks.clear();
  if (shard.index != 1) share.last = {};
  const auto noted = std::make_shared<NotedRecords>();
  const int tasks = static_cast<int>(plan.tasks.size());
  for (int number = shard.index; number <= tasks; number += shard.count)
    share.tasks.push_back(noting(plan.tasks[static_cast<std::size_t>(number - 1)], number, noted));
  return share;
}

ShardSession shard_session(const StudyPlan& plan, const Shard& shard) {
  std::string ids;
  for (const Task& task : plan.tasks) ids += task.id + "\n";
  return {.shard = shard, .tasks = static_cast<int>(plan.tasks.size()), .plan = sha256_hex(ids)};
}

void begin_shard(StudyWriter& writer, const ShardSession& session) {
  for (const ReadTimingLine& read : readable_lines(writer.folder())) {
    const auto* there = std::get_if<ShardSession>(&read.line);
    if (there == nullptr) continue;
    if (there->shard != session.shard)
      throw IoError(writer.folder().string(),
                    fmt::format("holds shard {}, not {}; choose another folder",
                                text_of(there->shard), text_of(session.shard)));
    if (there->plan != session.plan)
      throw IoError(writer.folder().string(),
                    "holds a shard of other data; give the same data or choose another folder");
  }
  writer.write({.timings = shard_line(session)});
}

}  // namespace mapproof
