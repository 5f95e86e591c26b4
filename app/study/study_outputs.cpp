#include "app/study/study_outputs.hpp"

#include <algorithm>
#include <array>

#include "core/base/errors.hpp"
#include "core/records/studies/study_folder.hpp"

namespace mapproof {

const StudyOutputs& outputs_of_study(const std::filesystem::path& folder) {
  constexpr std::array kAll = {&kMappingOutputs, &kRangeOutputs, &kTopicOutputs, &kTableOutputs};
  require_study(folder);
  const std::string schema = study_schema(folder);
  const auto found = std::ranges::find(kAll, schema, &StudyOutputs::study);
  if (found == kAll.end())
    throw IoError((folder / kStudyFile).string(), "/schema/name",
                  "is not a study: \"" + printable(schema) + "\"");
  return **found;
}

}  // namespace mapproof
