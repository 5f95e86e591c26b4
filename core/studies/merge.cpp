#include "core/studies/merge.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/sha256.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/records/studies/timings_jsonl.hpp"
#include "core/studies/shard.hpp"
#include "core/studies/study_kind.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

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
  Notes notes{.shard = {.folder = folder, .session = {}, .processors = {}},
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
    throw IoError(folder.string(), "holds no shard; mapproof run --shard I/N makes one");
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
                      "names a file that is no record: \"" + printable(file.file) + "\"");
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
          "{}: {} of the {} tasks of shard {} are missing or damaged; run it again: {}",
          there->folder.string(), lost, share_size(shard, result_.tasks), text_of(shard),
          there->session.command);
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
