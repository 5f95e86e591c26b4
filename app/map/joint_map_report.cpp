#include "app/map/joint_map_report.hpp"

#include <algorithm>

#include "app/result_json.hpp"
#include "core/align/aligned_to.hpp"
#include "core/base/not_finite.hpp"
#include "render/figures/maps/map_grid.hpp"

namespace mapproof {

Section mixed_section(const JointMapResult& mixed) {
  Section section{"mixed", "Several sensors in one map", {}};
  section.blocks.emplace_back(Paragraph{{{mixed.sensors.why}}});
  Table table{"mixed-maps",
              "The joint map and each sensor's own",
              {{"Map", "", "", ""},
               {"Method", "", "", ""},
               {"Steps", "", "", ""},
               {"Reliability", "", "",
                "Correlation of the distances from both halves, stepped up "
                "to all steps."},
               {"Weight", "", "", "In the mean distances that the joint map starts from."},
               {"Share", "", "", "In the weights of the joint map's pairs."},
               {"Continuity", "", "", "Share of all sensors' neighbourhoods that the map keeps."},
               {"MPE", "m", "", "Where the truth is known."},
               {"MOE", "%", "", "Where the truth is known."}},
              {},
              {}};
  for (std::size_t k = 0; k < mixed.maps.size(); ++k) {
    const ComparedMap& map = mixed.maps[k];
    const std::size_t sensors = mixed.sensors.sensors.size();
    const bool own = k >= 1 && k <= sensors;
    Row row;
    row.source = map.record.id;
    row.cells = {TextCell{map.what}, TextCell{label(*setting_of(map.record))},
                 NumberCell{static_cast<double>(map.record.step), 0}};
    const SensorShare share = own ? mixed.sensors.sensors[k - 1] : SensorShare{};
    for (const double value : {share.reliability, share.weight, share.share})
      row.cells.emplace_back(NumberCell{own ? value : kNaN, 3});
    row.cells.emplace_back(NumberCell{map.continuity, 3});
    const std::optional<Score>& score = map.record.score;
    row.cells.emplace_back(NumberCell{map.mpe_m(), 3});
    row.cells.emplace_back(NumberCell{score ? score->moe_unmirrored_percent : kNaN, 2});
    table.rows.push_back(std::move(row));
  }
  table.notes.emplace_back(
      "By order: the joint map's way on the one sensor alone; what it gains is not the mixing's.");
  section.blocks.emplace_back(std::move(table));
  return section;
}

nlohmann::ordered_json mixed_json(const JointMapResult& mixed) {
  nlohmann::ordered_json object = {{"why", mixed.sensors.why},
                                   {"sensors", nlohmann::ordered_json::array()},
                                   {"maps", nlohmann::ordered_json::array()}};
  for (const SensorShare& one : mixed.sensors.sensors)
    object["sensors"].push_back({{"sensor", name(one.sensor)},
                                 {"reliability", one.reliability},
                                 {"weight", one.weight},
                                 {"share", one.share}});
  for (const ComparedMap& map : mixed.maps)
    object["maps"].push_back({{"map", map.what},
                              {"method", method_name(map.record)},
                              {"continuity", number_or_null(map.continuity)},
                              {"mpe_m", number_or_null(map.mpe_m())}});
  return object;
}

std::optional<Figure> mixed_figure(const JointMapResult& mixed) {
  const MapRecord& joint = mixed.maps.front().record;
  MapGridSpec spec{.id = "sensors", .title = "The joint map and each sensor's own", .maps = {}};
  const std::size_t shown = 1 + mixed.sensors.sensors.size();
  for (std::size_t k = 0; k < std::min(shown, mixed.maps.size()); ++k) {
    MapRecord record = mixed.maps[k].record;
    if (record.estimate.array().isNaN().all() || record.frame != joint.frame) continue;
    // Shapes without a frame are aligned to one another.
    if (k > 0 && joint.frame == Frame::kSimilarity) {
      const std::optional<Points> laid = aligned_to(record.estimate, joint.estimate);
      if (!laid) continue;
      record.estimate = *laid;
    }
    spec.maps.push_back({mixed.maps[k].what, std::move(record)});
  }
  if (spec.maps.size() < 2) return std::nullopt;
  return map_pair_figure(spec);
}

}  // namespace mapproof
