#include "app/nightly/nightly_comparisons.hpp"

#include <system_error>

#include <fmt/format.h>

#include "core/base/files/output_folder.hpp"
#include "reports/diff/folder_diff.hpp"
#include "reports/html/diff/diff_html.hpp"

namespace mapproof {

namespace fs = std::filesystem;

std::vector<std::string> write_comparisons(const NightlyPair& pair, const HistoryOutputs& outputs) {
  std::vector<std::string> written;
  const auto folder = [&](int number, const std::string& study) {
    return outputs.store / "nightly_runs" / fmt::format("{:04}", number) / study;
  };
  for (const std::string& study : pair.studies) {
    const fs::path before = folder(pair.before, study), after = folder(pair.after, study);
    std::error_code error;
    if (!fs::exists(before / "study.json", error) || !fs::exists(after / "study.json", error))
      continue;
    const DiffSettings settings;
    const DiffResult result = folder_diff(before, after, settings);
    const std::string file = comparison_file(pair.before, pair.after, study);
    make_folder((outputs.out / file).parent_path());
    OutputFolder(outputs.out)
        .write(file, outputs.disclosure.text(diff_html(result, settings, outputs.page)));
    written.push_back(file);
  }
  return written;
}

}  // namespace mapproof
