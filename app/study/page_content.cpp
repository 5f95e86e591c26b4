#include "app/study/page_content.hpp"

#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "app/map/map_folder.hpp"
#include "app/slam/range_map.hpp"
#include "app/study/embedded_experiments.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/gzip.hpp"
#include "core/base/text/words.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/studies/study_kind.hpp"
#include "render/plot/figure_json.hpp"
#include "render/scene/scene_json.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

bool is_large(const fs::path& table) {
  std::error_code error;
  const auto bytes = fs::file_size(table, error);
  return !error && bytes > kMostResults;
}

/// Without its table a study cannot be read: then nothing of it is added.
/// @param inner  Of a study below the folder: "plaza/"; else empty.
void add_study(const fs::path& folder, const std::string& inner, const Disclosure& disclosure,
               PageData& data) {
  if (is_large(folder / kResultsFile)) return;
  data.files.push_back({inner + kStudyFile, disclosure.text(read_file(folder / kStudyFile))});
  data.files.push_back({inner + kResultsFile, disclosure.text(results_table_of(folder))});
}

void add_records(const fs::path& folder, const Disclosure& disclosure, PageData& data) {
  if (is_study(folder)) return add_study(folder, "", disclosure, data);
  for (const fs::path& study : study_folders(folder))
    add_study(study, study.filename().string() + "/", disclosure, data);
  for (const char* file : {kMapFile, kSlamFile}) {
    std::error_code error;
    if (fs::is_regular_file(folder / file, error))
      data.files.push_back({file, disclosure.text(read_file(folder / file))});
  }
}

}  // namespace

PageData page_records(const fs::path& folder, const Disclosure& disclosure) {
  PageData records;
  add_records(folder, disclosure, records);
  return records;
}

std::vector<std::string> large_tables(const fs::path& folder) {
  if (is_study(folder))
    return is_large(folder / kResultsFile) ? std::vector<std::string>{kResultsFile}
                                           : std::vector<std::string>();
  std::vector<std::string> tables;
  for (const fs::path& study : study_folders(folder))
    if (is_large(study / kResultsFile))
      tables.push_back((study.filename() / kResultsFile).generic_string());
  return tables;
}

std::size_t packed_bytes(const std::string& text) {
  return gzipped(text).size() / 3 * 4;  // In base64.
}

FigureData::FigureData(const Images& images, const Disclosure& disclosure)
    : disclosure_(disclosure) {
  for (const Figure* figure : images.figures)
    entries_.push_back({figure->id, "figures/" + figure->id + ".figure.json",
                        [figure] { return figure_to_json(*figure); }});
  for (const Scene* scene : images.scenes)
    entries_.push_back({scene->id, "figures/" + scene->id + ".scene.json",
                        [scene] { return scene_to_json(*scene); }});
}

std::vector<FigureData::Entry*> FigureData::kept(const std::set<std::string>& shown) {
  std::vector<Entry*> all;
  std::size_t held = 0;
  for (Entry& entry : entries_) {
    if (!shown.contains(entry.id) || !is_page_file(entry.name)) continue;
    if (!entry.text) {
      entry.text = disclosure_.text(entry.json());
      entry.bytes = packed_bytes(*entry.text);
    }
    if (held + entry.bytes > kMostFigureData) continue;
    held += entry.bytes;
    all.push_back(&entry);
  }
  return all;
}

std::size_t FigureData::bytes(const std::set<std::string>& shown) {
  std::size_t bytes = 0;
  for (const Entry* entry : kept(shown)) bytes += entry->bytes;
  return bytes;
}

PageContent FigureData::content(PageData records, const std::set<std::string>& shown) && {
  PageContent content{.data = std::move(records)};
  for (Entry* entry : kept(shown)) {
    if (content.data.files.size() >= kMostPageFiles) break;
    content.data.files.push_back({entry->name, *std::exchange(entry->text, std::nullopt)});
    ++content.figures_kept;
  }
  content.figures_left = entries_.size() - content.figures_kept;
  return content;
}

std::string left_out_text(const PageContent& content) {
  std::string text;
  if (content.figures_left > 0)
    text = fmt::format(
        "report.html carries {}the data of {}; those of {} more, such as single maps that it does "
        "not show, are in figures/ alone",
        content.tables_left.empty() ? "the results and " : "",
        counted(static_cast<long long>(content.figures_kept), "figure"), content.figures_left);
  if (!content.tables_left.empty())
    text += fmt::format(
        "{}report.html does not carry {}, of more than {} MiB: `results` and `diff` take the "
        "folder",
        text.empty() ? "" : "; ", listed(content.tables_left, 4), kMostResults >> 20);
  return text;
}

}  // namespace mapproof
