#include "app/commands.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <memory>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "app/external/external_study.hpp"
#include "app/map/map_folder.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/csv.hpp"
#include "core/base/text/words.hpp"
#include "core/experiment/observed_checkpoint.hpp"
#include "core/json/text_input.hpp"
#include "core/records/maps/map_csv.hpp"
#include "core/records/observations/trajectories.hpp"
#include "core/records/text_forms.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::array kInputs = {ExternalInput::kDistances, ExternalInput::kFeatures,
                                ExternalInput::kHistory};

struct ExportArguments {
  std::string study;
  std::string out;
  std::vector<std::string> what = {"distances", "ground-truth"};
  std::string format = "npy";
};

/// DIR/RUN/SENSOR/STEPS.
fs::path folder_of(const ObservedCheckpoint& checkpoint) {
  return fs::path(slug(checkpoint.run)) / std::string(name(checkpoint.sensor)) /
         fmt::format("{}", checkpoint.steps);
}

/// A matrix as a file of NumPy's format .npy, version 1.0: float64, little endian, by rows.
std::string npy_bytes(const Eigen::MatrixXd& matrix) {
  static_assert(std::endian::native == std::endian::little,
                "elements are written as they are held");
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const RowMajor rows = matrix;
  std::string header = fmt::format(
      "{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}), }}", rows.rows(), rows.cols());
  // The elements begin at a multiple of 64 bytes, behind the magic, the version and the length.
  constexpr std::size_t kAlignment = 64, kFixed = 10;
  header.append(kAlignment - 1 - (kFixed + header.size()) % kAlignment, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xff);
  bytes += static_cast<char>(header.size() >> 8);
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(rows.data()),
               static_cast<std::size_t>(rows.size()) * sizeof(double));
  return bytes;
}

/// Bare numbers, one row per landmark; `inf` and `nan` where there is none.
std::string matrix_csv(const Eigen::MatrixXd& matrix) {
  std::string text;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index k = 0; k < matrix.cols(); ++k)
      fmt::format_to(std::back_inserter(text), "{}{}", k > 0 ? "," : "", matrix(i, k));
    text += "\r\n";
  }
  return text;
}

std::string anchors_csv(const ObservedCheckpoint& checkpoint) {
  std::vector<std::string> names;
  Points positions(std::ssize(checkpoint.anchors), 2);
  for (std::size_t i = 0; i < checkpoint.anchors.size(); ++i) {
    const Eigen::Index row = checkpoint.anchors[i];
    names.push_back(checkpoint.history.names[static_cast<std::size_t>(row)]);
    positions.row(static_cast<Eigen::Index>(i)) = checkpoint.ground_truth_m.row(row);
  }
  return landmarks_csv(names, positions);
}

int export_study(const ExportArguments& arguments, const Invocation& invocation) {
  check_result_folder(arguments.out, "anchors.csv", "export");
  const Study study = read_mapping_study(arguments.study);
  const OutputFolder out(arguments.out);
  const auto asks_for = [&](std::string_view what) {
    return std::ranges::find(arguments.what, what) != arguments.what.end();
  };
  std::size_t files = 1;
  std::string checkpoints = "run,sensor,steps,seed\r\n";
  for (const Run& run : study.runs) {
    bool is_first = true;
    observe_run(study.experiment, run.id, [&](const ObservedCheckpoint& checkpoint) {
      const fs::path run_folder(slug(run.id));
      if (is_first) {
        out.write(run_folder / "anchors.csv", anchors_csv(checkpoint));
        if (asks_for("ground-truth"))
          out.write(run_folder / "ground-truth.csv",
                    landmarks_csv(checkpoint.history.names, checkpoint.ground_truth_m));
        files += asks_for("ground-truth") ? 2 : 1;
        is_first = false;
      }
      checkpoints += fmt::format("{},{},{},{}\r\n", slug(run.id), name(checkpoint.sensor),
                                 checkpoint.steps, checkpoint.seed);
      for (const ExternalInput input : kInputs) {
        if (!asks_for(name(input))) continue;
        const Eigen::MatrixXd matrix = external_input(checkpoint.history, checkpoint.steps, input);
        const fs::path file =
            folder_of(checkpoint) / fmt::format("{}.{}", name(input), arguments.format);
        out.write(file, arguments.format == "npy" ? npy_bytes(matrix) : matrix_csv(matrix));
        ++files;
      }
    });
  }
  out.write("checkpoints.csv", checkpoints);
  invocation.console.result(
      fmt::format("{}: {} of {}\n", arguments.out, counted(static_cast<long long>(files), "file"),
                  counted(std::ssize(study.runs), "run")),
      {{"folder", arguments.out}, {"files", files}, {"runs", study.runs.size()}});
  return kDone;
}

struct ImportArguments {
  std::string study;
  std::string maps;
  ExternalOutputs outputs;
};

bool is_exported(const fs::path& file) {
  return std::ranges::any_of(
      kInputs, [&](ExternalInput input) { return file.stem().string() == name(input); });
}

/// METHOD.csv of one checkpoint.
std::vector<fs::path> maps_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == ".csv" && !is_exported(entry->path()) &&
        !entry->path().filename().string().starts_with('.'))
      files.push_back(entry->path());
  std::ranges::sort(files);
  return files;
}

