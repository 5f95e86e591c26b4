#include "app/map/joint_map_sources.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/words.hpp"

namespace mapproof {
namespace {

void require_different(const std::vector<ObservationSource>& sources) {
  for (std::size_t b = 0; b < sources.size(); ++b)
    for (std::size_t a = 0; a < b; ++a)
      if (sources[a].history.sensor == sources[b].history.sensor)
        throw IoError(sources[b].path,
                      fmt::format("holds {}, as {} does; each kind once",
                                  name(sources[b].history.sensor), sources[a].path));
}

/// The history in the rows of `names`; rows that it does not have are missing throughout.
ObservationHistory in_rows(const ObservationHistory& history,
                           const std::vector<std::string>& names) {
  ObservationHistory result{.sensor = history.sensor, .names = names, .values = {}};
  result.values = Eigen::MatrixXd::Constant(std::ssize(names), history.steps(), kNaN);
  for (std::size_t i = 0; i < history.names.size(); ++i) {
    const auto row = std::ranges::find(names, history.names[i]) - names.begin();
    result.values.row(row) = history.values.row(static_cast<Eigen::Index>(i));
  }
  return result;
}

/// What of landmarks and steps is not in all files.
void remark_differences(const std::vector<ObservationSource>& sources,
                        const std::vector<std::string>& names, MapResult& result) {
  std::vector<std::string> partial;
  for (const std::string& name : names)
    if (!std::ranges::all_of(sources, [&](const ObservationSource& source) {
          return std::ranges::find(source.history.names, name) != source.history.names.end();
        }))
      partial.push_back(printable(name));
  if (!partial.empty())
    result.remarks.push_back(
        fmt::format("{} not in all files ({}): placed by the sensors that have them.",
                    counted(std::ssize(partial), "landmark"), listed(partial, 10)));
  if (std::ranges::any_of(sources, [&](const ObservationSource& source) {
        return source.history.steps() != sources.front().history.steps();
      }))
    result.remarks.emplace_back(
        "The files hold different numbers of steps: each sensor's distances are over its own.");
}

/// Names, kinds and steps of the files, for the report.
void list_sources(const std::vector<ObservationSource>& sources, MapResult& result) {
  for (const ObservationSource& source : sources) {
    const std::string kind(name(source.history.sensor));
    const auto missing = static_cast<double>(source.history.values.array().isNaN().count());
    result.read.emplace_back(
        "Sensor " + kind,
        fmt::format("{}: {}, {} steps, {:.1f} % missing", source.path,
                    counted(source.history.landmarks(), "landmark"), source.history.steps(),
                    100.0 * missing / static_cast<double>(source.history.values.size())));
    for (const std::string& remark : source.remarks)
      if (std::ranges::find(result.remarks, remark) == result.remarks.end())
        result.remarks.push_back(remark);
  }
}

}  // namespace

std::vector<std::string> joint_names(const std::vector<ObservationSource>& sources) {
  require_different(sources);
  std::vector<std::string> names = sources.front().history.names;
  for (const ObservationSource& source : sources) {
    std::size_t common = 0;
    std::vector<std::string> more;
    for (const std::string& name : source.history.names)
      if (std::ranges::find(names, name) != names.end())
        ++common;
      else
        more.push_back(name);
    if (common < 3)
      throw IoError(
          source.path,
          fmt::format("shares {} with {}; one map of both needs 3 or more in common",
                      counted(static_cast<long long>(common), "landmark"), sources.front().path));
    names.insert(names.end(), more.begin(), more.end());
  }
  return names;
}

std::vector<ObservationHistory> common_histories(const std::vector<ObservationSource>& sources,
                                                 const std::vector<std::string>& names,
                                                 const MapOptions& options) {
  const double K = options.setting.parameter.value_or(0.0);
  if (on_graph(options.setting.method) && K >= static_cast<double>(names.size()))
    throw IoError(
        sources.front().path,
        fmt::format("K = {:g} needs more than {:g} landmarks, {} are there", K, K, names.size()));
  std::vector<ObservationHistory> histories;
  for (const ObservationSource& source : sources) {
    if (options.steps > source.history.steps())
      throw IoError(source.path, fmt::format("--steps {}: it holds {} observations", options.steps,
                                             source.history.steps()));
    histories.push_back(in_rows(source.history, names));
    if (options.steps > 0)
      histories.back().values = Eigen::MatrixXd(histories.back().values.leftCols(options.steps));
  }
  return histories;
}

std::optional<Points> common_truth(const std::vector<ObservationSource>& sources,
                                   const std::vector<std::string>& names) {
  const auto source = std::ranges::find_if(
      sources, [](const ObservationSource& one) { return one.truth_m.has_value(); });
  if (source == sources.end()) return std::nullopt;
  Points truth_m = Points::Constant(std::ssize(names), 2, kNaN);
  for (std::size_t i = 0; i < source->history.names.size(); ++i)
    truth_m.row(std::ranges::find(names, source->history.names[i]) - names.begin()) =
        source->truth_m->row(static_cast<Eigen::Index>(i));
  return truth_m;
}

void describe_sources(const std::vector<ObservationSource>& sources,
                      const std::vector<std::string>& names, MapResult& result) {
  list_sources(sources, result);
  remark_differences(sources, names, result);
}

std::vector<Eigen::Index> unseen_by_all(const std::vector<ObservationSource>& sources,
                                        const std::vector<ObservationHistory>& histories,
                                        const MapOptions& options, MapResult& result) {
  std::vector<int> misses(histories.front().names.size(), 0);
  for (std::size_t s = 0; s < histories.size(); ++s) {
    const std::vector<Eigen::Index> unseen = unseen_landmarks(histories[s], histories[s].steps());
    if (unseen.size() == misses.size())
      throw IoError(sources[s].path, "holds no observation of any landmark");
    for (const Eigen::Index row : unseen) ++misses[static_cast<std::size_t>(row)];
  }
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < misses.size(); ++i)
    if (misses[i] == static_cast<int>(histories.size()))
      rows.push_back(static_cast<Eigen::Index>(i));
  if (rows.empty()) return rows;
  if (!options.drop_unseen && !sources.front().truth_m)
    throw IoError(
        sources.front().path,
        fmt::format("landmark \"{}\" is never observed by any of the sensors; remove it, "
                    "or pass --drop-unseen to map the others",
                    printable(histories.front().names[static_cast<std::size_t>(rows.front())])));
  result.remarks.push_back(
      fmt::format("{} of {} landmarks were never observed by any of the sensors and are left out.",
                  rows.size(), misses.size()));
  return rows;
}

}  // namespace mapproof
