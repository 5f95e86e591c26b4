#include "core/studies/shard.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <memory>
#include <set>
#include <tuple>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/sha256.hpp"
#include "core/base/text/shell_word.hpp"
#include "core/records/limits.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/records/studies/timings_jsonl.hpp"
#include "core/studies/study_kind.hpp"

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

namespace {

/// What a folder notes of itself.
struct Notes {
  ShardFolder shard;
  std::string study;
  std::vector<TaskRecords> records;  ///< Of each task the last.
};

/// @throws IoError if the folder holds no shard of a study that can be merged.
Notes read_notes(const fs::path& folder) {
  require_study(folder);
  refuse_links_out(folder);
  // The type is named: else GCC 12 destroys the folder twice where the file cannot be read.
  Notes notes{.shard = ShardFolder{.folder = folder, .session = {}, .processors = {}},
              .study = read_file(folder / kStudyFile),
              .records = {}};
  std::map<int, TaskRecords> last;
  std::set<std::string> processors;
  for (ReadTimingLine& read : readable_lines(folder)) {
    if (auto* session = std::get_if<ShardSession>(&read.line)) {
      processors.insert(session->processor);
      notes.shard.session = std::move(*session);
    } else if (auto* records = std::get_if<TaskRecords>(&read.line)) {
      last[records->task] = std::move(*records);
    }
  }
  if (processors.empty())
    throw IoError(folder.string(),
                  "holds a study that was run without --shard; leave it out: mapproof merge takes "
                  "folders of mapproof run --shard I/N");
  notes.shard.processors.assign(processors.begin(), processors.end());
  for (auto& [task, records] : last) notes.records.push_back(std::move(records));
  return notes;
}

/// Whether a file is one of the records of a study of that kind.
bool is_record(const StudyKind& kind, const fs::path& file) {
  if (file.is_absolute() || file != file.lexically_normal()) return false;
  return std::ranges::any_of(kind.records, [&](const fs::path& record) {
    return std::mismatch(record.begin(), record.end(), file.begin(), file.end()).first ==
           record.end();
  });
}

/// The file's text. @throws IoError if it cannot be read or is not what was noted.
std::string noted_text(const fs::path& folder, const FileDigest& file) {
  std::string text = read_file(folder / file.file);
  if (sha256_hex(text) != file.sha256)
    throw IoError((folder / file.file).string(), "is not what was written");
  return text;
}

/// Reads folders one by one.
class Reader {
 public:
  explicit Reader(ShardUnion& result) : result_(result) {}

  void add(const fs::path& folder) {
    try {
      const Notes notes = read_notes(folder);
      if (!belongs(notes)) return;
      result_.shards.push_back(notes.shard);
      for (const TaskRecords& records : notes.records) take(folder, records);
    } catch (const IoError& error) {
      result_.damaged.emplace_back(error.what());
    }
  }

  /// What is missing, once all folders are read.
  void conclude() {
    std::ranges::sort(result_.shards, {}, [](const ShardFolder& shard) {
      return std::tuple(shard.session.shard.count, shard.session.shard.index, shard.folder);
    });
    std::set<std::string> processors;
    for (const ShardFolder& shard : result_.shards)
      processors.insert(shard.processors.begin(), shard.processors.end());
    result_.processors.assign(processors.begin(), processors.end());
    if (result_.shards.empty() && result_.refusals.empty())
      result_.refusals = std::move(result_.damaged);
    if (result_.refusals.empty()) find_missing();
  }

 private:
  /// Whether a folder is of the same study as the first, which is taken over.
  bool belongs(const Notes& notes) {
    const std::string folder = notes.shard.folder.string();
    if (!first_) {
      kind_ = kind_of_study(folder);
      if (kind_ == nullptr || kind_->start == nullptr)
        throw IoError(folder, "holds no study that can be merged");
      kind_->start(notes.study, (notes.shard.folder / kStudyFile).string());
      first_ = notes.shard;
      result_.study = notes.study;
      result_.tasks = notes.shard.session.tasks;
      return true;
    }
    const auto refuse = [&](const std::string& what) {
      result_.refusals.push_back(fmt::format("{}: is of another study than {}: {}", folder,
                                             first_->folder.string(), what));
      return false;
    };
    if (notes.study != result_.study) {
      kind_->start(notes.study, (notes.shard.folder / kStudyFile).string());
      return refuse(first_difference(result_.study, notes.study));
    }
    if (notes.shard.session.plan != first_->session.plan)
      return refuse("it was made with other data");
    return true;
  }

