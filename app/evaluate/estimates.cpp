#include "app/evaluate/estimates.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/json/text_input.hpp"
#include "core/records/evaluations/space_path_text.hpp"
#include "core/records/observations/landmarks_csv.hpp"
#include "core/records/ranges/range_companions.hpp"
#include "core/records/ranges/range_log_g2o.hpp"
#include "core/records/tables/column_names.hpp"
#include "core/records/tables/table_reader.hpp"
#include "core/records/tables/table_stream.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

LandmarkPositions positions_of(NamedPoints points) {
  return {.names = std::move(points.names), .positions_m = std::move(points.positions_m)};
}

/// Whether any row of a g2o file begins with one of the words.
bool has_vertex(std::string_view text, const std::string& source,
                std::initializer_list<std::string_view> kinds) {
  TableReader reader(text, source, TableReader::kBlanks);
  TableRow row;
  while (reader.next(row))
    if (std::ranges::find(kinds, row.cells.front()) != kinds.end()) return true;
  return false;
}

/// A source of a text that is at hand.
ByteSource source_of(const std::string& text, const std::string& name) {
  return {name, [rest = std::string_view(text)](std::span<char> to) mutable {
            const std::size_t count = std::min(rest.size(), to.size());
            std::copy_n(rest.begin(), count, to.begin());
            rest.remove_prefix(count);
            return count;
          }};
}

EvaluatedFile read_graph(const std::string& text, const std::string& name) {
  EvaluatedFile result;
  if (has_vertex(checked_text(text, name), name, {"VERTEX_SE2", "VERTEX_SE3:QUAT"})) {
    ByteSource source = source_of(text, name);
    result.path = read_space_path(source);
  }
  if (has_vertex(checked_text(text, name), name, {"VERTEX_XY"})) {
    ByteSource source = source_of(text, name);
    result.landmarks = positions_of(read_g2o_landmarks(source));
  }
  if (!result.path && !result.landmarks)
    throw IoError(name, "has no vertex of a pose or of a landmark");
  return result;
}

/// Whether a header is that of a path in the plane, `t, x, y` and perhaps `heading`: it names times
/// and no landmarks.
bool names_times(const TableRow& row) {
  const auto has = [&](ColumnRole role) {
    for (std::size_t i = 0; i < row.cells.size(); ++i)
      if (column_heading(row.cells[i], i, {}).role == role) return true;
    return false;
  };
  return !row.cells.front().starts_with('#') && has(ColumnRole::kTime) &&
         !has(ColumnRole::kLandmark);
}

/// A path of the ground in space, at a height of 0.
SpacePath in_space(const Trajectory& path) {
  SpacePath result{
      .time_s = path.time_s, .positions_m = SpacePoints::Zero(path.size(), 3), .orientations = {}};
  result.positions_m.leftCols<2>() = path.positions_m;
  for (const double heading_rad : path.heading_rad)
    result.orientations.push_back(
        Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix());
  return result;
}

/// Rows without a position or a heading are refused. @throws IoError.
SpacePath read_plane_path(ByteSource& source) {
  ColumnNames columns;
  const Trajectory path = read_true_path(source, {}, columns);
  if (const std::string problem = path_problem(path); !problem.empty())
    throw IoError(source.name(), problem);
  return in_space(path);
}

/// A file's name without its last extension, and without what says that it is the ground truth.
std::string sequence_of(const fs::path& file) {
  std::string stem = file.stem().string();
  for (const std::string_view end : {"ground-truth", "ground_truth", "groundtruth", "gt"})
    for (const char before : {'-', '_', '.'})
      if (const std::string tail = before + std::string(end);
          stem.size() > tail.size() && stem.ends_with(tail))
        return stem.substr(0, stem.size() - tail.size());
  return stem;
}

bool is_hidden(const fs::path& file) { return file.filename().string().starts_with('.'); }

/// The files of a folder in ascending order; the file itself otherwise.
std::vector<fs::path> files_of(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return {path};
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(path, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->is_regular_file() && !is_hidden(entry->path())) files.push_back(entry->path());
  if (error) throw IoError(path.string(), "cannot be listed: " + error.message());
  if (files.empty()) throw IoError(path.string(), "holds no file");
  std::ranges::sort(files);
  return files;
}

/// @throws InvalidInput unless a file can have the name everywhere.
std::string checked_name(const std::string& name, std::string_view what) {
  constexpr std::string_view kAllowed =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-+";
  constexpr std::size_t kLongest = 100;
  if (name.empty() || name.size() > kLongest || name.starts_with('.') ||
      name.find_first_not_of(kAllowed) != std::string::npos)
    throw InvalidInput(fmt::format(
        "{} {}: names are 1 to {} letters, digits, '.', '_', '-' and '+', no '.' first; give "
        "another by NAME=FILE",
        what, in_quotes(name), kLongest));
  return name;
}

/// One argument: SYSTEM=PATH or PATH.
struct SystemFiles {
  std::string method;
  bool is_named = false;
  std::vector<fs::path> files;
};

