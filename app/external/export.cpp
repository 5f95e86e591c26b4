#include "app/commands.hpp"

#include <algorithm>
#include <bit>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "app/external/external_study.hpp"
#include "app/map/map_folder.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/text/words.hpp"
#include "core/experiment/external_input.hpp"
#include "core/records/observations/trajectories.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string study;
  std::string out;
  std::vector<std::string> what = {"distances", "ground-truth"};
  std::string format = "npy";
};

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
  const LockedFolder folder(arguments.out);
  const OutputFolder& out = folder.files();
  const auto asks_for = [&](std::string_view what) {
    return std::ranges::find(arguments.what, what) != arguments.what.end();
  };
  const bool with_ground_truth = asks_for("ground-truth") || asks_for("truth");
  std::size_t files = 1;
  std::string checkpoints = "run,sensor,steps,seed\r\n";
  for (const Run& run : study.runs) {
    bool is_first = true;
    observe_run(study.experiment, run.id, [&](const ObservedCheckpoint& checkpoint) {
      const fs::path run_folder(slug(run.id));
      if (is_first) {
        out.write(run_folder / "anchors.csv", anchors_csv(checkpoint));
        if (with_ground_truth)
          out.write(run_folder / "ground-truth.csv",
                    landmarks_csv(checkpoint.history.names, checkpoint.ground_truth_m));
        files += with_ground_truth ? 2 : 1;
        is_first = false;
      }
      checkpoints += fmt::format("{},{},{},{}\r\n", slug(run.id), name(checkpoint.sensor),
                                 checkpoint.steps, checkpoint.seed);
      for (const ExternalInput input : kExternalInputs) {
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

}  // namespace

Action export_command(CLI::App& app) {
  auto arguments = std::make_shared<ExportArguments>();
  app.description("Write what a study's methods map as files, for methods of others");
  app.footer(
      "Examples:\n"
      "  mapproof export out --what distances,features --format npy --out files\n"
      "  mapproof import out files --out out-import\n\n"
      "RUN/SENSOR/STEPS/distances.npy and others have one row per landmark, in the order of\n"
      "RUN/ground-truth.csv. RUN/anchors.csv has the landmarks with known position.\n");
  app.add_option("STUDY", arguments->study, "Folder of a study of the mapping methods")
      ->required()
      ->check(names_folder());
  add_out_option(app, arguments->out, "Folder for the files")->required();
  app.add_option("--what", arguments->what,
                 "distances, features, history, ground-truth (or truth); several with commas")
      ->transform(one_of({"distances", "features", "history", "ground-truth", "truth"}))
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  app.add_option("--format", arguments->format, "Of matrices: npy or csv")
      ->transform(one_of({"npy", "csv"}))
      ->capture_default_str();
  group_options(app, {{"Input", {"STUDY"}}, {"Output", {"--what", "--format"}}});
  return [arguments](const Invocation& invocation) { return export_study(*arguments, invocation); };
}

}  // namespace mapproof
