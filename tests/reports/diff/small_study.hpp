#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/model/map_record.hpp"
#include "core/model/study.hpp"
#include "render/plot/figure.hpp"
#include "render/theme/theme.hpp"

namespace mapproof::test {

/// A study without any solver, small enough to be made and drawn hundreds of times: 12 landmarks,
/// 8 layouts, LPCA and ISOMAP with K = 6 after 100 and 200 steps, errors of about 10 and 5 cm.
/// Scores follow from the maps, figures from both.
struct SmallStudy {
  Study study;
  std::map<RunId, std::vector<MapRecord>> maps;

  explicit SmallStudy(std::uint64_t seed = 7, int layouts = 8, double neighbours = 6.0);

  MapRecord& map(const std::string& id);
  /// Applies `change` to the estimate of every landmark of every map of that subject.
  void for_each_map(const std::string& subject, const std::function<void(MapRecord&)>& change);
  /// Takes the scores from the maps.
  void rescore();

  /// The maps of layout 2 after 200 steps, and MPE over the steps.
  std::vector<Figure> figures() const;
  /// Records, as `mapproof run` would leave them.
  void write_records(const std::filesystem::path& folder) const;
};

/// Draws one figure into a study's folder, without a PDF.
void write_study_figure(const Figure& figure, const Theme& theme,
                        const std::filesystem::path& folder);

}  // namespace mapproof::test
