#include "app/table_options.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "app/command_line.hpp"
#include "core/records/detections/scan_grouping.hpp"

namespace mapproof {
namespace {

constexpr std::array<std::string_view, 4> kConventions = {"counterclockwise", "clockwise",
                                                          "compass", "east"};

Layout layout_named(std::string_view name) {
  if (name == "wide") return Layout::kWide;
  if (name == "transposed") return Layout::kTransposed;
  return name == "long" ? Layout::kLong : Layout::kAuto;
}

}  // namespace

std::string_view name(BearingConvention convention) {
  return kConventions[static_cast<std::size_t>(convention)];
}

TableFormat TableOptions::format(std::span<const ColumnRole> roles) const {
  const auto* known = std::ranges::find(kConventions, convention);
  const auto named = static_cast<BearingConvention>(known - kConventions.begin());
  return {.unit = degrees || named == BearingConvention::kCompass ? AngleUnit::kDegrees
                                                                  : AngleUnit::kRadians,
          .layout = layout_named(layout),
          .convention = named,
          .columns = column_names(columns, roles),
          .scan_window_s =
              scan_window.empty() ? std::nullopt : std::optional(scan_window_of(scan_window))};
}

void add_table_options(CLI::App& app, TableOptions& options) {
  app.add_flag("--degrees", options.degrees, "Bearings in tables are in degrees");
  app.add_option("--bearing-convention", options.convention,
                 "Zero and sense of the bearings: counterclockwise (to the left) or clockwise from "
                 "the robot's heading; compass: clockwise from north, in degrees; east: "
                 "counter-clockwise from the x axis. A map depends on neither")
      ->transform(one_of(std::vector<std::string>(kConventions.begin(), kConventions.end())))
      ->capture_default_str();
  app.add_option("--layout", options.layout,
                 "Layout of a table: wide, one row per landmark; transposed, one row per time "
                 "step; long, one row per observation")
      ->transform(one_of({"auto", "wide", "transposed", "long"}))
      ->capture_default_str();
  app.add_option("--columns", options.columns,
                 "Headers or numbers of the columns of a table, as in time=Zeit,landmark=Objekt,"
                 "bearing=3; also step, nanoseconds, robot, range, value, x, y, right. A second "
                 "header of a role is that of another file: landmark=Objekt,landmark=Bake")
      ->type_name("NAME=COLUMN")
      ->allow_extra_args(false)
      ->delimiter(',');
  app.add_option("--scan-window", options.scan_window,
                 "Rows of a robot whose time stamps follow one another within SECONDS, or 50ms, "
                 "are one scan (default: found from the gaps between the stamps)")
      ->type_name("SECONDS");
  group_options(
      app,
      {{"Input", {"--degrees", "--bearing-convention", "--layout", "--columns", "--scan-window"}}});
}

}  // namespace mapproof
