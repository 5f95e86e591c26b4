#include "core/records/studies/run_json.hpp"

#include "core/json/record_reader.hpp"
#include "core/json/record_writer.hpp"
#include "core/records/experiments/experiment_json.hpp"
#include "core/records/maps/map_fields.hpp"

namespace mapproof {

std::string run_json(const Run& run) { return to_json_text(run); }

Run parse_run(std::string_view text, const std::string& source) {
  return from_json_text<Run>(text, source);
}

std::string details_json(const RunDetails& details) { return to_json_text(details); }

RunDetails parse_details(std::string_view text, const std::string& source) {
  return from_json_text<RunDetails>(text, source);
}

std::string maps_json(const RunMaps& maps) {
  MapsFile file{.run = maps.run, .maps = {}};
  if (!maps.maps.empty()) file.maps.shared = maps.maps.front();
  for (const MapRecord& map : maps.maps) file.maps.add(map);
  return to_json_text(file);
}

RunMaps parse_maps(std::string_view text, const std::string& source) {
  const MapsFile file = from_json_text<MapsFile>(text, source);
  RunMaps maps{.run = file.run, .maps = {}};
  for (const SharingMap& sharing : file.maps) maps.maps.push_back(sharing.map);
  return maps;
}

std::string study_json(const Experiment& experiment, const Provenance& provenance) {
  return to_json_text(Study{.experiment = experiment, .provenance = provenance, .runs = {}});
}

Study parse_study(std::string_view text, const std::string& source) {
  return from_json_text<Study>(text, source);
}

}  // namespace mapproof
