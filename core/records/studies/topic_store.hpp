#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/model/topic_study.hpp"
#include "core/records/studies/study_writer.hpp"

namespace mapproof {

/// What the folder of the study of a topic begins with.
/// @param study  Experiment, design and provenance are read.
StudyStart study_start(const TopicStudy& study);

/// A part as it is written. @param digest  Of the data set; empty: simulated.
StudyPart part_of(const TopicPart& part, const std::string& digest);

/// Whether the folder holds a part of that design and data set, whole.
bool holds_part(const std::filesystem::path& folder, const TopicDesign& design,
                const std::string& part, const std::string& digest);

/// The parts of a study that have a file, whatever their order in the experiment.
std::vector<std::filesystem::path> part_files(const std::filesystem::path& folder);

/// The study in a folder, as far as it was made: parts in the order of run or data set, with their
/// seconds.
/// @throws IoError if there is no such study or a file of it is damaged.
TopicStudy read_topic_study(const std::filesystem::path& folder);

}  // namespace mapproof
