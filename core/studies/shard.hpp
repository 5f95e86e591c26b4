#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/shard.hpp"
#include "core/records/studies/study_writer.hpp"
#include "core/studies/study_plan.hpp"

namespace mapproof {

/// The shard that "2/8" names; empty for any other text, "9/8" among them.
std::optional<Shard> shard_of_text(std::string_view text);

/// "2/8".
std::string text_of(const Shard& shard);

/// How many of so many tasks are in the shard.
int share_size(const Shard& shard, int tasks);

/// The plan with the shard's tasks alone, which also note the digests of what they write. A task
/// counts as done if its files are what was noted. What a plan makes last, the first shard makes.
StudyPlan share_of(const StudyPlan& plan, const Shard& shard);

/// One start on a shard of the plan.
/// @param plan  The whole plan.
ShardSession shard_session(const StudyPlan& plan, const Shard& shard);

/// Notes in the writer's folder that the shard is worked on.
/// @throws IoError if the folder holds another shard, or one of other data, or cannot be written.
void begin_shard(StudyWriter& writer, const ShardSession& session);

/// A folder that a shard was made in.
struct ShardFolder {
  std::filesystem::path folder;
  ShardSession session;                 ///< The last start of the program on it.
  std::vector<std::string> processors;  ///< All that worked on it, each once.
};

/// The records of a task, in the folder that they are taken from.
struct FoundRecords {
  std::filesystem::path folder;
  TaskRecords records;
};

/// What the folders of shards hold together.
struct ShardUnion {
  std::string study = {};                  ///< The study.json of all of them.
  std::vector<ShardFolder> shards = {};    ///< In order of count, index and folder.
  int tasks = 0;                           ///< Of the whole study.
  std::map<int, FoundRecords> found = {};  ///< Records that are whole, by task.
  std::vector<std::string> refusals = {};  ///< Why they are not one study, a line each.
  std::vector<Shard> open = {};            ///< Those whose records are not all found, ascending.
  std::vector<std::string> missing = {};   ///< What of them is missing, a line each.
  /// Folders without a shard, and files that are not what was written, a line each.
  std::vector<std::string> damaged = {};
  std::vector<std::string> processors = {};  ///< Of all shards, each once, ascending.
};

/// Reads the folders of a study's shards, of one number of shards or of several, in any order.
///
/// Every file is read and compared with the digest that its task noted. Records of one task in
/// several folders have to be equal; those that are damaged are taken from another folder.
/// @param progress  Called with the number of folders read.
ShardUnion read_shards(std::span<const std::filesystem::path> folders,
                       const std::function<void(std::size_t)>& progress);

/// Makes of shards the study that one run makes: the same bytes in all files but timings.jsonl,
/// which holds the lines of all shards.
/// @param shards   Without refusals, and nothing open.
/// @param session  Gives the session that merges, once the records are written.
/// @throws IoError if a file cannot be read, is no longer what read_shards() found, or cannot be
///         written, and as StudyWriter(); what was written stays, and the same call goes on.
void merge_shards(const ShardUnion& shards, const std::filesystem::path& out,
                  const std::function<Session()>& session);

/// The command that makes the whole study in one run, without its --out.
std::string command_of_one_run(const ShardSession& session);

}  // namespace mapproof
