#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace mapproof {

/// What a study.json says, whatever the kind of study.
struct StudyHead {
  nlohmann::json experiment;  ///< Canonical, every default written out.
  std::string solver_digest;
};

/// Reads the text of a study.json. @throws IoError with the place.
using HeadReader = std::function<StudyHead(const std::string& text, const std::string& source)>;

/// Brings a locked folder to where a study goes on: writes study.json and the first line of
/// timings.jsonl, removes what a killed process left behind, and `parts` that another solver made.
/// @param text   Of study.json.
/// @param parts  Files and folders of records, below `folder`; timings.jsonl among them.
/// @return Whether records of another solver were removed.
/// @throws IoError if the folder holds another experiment, or files but no study.
bool take_up_study(const std::filesystem::path& folder, const std::string& text,
                   const HeadReader& read_head, const std::vector<std::filesystem::path>& parts);

}  // namespace mapproof
