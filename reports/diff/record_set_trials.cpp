#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/records/trial_json.hpp"
#include "core/records/trial_store.hpp"
#include "reports/diff/quantities.hpp"
#include "reports/diff/record_set_parts.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

void add_trial(RecordSet& set, const TrialDesign& design, const std::string& part,
               const Trial& trial) {
  const std::string subject = fmt::format("{}/{}/{:.6g}", trial.setup, trial.series, trial.level);
  for (std::size_t i = 0; i < trial.values.size(); ++i) {
    const TrialQuantity& quantity = design.quantities[i];
    if (find_quantity(quantity.id) != nullptr)
      add_value(set, subject, quantity.id, part, trial.values[i]);
    else
      add_value(set, subject + "/" + quantity.id, quantity.lower_is_better ? "loss" : "gain", part,
                trial.values[i]);
  }
  add_statuses(set, part + "/" + subject, trial.statuses);
}

void add_part(RecordSet& set, const TrialStudy& study, const TrialPart& part, bool with_maps) {
  if (part.run) set.runs[part.id] = fmt::format("layout-{}", part.run->layout);
  for (const Trial& trial : part.trials) add_trial(set, study.design, part.id, trial);
  if (!with_maps) return;
  for (const TrialMap& map : part.maps) add_map(set, part.id + "/" + map.id, map.map);
}

/// The parts' files in the folder, whatever their order.
std::vector<fs::path> part_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder / "parts", error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == ".json") files.push_back(entry->path());
  std::ranges::sort(files);
  return files;
}

}  // namespace

RecordSet read_trial_records(const fs::path& folder, const fs::path& beside) {
  const fs::path file = folder / "study.json";
  const std::string text = read_file(file);
  const TrialStudy study = parse_trial_study(text, file.string());
  RecordSet set;
  set.kind = "mapproof.trial_study";
  set.repeats = study.experiment.data.empty();
  add_settings(set, text, file.string());
  set.provenance = study.provenance;
  for (const fs::path& path : part_files(folder)) {
    set.runs[path.stem().string()] = "";
    try {
      const ReadTrialPart read = parse_trial_part(read_file(path), path.string(), &study.design);
      const fs::path relative = fs::path("parts") / path.filename();
      add_part(set, study, read.part, !same_bytes(path, beside / relative));
    } catch (const IoError& error) {
      set.problems.push_back({(fs::path("parts") / path.filename()).string(), error.what()});
    }
  }
  return set;
}

}  // namespace mapproof