  void take(const fs::path& folder, const TaskRecords& records) {
    for (const FileDigest& file : records.files) {
      if (!is_record(*kind_, file.file))
        throw IoError((folder / kTimingsFile).string(),
                      "names a file that is not a record: \"" + printable(file.file) + "\"");
      try {
        noted_text(folder, file);
      } catch (const IoError& error) {
        result_.damaged.emplace_back(error.what());
        return;
      }
    }
    const auto [there, is_new] = result_.found.try_emplace(records.task, folder, records);
    if (is_new || there->second.records.files == records.files) return;
    result_.refusals.push_back(fmt::format("{}: holds other records of {} than {}; leave one out",
                                           folder.string(), records.id,
                                           there->second.folder.string()));
  }

  /// Of the first number of shards, which the others are compared with.
  void find_missing() {
    const int count = result_.shards.front().session.shard.count;
    std::map<int, int> lost;  // By shard.
    for (int task = 1; task <= result_.tasks; ++task)
      if (!result_.found.contains(task)) ++lost[(task - 1) % count + 1];
    for (const auto& [index, number] : lost) {
      const Shard shard{.index = index, .count = count};
      result_.open.push_back(shard);
      result_.missing.push_back(sentence(shard, number));
    }
  }

  std::string sentence(const Shard& shard, int lost) const {
    const auto there = std::ranges::find(
        result_.shards, shard, [](const ShardFolder& folder) { return folder.session.shard; });
    if (there != result_.shards.end())
      return fmt::format(
          "{}: {} of the {} tasks of shard {} are missing or damaged; run it again: {} --shard {} "
          "--out {}",
          there->folder.string(), lost, share_size(shard, result_.tasks), text_of(shard),
          command_of_one_run(there->session), text_of(shard),
          shell_word(there->folder.string()));
    const ShardSession& one = result_.shards.front().session;
    return fmt::format("shard {} is missing: {} {}; run it: {} --shard {} --out DIR",
                       text_of(shard), lost, lost == 1 ? "task" : "tasks", command_of_one_run(one),
                       text_of(shard));
  }

  ShardUnion& result_;
  const StudyKind* kind_ = nullptr;
  std::optional<ShardFolder> first_;
};

/// The lines of all shards, without those that say what their tasks wrote.
std::string merged_timings(const ShardUnion& shards) {
  std::string text = timings_header();
  for (const ShardFolder& shard : shards.shards)
    for (const ReadTimingLine& read : readable_lines(shard.folder))
      if (!std::holds_alternative<TaskRecords>(read.line)) text += read.text;
  return text;
}

}  // namespace

ShardUnion read_shards(std::span<const fs::path> folders,
                       const std::function<void(std::size_t)>& progress) {
  ShardUnion result;
  Reader reader(result);
  std::size_t read = 0;
  for (const fs::path& folder : folders) {
    reader.add(folder);
    progress(++read);
  }
  reader.conclude();
  return result;
}

std::string command_of_one_run(const ShardSession& session) {
  return session.command.substr(0, session.command.find(" --shard "));
}

void merge_shards(const ShardUnion& shards, const fs::path& out,
                  const std::function<Session()>& session) {
  const fs::path& first = shards.shards.front().folder;
  const StudyKind* kind = kind_of_study(first);
  StudyStart start = kind->start(shards.study, (first / kStudyFile).string());
  start.text = shards.study;
  StudyWriter writer(out, start);
  for (const auto& [task, found] : shards.found) {
    StudyPart part;
    for (const FileDigest& file : found.records.files)
      part.files.push_back({file.file, noted_text(found.folder, file)});
    writer.write(part);
  }
  OutputFolder(out).write(kTimingsFile, merged_timings(shards) + session_line(session()));
  write_results_table(out);
}

}  // namespace mapproof