SystemFiles system_of(const std::string& argument) {
  SystemFiles system;
  fs::path path = argument;
  std::error_code error;
  const std::size_t equals = argument.find('=');
  if (equals != std::string::npos && !fs::exists(path, error)) {
    system.method = argument.substr(0, equals);
    system.is_named = true;
    path = argument.substr(equals + 1);
  }
  if (!fs::exists(path, error)) throw IoError(path.string(), "there is no such file");
  if (!system.is_named && fs::is_directory(path, error)) {
    system.method = (path / "").parent_path().filename().string();
    system.is_named = true;
  }
  system.files = files_of(path);
  return system;
}

class Planner {
 public:
  explicit Planner(const std::vector<std::string>& ground_truths) {
    for (const std::string& argument : ground_truths)
      for (const fs::path& file : files_of(argument)) {
        plan_.ground_truths.push_back(file);
        sequences_.push_back(checked_name(sequence_of(file), "the ground truth"));
      }
    const std::set<std::string> different(sequences_.begin(), sequences_.end());
    if (different.size() != sequences_.size())
      throw InvalidInput("two files of the ground truth have the same name");
  }

  EvaluationPlan plan(const std::vector<std::string>& estimates) {
    for (const std::string& argument : estimates) add(system_of(argument));
    name_runs();
    return std::move(plan_);
  }

 private:
  bool has_several() const { return sequences_.size() > 1; }

  void add(const SystemFiles& system) {
    for (const fs::path& file : system.files) {
      const std::string method = system.is_named ? system.method
                                 : has_several() ? file.parent_path().filename().string()
                                                 : file.stem().string();
      EstimateFile& estimate = plan_.estimates.emplace_back();
      estimate.run.method = checked_name(method, "the system");
      estimate.ground_truth = ground_truth_of(file);
      estimate.file = file;
    }
  }

  std::size_t ground_truth_of(const fs::path& file) const {
    if (!has_several()) return 0;
    const std::string stem = file.stem().string();
    std::size_t best = sequences_.size();
    for (std::size_t i = 0; i < sequences_.size(); ++i) {
      const std::string& sequence = sequences_[i];
      const bool fits =
          stem == sequence ||
          (stem.starts_with(sequence) && stem.size() > sequence.size() &&
           std::string_view("-_.").find(stem[sequence.size()]) != std::string_view::npos);
      if (fits && (best == sequences_.size() || sequence.size() > sequences_[best].size()))
        best = i;
    }
    if (best == sequences_.size())
      throw IoError(file.string(),
                    fmt::format("belongs to no ground truth: its name begins with none of {}, ...",
                                sequences_.front()));
    return best;
  }

  /// Numbers the files of one system and sequence, and adds what is lost.
  void name_runs() {
    std::vector<std::string> methods;
    std::map<std::pair<std::string, std::size_t>, std::vector<EstimateFile>> sorted;
    std::size_t most = 1;
    for (EstimateFile& estimate : plan_.estimates) {
      if (std::ranges::find(methods, estimate.run.method) == methods.end())
        methods.push_back(estimate.run.method);
      auto& runs = sorted[{estimate.run.method, estimate.ground_truth}];
      runs.push_back(std::move(estimate));
      most = std::max(most, runs.size());
    }
    plan_.estimates.clear();
    for (const std::string& method : methods)
      for (std::size_t i = 0; i < sequences_.size(); ++i) {
        auto& runs = sorted[{method, i}];
        if (runs.empty()) runs.push_back({.run = {.method = method}, .ground_truth = i});
        for (std::size_t k = 0; k < runs.size(); ++k) {
          EstimateFile& run = runs[k];
          run.run.run = most == 1 ? sequences_[i] : fmt::format("{}-{}", sequences_[i], k + 1);
          run.run.group = has_several() ? sequences_[i] : run.run.run;
          plan_.estimates.push_back(std::move(run));
        }
      }
  }

  EvaluationPlan plan_;
  std::vector<std::string> sequences_;
};

}  // namespace

EvaluatedFile read_evaluated_file(const fs::path& file) {
  ByteSource source(file);
  if (first_row_is(source, names_graph_record, TableReader::kBlanks))
    return read_graph(source.rest(), source.name());
  EvaluatedFile result;
  const bool is_table = first_row_is(source, [](const TableRow& row) {
    return row.cells.size() == 3 || std::ranges::any_of(row.cells, [](std::string_view cell) {
             return !number_in(cell).has_value();
           });
  });
  if (is_table && first_row_is(source, names_times))
    result.path = read_plane_path(source);
  else if (is_table)
    result.landmarks = positions_of(read_landmarks(source));
  else
    result.path = read_space_path(source);
  return result;
}

EvaluationPlan plan_evaluation(const std::vector<std::string>& ground_truths,
                               const std::vector<std::string>& estimates) {
  return Planner(ground_truths).plan(estimates);
}

}  // namespace mapproof
