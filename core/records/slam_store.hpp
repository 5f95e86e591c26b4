#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/model/slam_experiment.hpp"
#include "core/model/slam_study.hpp"

namespace mapproof {

/// The folder of a range-only study while it is being made (docs/file-formats.md says what is in
/// it). One process at a time, as StudyStore; the bytes of every file but timings.jsonl depend only
/// on what is written.
class SlamStore {
 public:
  /// Makes the folder, or resumes the study in it; records of another solver are removed.
  /// @throws IoError if the folder holds another experiment, holds files but no study, is in use
  ///         by another process, or cannot be written.
  static SlamStore open(const std::filesystem::path& folder, const SlamExperiment& experiment,
                        const Provenance& provenance);

  SlamStore(SlamStore&&) noexcept;
  SlamStore& operator=(SlamStore&&) noexcept;
  ~SlamStore();

  /// Whether records of an older solver were removed when the folder was opened.
  bool redone() const;

  /// Whether a part need not be made again; damaged files count as not made. A run with a
  /// log counts if it was made of that log.
  bool has_run(const std::string& id, const RangeLog& log) const;
  bool has_run(const std::string& id) const;
  bool has_convergence(const std::string& id) const;
  bool has_histories() const;
  bool has_space() const;

  /// Each writes one part; a run's paths as TUM and CSV come before its record. Thread-safe.
  /// @throws IoError.
  void write(const SlamRun& run, std::span<const SlamTiming> timings);
  void write(const ConvergenceCurve& curve);
  void write(const RangeHistoryStudy& histories);
  void write(const SpaceRun& space);
  /// Appends to timings.jsonl. Thread-safe. @throws IoError.
  void write(std::span<const FactorizationCost> costs);
  void write_session(const Session& session);

 private:
  struct State;
  explicit SlamStore(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Writes each path of a run, the true one among them, as NAME.tum and NAME.csv into a folder of
/// its own, whose earlier files are removed.
/// @throws IoError.
void write_paths(const SlamRun& run, const std::filesystem::path& folder);

/// Whether the folder holds the study.json of a range-only study. @throws IoError if it holds one
/// that cannot be read.
bool is_slam_study(const std::filesystem::path& folder);

/// The study in a folder, as far as it was made: the simulated run first, the data sets in the
/// experiment's order, those without a run in `missing`.
/// @throws IoError if there is no such study or a file of it is damaged.
SlamStudy read_slam_study(const std::filesystem::path& folder);

/// Of a piece timed twice the later one, in order of run and method, of landmarks and steps.
/// @throws IoError.
SlamTimings read_slam_timings(const std::filesystem::path& folder);

}  // namespace mapproof
