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

/// Adds figures as long as there is room for them.
class FigureFiles {
 public:
  FigureFiles(const std::set<std::string>& shown, const Disclosure& disclosure, PageData& data)
      : shown_(shown), disclosure_(disclosure), data_(data) {}

  void add(const std::string& id, const char* ending, const std::string& json) {
    const std::string name = "figures/" + id + ending;
    if (!shown_.contains(id) || !is_page_file(name) || data_.files.size() >= kMostPageFiles)
      return void(++left_);
    std::string text = disclosure_.text(json);
    const std::size_t bytes = gzipped(text).size() / 3 * 4;  // In base64.
    if (held_ + bytes > kMostFigureData) return void(++left_);
    held_ += bytes;
    ++kept_;
    data_.files.push_back({name, std::move(text)});
  }

  std::size_t kept() const { return kept_; }
  std::size_t left() const { return left_; }

 private:
  const std::set<std::string>& shown_;
  const Disclosure& disclosure_;
  PageData& data_;
  std::size_t held_ = 0, kept_ = 0, left_ = 0;
};

/// @param inner  Of a study below the folder: "plaza/"; else empty.
void add_study(const fs::path& folder, const std::string& inner, const Disclosure& disclosure,
               PageData& data) {
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

PageContent page_content(PageData records, const Images& images, const std::set<std::string>& shown,
                         const Disclosure& disclosure) {
  PageContent content{.data = std::move(records)};
  FigureFiles files(shown, disclosure, content.data);
  for (const Figure* figure : images.figures)
    files.add(figure->id, ".figure.json", figure_to_json(*figure));
  for (const Scene* scene : images.scenes)
    files.add(scene->id, ".scene.json", scene_to_json(*scene));
  content.figures_kept = files.kept();
  content.figures_left = files.left();
  return content;
}

std::string left_out_text(const PageContent& content) {
  if (content.figures_left == 0) return "";
  return fmt::format(
      "report.html carries the results and the data of {}; those of {} more, such as single maps "
      "that it does not show, are in figures/ alone",
      counted(static_cast<long long>(content.figures_kept), "figure"), content.figures_left);
}

}  // namespace mapproof
