#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/model/map_record.hpp"
#include "core/model/run_details.hpp"
#include "core/model/study.hpp"

namespace mapproof {

/// runs/layout-1-pose-2.json (mapproof.run).
std::string run_json(const Run& run);
Run parse_run(std::string_view text, const std::string& source);

/// details/layout-1-pose-2.json (mapproof.details).
std::string details_json(const RunDetails& details);
RunDetails parse_details(std::string_view text, const std::string& source);

/// The maps of one run in a file.
struct RunMaps {
  RunId run;
  std::vector<MapRecord> maps;
};

/// maps/layout-1-pose-2.json (mapproof.maps): names, truth and anchors once, not in every map.
std::string maps_json(const RunMaps& maps);
RunMaps parse_maps(std::string_view text, const std::string& source);

/// study.json (mapproof.study): a Study without its runs.
std::string study_json(const Experiment& experiment, const Provenance& provenance);
Study parse_study(std::string_view text, const std::string& source);

}  // namespace mapproof