/// The positions of a file in the rows of the checkpoint; NaN where it has none.
Points positions_of(const fs::path& file, const ObservedCheckpoint& checkpoint) {
  const std::string text = read_file(file);
  const MapRecord map = parse_map_csv(checked_text(text, file.string()), file.string());
  std::map<std::string, Eigen::Index> rows;
  for (std::size_t i = 0; i < checkpoint.history.names.size(); ++i)
    rows[checkpoint.history.names[i]] = static_cast<Eigen::Index>(i);
  Points positions = Points::Constant(std::ssize(rows), 2, kNaN);
  for (std::size_t i = 0; i < map.names.size(); ++i) {
    const auto row = rows.find(map.names[i]);
    if (row == rows.end())
      throw IoError(file.string(), fmt::format("{} is not a landmark of {}",
                                               in_quotes(map.names[i]),
                                               checkpoint_id(checkpoint.run, checkpoint.sensor,
                                                             checkpoint.steps)));
    positions.row(row->second) = map.estimate.row(static_cast<Eigen::Index>(i));
  }
  return positions;
}

std::vector<ExternalMap> maps_of_run(const Experiment& experiment, const RunId& run,
                                     const fs::path& folder, std::set<std::string>& methods) {
  std::vector<ExternalMap> maps;
  observe_run(experiment, run, [&](const ObservedCheckpoint& checkpoint) {
    for (const fs::path& file : maps_in(folder / folder_of(checkpoint))) {
      const std::string method = file.stem().string();
      if (!kMethodId.holds(method))
        throw IoError(file.string(),
                      fmt::format("the name of a method has {}", kMethodId.expected));
      methods.insert(method);
      maps.push_back(
          scored_external_map(experiment, checkpoint, method, positions_of(file, checkpoint)));
    }
  });
  return maps;
}

/// Adds the maps that a method has not given where another map of it is: they are lost.
void add_lost(const Experiment& experiment, const std::vector<Run>& runs,
              const std::set<std::string>& methods, std::vector<ExternalMap>& maps) {
  using Checkpoint = std::tuple<std::string, RunId, Sensor, int>;
  std::set<Checkpoint> there;
  std::set<std::pair<std::string, Sensor>> sensors;
  for (const ExternalMap& map : maps) {
    there.emplace(map.method, map.run, map.sensor, map.steps);
    sensors.emplace(map.method, map.sensor);
  }
  for (const std::string& method : methods)
    for (const Run& run : runs)
      for (const SensorStudy& study : experiment.sensors)
        for (const int steps : study.checkpoints) {
          const Sensor sensor = study.sensor.sensor;
          if (sensors.contains({method, sensor}) &&
              !there.contains({method, run.id, sensor, steps}))
            maps.push_back({.method = method,
                            .run = run.id,
                            .sensor = sensor,
                            .steps = steps,
                            .failure = "there is no file of it"});
        }
}

int import_maps(const ImportArguments& arguments, const Invocation& invocation) {
  check_external_folder(arguments.outputs.out);
  const Study study = read_mapping_study(arguments.study);
  std::set<std::string> methods;
  std::vector<ExternalMap> maps;
  for (const Run& run : study.runs)
    for (ExternalMap& map : maps_of_run(study.experiment, run.id, arguments.maps, methods))
      maps.push_back(std::move(map));
  if (maps.empty())
    throw IoError(arguments.maps,
                  "has no map: expected RUN/SENSOR/STEPS/METHOD.csv, as in "
                  "layout-1-pose-1/bearing/2000/tsne.csv");
  add_lost(study.experiment, study.runs, methods, maps);
  MethodLabels labels;
  for (const std::string& method : methods) labels.push_back({method, method});
  return write_external_study(study, maps, labels, "Maps of others were imported as files.",
                              arguments.outputs, invocation);
}

}  // namespace

Action export_command(CLI::App& app) {
  auto arguments = std::make_shared<ExportArguments>();
  app.description("Write what a study's methods map as files, for methods of others");
  app.footer(
      "Examples:\n"
      "  mapproof export out --what distances,features --format npy --out files\n"
      "  mapproof import out files --out out-bench\n\n"
      "RUN/SENSOR/STEPS/distances.npy and others have one row per landmark, in the order of\n"
      "RUN/ground-truth.csv. RUN/anchors.csv has the landmarks with known position.\n");
  app.add_option("STUDY", arguments->study, "Folder of a study of the mapping methods")
      ->required()
      ->check(names_folder());
  add_out_option(app, arguments->out, "Folder for the files")->required();
  app.add_option("--what", arguments->what,
                 "distances, features, history, ground-truth; several with commas")
      ->transform(one_of({"distances", "features", "history", "ground-truth"}))
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  app.add_option("--format", arguments->format, "Of matrices: npy or csv")
      ->transform(one_of({"npy", "csv"}))
      ->capture_default_str();
  group_options(app, {{"Input", {"STUDY"}}, {"Output", {"--what", "--format"}}});
  return [arguments](const Invocation& invocation) { return export_study(*arguments, invocation); };
}

Action import_command(CLI::App& app) {
  auto arguments = std::make_shared<ImportArguments>();
  app.description("Compare maps that others made of exported files with the methods of a study");
  app.footer(
      "Examples:\n"
      "  mapproof export out --out files\n"
      "  mapproof import out files --out out-bench\n\n"
      "MAPS/RUN/SENSOR/STEPS/METHOD.csv holds one map: name, x_m, y_m in any frame; a landmark "
      "may\n"
      "be missing. A map that a method gave of some checkpoint and not of another one is lost.\n");
  app.add_option("STUDY", arguments->study, "Folder of a study of the mapping methods")
      ->required()
      ->check(names_folder());
  app.add_option("MAPS", arguments->maps, "Folder of the maps")->required()->check(names_folder());
  add_external_outputs(app, arguments->outputs);
  group_options(app, {{"Input", {"STUDY", "MAPS"}}});
  return [arguments](const Invocation& invocation) { return import_maps(*arguments, invocation); };
}

}  // namespace mapproof
