#pragma once

#include <optional>
#include <string>
#include <string_view>

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

}  // namespace mapproof
