#include "app/map/incremental.hpp"

#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "app/map/id_check.hpp"
#include "app/map/scan_sizes.hpp"
#include "core/align/aligned_to.hpp"
#include "core/align/rigid.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/descriptor.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/files/unpacker.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "core/incremental/incremental_map.hpp"
#include "core/json/text_input.hpp"
#include "core/pairs/pair_map.hpp"
#include "core/range_slam/factors/incremental_spectral_map.hpp"
#include "core/records/detections/detection_stream.hpp"
#include "core/records/observations/observation_stream.hpp"
#include "reports/sections/association_text.hpp"

namespace mapproof {
namespace {

// Maps of what was read so far.

/// A map of the landmarks `names` after so many steps.
MapDraft begin_update(Observed observed, MapOrigin origin, std::vector<std::string> names,
                      Eigen::Index step) {
  MapDraft draft{.observed = std::move(observed)};
  draft.result.record = begin_record(std::move(origin), std::move(names), step);
  draft.result.read = {{"Landmarks", std::to_string(draft.result.record.names.size())},
                       {"Steps read", std::to_string(step)}};
  return draft;
}

void add_remarks(MapDraft& draft, const std::vector<std::string>& remarks) {
  draft.result.remarks.insert(draft.result.remarks.end(), remarks.begin(), remarks.end());
}

constexpr std::ptrdiff_t kMostIncremental = 2000;  ///< Landmarks, for the memory of their pairs.

/// Values of one sensor.
class IncrementalValues : public IncrementalSource {
 public:
  explicit IncrementalValues(const MapJob& job)
      : job_(job),
        sensor_(*sensor_named(job.sensor)),
        stream_(input_name(job.path), sensor_, job.table_format()),
        map_(sensor_, {.setting = job.setting, .embedder = job.embedder}) {}

  void take(std::string_view bytes) override { stream_.take(bytes); }
  void drop_half_line() override { stream_.drop_half_line(); }
  void end() override { stream_.end(); }
  long steps() const override { return map_.steps(); }

  long take_steps() override {
    const std::vector<StreamedStep> steps = stream_.steps();
    if (steps.empty()) return 0;
    if (std::ssize(stream_.names()) > kMostIncremental)
      throw IoError(input_name(job_.path),
                    fmt::format("names more than {} landmarks, too many for an "
                                "incremental map; map the whole file",
                                kMostIncremental));
    map_.grow(std::ssize(stream_.names()));
    for (const StreamedStep& step : steps) {
      std::vector<StepEntry> entries;
      for (const auto& [landmark, value] : step.values) entries.push_back({landmark, value});
      map_.add(entries);
    }
    return std::ssize(steps);
  }

  MapDraft update() override {
    const IncrementalUpdate update = map_.update();
    std::vector<std::string> names = stream_.names();
    names.resize(static_cast<std::size_t>(map_.landmarks()));
    // No steps are kept that could be compared with one another.
    MapDraft draft =
        begin_update(NotKept{FitMissing::kNoiseModel}, FromSensor{sensor_, update.setting},
                     std::move(names), map_.steps());
    draft.setting = update.setting;
    take_embedding(draft, update.embedding);
    draft.reference =
        known_so_far(draft.result.record, job_.known_anchors, job_.known_ground_truth);
    return draft;
  }

  MapDraft last_update() override {
    MapDraft draft = update();
    add_remarks(draft, stream_.remarks());
    return draft;
  }

 private:
  const MapJob& job_;
  Sensor sensor_;
  ObservationStream stream_;
  IncrementalMap map_;
};

/// Range and bearing.
class IncrementalPairs : public IncrementalSource {
 public:
  explicit IncrementalPairs(const MapJob& job)
      : job_(job), stream_(input_name(job.path), job.table_format()) {}

  void take(std::string_view bytes) override { stream_.take(bytes); }
  void drop_half_line() override { stream_.drop_half_line(); }
  void end() override { stream_.end(); }
  long steps() const override { return scans_.steps(); }

  long take_steps() override {
    const std::vector<StreamedScan> scans = stream_.scans();
    for (const StreamedScan& scan : scans)
      scans_.add({scan.scan.robot, scan.scan.key}, scan.detections);
    return std::ssize(scans);
  }

  MapDraft update() override {
    DetectionLog log = log_so_far();
    std::vector<std::string> noticed;
    if (job_.find_moved) {
      if (watch_.is_due(log.steps))
        for (const NoticedMove& move : watch_.check(scans_, log))
          noticed.push_back(
              fmt::format("After {} scans: {}.", log.steps, described(move.found, log)));
      log = watch_.split(scans_, std::move(log));
    }
    MapDraft draft = map_of(std::move(log));
    add_remarks(draft, noticed);
    return draft;
  }

  MapDraft last_update() override {
    AssociationOutcome outcome{.log = log_so_far()};
    if (job_.find_moved) {
      const auto M = static_cast<Eigen::Index>(outcome.log.names.size());
      outcome =
          with_association_checked(outcome.log, {.find_moved = true}, Points::Constant(M, 2, kNaN));
    }
    const ScanSizes sizes = scan_sizes(outcome.log);
    MapDraft draft = map_of(std::move(outcome.log));
    add_scan_sizes(sizes, draft.result);
    draft.result.members.push_back({"data_association", association_json(outcome.facts)});
    add_remarks(draft, stream_.remarks());
    add_remarks(draft, outcome.remarks);
    return draft;
  }

 private:
  DetectionLog log_so_far() const { return scans_.log(stream_.names(), stream_.is_timed()); }

  MapDraft map_of(DetectionLog log) const {
    const Embedding embedding = pair_map_of(log).embedding;
    DetectionSource source{};
    source.log = std::move(log);
    const DetectionLog& kept = source.log;
    MapDraft draft = begin_update(source, FromPairs{}, kept.names, kept.steps);
    take_embedding(draft, embedding);
    draft.reference =
        known_so_far(draft.result.record, job_.known_anchors, job_.known_ground_truth);
    return draft;
  }

  const MapJob& job_;
  DetectionStream stream_;
  IncrementalLog scans_;
  MovedWatch watch_{MovedOptions{.is_contrasted = true}};
};

constexpr std::size_t kEnoughAnchors = 4;  ///< Landmarks, for a map by known ones.

/// Ranges that are taken together.
class IncrementalRanges : public IncrementalSource {
 public:
  explicit IncrementalRanges(const MapJob& job)
      : job_(job), stream_(input_name(job.path), Sensor::kRange, job.table_format()) {}

  void take(std::string_view bytes) override { stream_.take(bytes); }
  void drop_half_line() override { stream_.drop_half_line(); }
  void end() override { stream_.end(); }
  long steps() const override { return map_ ? static_cast<long>(map_->steps()) : 0; }

  long take_steps() override {
    const long before = steps();
    for (const StreamedStep& step : stream_.steps()) add(step);
    return steps() - before;
  }

  MapDraft update() override {
    std::vector<std::string> names;
    for (const Eigen::Index landmark : landmarks_)
      names.push_back(stream_.names()[static_cast<std::size_t>(landmark)]);
    MapDraft draft =
        begin_update(NotKept{FitMissing::kOdometry}, FromRanges{}, std::move(names), steps());
    MapRecord& record = draft.result.record;
    // The map holds all of its landmarks or none.
    record.estimate = Points::Zero(std::ssize(landmarks_), 2);
    draft.reference = known_so_far(record, job_.known_anchors, job_.known_ground_truth);
    const std::vector<Eigen::Index>& anchors = draft.reference.anchors;
    const SpectralMap map =
        anchors.size() >= kEnoughAnchors
            ? map_->map({anchors, draft.reference.positions_m(anchors, Eigen::all)})
            : map_->map();
    record.statuses.insert(record.statuses.end(), map.statuses.begin(), map.statuses.end());
    if (map.empty())
      record.estimate.setConstant(kNaN);
    else
      record.estimate = landmarks_of(map.C);
    return draft;
  }

  MapDraft last_update() override {
    MapDraft draft = update();
    std::vector<std::string>& remarks = draft.result.remarks;
    add_remarks(draft, stream_.remarks());
    if (incomplete_ > 0)
      remarks.push_back(fmt::format("{} without a range to every landmark: left out.",
                                    counted(incomplete_, "step")));
    std::vector<std::string> late;
    for (std::size_t i = 0; i < stream_.names().size(); ++i)
      if (column_of(static_cast<Eigen::Index>(i)) == std::ssize(landmarks_))
        late.push_back(stream_.names()[i]);
    if (!late.empty())
      remarks.push_back(fmt::format("Not on the map, as the first step has no range to them: {}.",
                                    listed(late, 11)));
    return draft;
  }

 private:
  /// In the map; as many as it has for a landmark that it does not have.
  Eigen::Index column_of(Eigen::Index landmark) const {
    return std::ranges::find(landmarks_, landmark) - landmarks_.begin();
  }

  void add(const StreamedStep& step) {
    if (!map_) {
      if (step.values.empty()) return;
      for (const auto& [landmark, range_m] : step.values) landmarks_.push_back(landmark);
      std::ranges::sort(landmarks_);
      map_.emplace(std::ssize(landmarks_));
    }
    Eigen::VectorXd half_squares = Eigen::VectorXd::Constant(std::ssize(landmarks_), kNaN);
    for (const auto& [landmark, range_m] : step.values)
      if (const Eigen::Index column = column_of(landmark); column < half_squares.size())
        half_squares(column) = 0.5 * range_m * range_m;
    if (half_squares.allFinite())
      map_->add(half_squares);
    else
      ++incomplete_;
  }

  const MapJob& job_;
  ObservationStream stream_;
  std::vector<Eigen::Index> landmarks_;  ///< Of the stream's names, those of the first step.
  std::optional<IncrementalSpectralMap> map_;
  std::size_t incomplete_ = 0;  ///< Steps that lack one of them.
};

/// The map before, that one without a frame is aligned to.
class MapBefore {
 public:
  /// Aligns the map to the one before, by the landmarks of both, and keeps it for the next. What
  /// the sensors determine is kept: the scale of ranges, and the reflection with bearings.
  void align(MapRecord& record) {
    if (record.estimate.array().isNaN().all()) return;
    const Points onto = in_rows_of(record);
    if (std::holds_alternative<FromPairs>(record.origin))
      align_without_reflection(record.estimate, onto);
    else if (const auto aligned = std::holds_alternative<FromRanges>(record.origin)
                                      ? aligned_rigidly_to(record.estimate, onto)
                                      : aligned_to(record.estimate, onto))
      record.estimate = *aligned;
    names_ = record.names;
    estimate_ = record.estimate;
  }

 private:
  /// By name: the second positions of moved landmarks stand behind all landmarks, and their number
  /// grows.
  Points in_rows_of(const MapRecord& record) const {
    Points rows = Points::Constant(record.estimate.rows(), 2, kNaN);
    for (std::size_t i = 0; i < record.names.size(); ++i)
      if (const auto found = std::ranges::find(names_, record.names[i]); found != names_.end())
        rows.row(static_cast<Eigen::Index>(i)) = estimate_.row(found - names_.begin());
    return rows;
  }

  static void align_without_reflection(Points& estimate, const Points& onto) {
    std::vector<Eigen::Index> both;
    for (Eigen::Index i = 0; i < estimate.rows(); ++i)
      if (estimate.row(i).allFinite() && onto.row(i).allFinite()) both.push_back(i);
    if (both.size() >= 2)
      estimate = fit_similarity(estimate(both, Eigen::all), onto(both, Eigen::all),
                                Alignment::kRigid)(estimate);
  }

  std::vector<std::string> names_;
  Points estimate_ = Points(0, 2);
};

/// Whether neither anchors nor a ground truth tie the map to a frame.
bool is_untied(const MapDraft& draft) {
  return draft.result.record.frame == Frame::kSimilarity ||
         (draft.reference.anchors.empty() && !draft.reference.has_ground_truth);
}

/// The update, ended as any other map is.
MapResult finished(MapDraft draft, const MapJob& job, MapBefore& before) {
  draft = last_steps(std::move(draft), job);
  if (is_untied(draft)) before.align(draft.result.record);
  return std::move(draft.result);
}

// The file that grows.

using Clock = std::chrono::steady_clock;

constexpr double kWait_s = 0.2;  ///< Between two checks of a file that does not grow.

volatile std::sig_atomic_t g_asked = 0;

extern "C" void ask_to_end(int) { g_asked = 1; }

/// A file that others write to while it is read, a pipe or a device.
class StreamedFile {
 public:
  /// @param path  "-": standard input. @throws IoError if it cannot be opened.
  explicit StreamedFile(const std::string& path);

  enum class State {
    kMore,      ///< Bytes came.
    kNothing,   ///< None now; there may be more.
    kEnd,       ///< There will be none: a pipe was closed.
    kReplaced,  ///< The file was cut short, removed or replaced by another: what follows is none
                ///< of it.
  };

  /// Reads what is there, at most 64 KiB. Waits for a pipe up to `seconds`, for a signal less.
  /// @throws IoError if it cannot be read.
  State read(std::string& bytes, double seconds);

  const std::string& name() const { return name_; }

 private:
  bool replaced() const;

  std::string path_;
  std::string name_;
  Descriptor file_;
  bool regular_ = false;
  long long at_ = 0;
};

/// Takes SIGINT and SIGTERM as long as it lives: they ask to end, instead of ending the program.
class EndSignals {
 public:
  EndSignals();
  ~EndSignals();
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;

  bool asked() const;

 private:
  struct sigaction interrupt_;
  struct sigaction terminate_;
};

StreamedFile::StreamedFile(const std::string& path)
    : path_(path), name_(input_name(path)), file_(open_streamed(path)) {
  struct stat status {};
  if (::fstat(file_.get(), &status) != 0) throw IoError(name_, std::strerror(errno));
  regular_ = S_ISREG(status.st_mode);
}

StreamedFile::State StreamedFile::read(std::string& bytes, double seconds) {
  bytes.clear();
  pollfd wait{.fd = file_.get(), .events = POLLIN, .revents = 0};
  // A regular file is always ready: only others are waited for here.
  if (!regular_ && ::poll(&wait, 1, static_cast<int>(std::ceil(1000.0 * seconds))) <= 0)
    return State::kNothing;
  std::array<char, 65536> buffer;
  const ssize_t count = ::read(file_.get(), buffer.data(), buffer.size());
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) return State::kNothing;
  if (count < 0) throw IoError(name_, std::strerror(errno));
  at_ += count;
  bytes.assign(buffer.data(), static_cast<std::size_t>(count));
  if (count > 0) return State::kMore;
  if (!regular_) return State::kEnd;
  if (replaced()) return State::kReplaced;
  // A file as standard input is not streamed: it ends here.
  if (path_ == "-") return State::kEnd;
  ::poll(nullptr, 0, static_cast<int>(std::ceil(1000.0 * seconds)));
  return State::kNothing;
}

bool StreamedFile::replaced() const {
  struct stat here {
  }, there{};
  if (::fstat(file_.get(), &here) != 0 || here.st_size < at_) return true;
  if (path_ == "-") return false;
  return ::stat(path_.c_str(), &there) != 0 || here.st_ino != there.st_ino ||
         here.st_dev != there.st_dev;
}

EndSignals::EndSignals() {
  g_asked = 0;
  struct sigaction ask {};
  ask.sa_handler = ask_to_end;
  ::sigaction(SIGINT, &ask, &interrupt_);
  ::sigaction(SIGTERM, &ask, &terminate_);
}

EndSignals::~EndSignals() {
  ::sigaction(SIGINT, &interrupt_, nullptr);
  ::sigaction(SIGTERM, &terminate_, nullptr);
}

bool EndSignals::asked() const { return g_asked != 0; }

/// How often an incremental map is updated.
struct UpdateInterval {
  long steps = 0;        ///< After so many; 0: by time.
  double seconds = 1.0;  ///< After so long, if there is a step more.
};

/// "100": steps; "2s", "0.5s": seconds. @throws InvalidInput, naming the option.
UpdateInterval update_interval(const std::string& text) {
  const bool seconds = text.ends_with('s');
  const auto number = number_in(std::string_view(text).substr(0, text.size() - (seconds ? 1 : 0)));
  const bool right =
      number && *number > 0.0 && *number <= 1e6 && (seconds || *number == std::floor(*number));
  if (!right)
    throw InvalidInput("--every: expected a number of steps, or of seconds as 2s, got " +
                       in_quotes(text));
  return seconds ? UpdateInterval{.steps = 0, .seconds = *number}
                 : UpdateInterval{.steps = static_cast<long>(*number), .seconds = 0.0};
}

/// Whether it is time for an update.
class Due {
 public:
  explicit Due(const UpdateInterval& every) : every_(every) {}

  bool after(long steps) {
    steps_ += steps;
    if (steps_ == 0) return false;
    if (every_.steps > 0) return steps_ >= every_.steps;
    return std::chrono::duration<double>(Clock::now() - last_).count() >= every_.seconds;
  }

  void done() {
    steps_ = 0;
    last_ = Clock::now();
  }

 private:
  UpdateInterval every_;
  long steps_ = 0;
  Clock::time_point last_ = Clock::now();
};

/// A streamed file, and its map so far.
struct StreamedInput {
  StreamedFile file;
  Unpacker unpacker;
  std::unique_ptr<IncrementalSource> source;
  std::vector<std::string> remarks = {};  ///< On how it ended.
};

/// Takes in what comes, and calls `update` whenever it is time.
/// @return Whether the file came to its end; else it was replaced, or a signal came.
template <typename Update>
bool read_to_end(StreamedInput& input, const UpdateInterval& every, const EndSignals& signals,
                 const Update& update) {
  Due due(every);
  std::string bytes;
  while (!signals.asked()) {
    const StreamedFile::State state = input.file.read(bytes, kWait_s);
    if (state == StreamedFile::State::kEnd) return true;
    if (state == StreamedFile::State::kReplaced) {
      input.remarks.push_back(input.file.name() +
                              " was cut short, removed or replaced: the map holds what was read "
                              "before. Start again for the new file.");
      return false;
    }
    input.source->take(input.unpacker.take(bytes));
    if (!due.after(input.source->take_steps())) continue;
    update(input.source->update());
    due.done();
  }
  return false;
}

/// Takes in the rest. @throws IoError if there were no observations at all.
void take_rest(StreamedInput& input, bool ended) {
  IncrementalSource& source = *input.source;
  if (ended) {
    input.unpacker.end();
    source.take(input.unpacker.take({}));
  }
  const bool is_cut = input.unpacker.is_cut();
  if (ended && is_cut)
    input.remarks.push_back(
        fmt::format("{} is {}'ed and stops before its end: the map is of what there was.",
                    input.file.name(), input.unpacker.packing()));
  if (!ended || is_cut) source.drop_half_line();
  source.end();
  source.take_steps();
  if (source.steps() == 0) throw IoError(input.file.name(), "holds no observations");
}

}  // namespace

std::unique_ptr<IncrementalSource> incremental_values(const MapJob& job) {
  return std::make_unique<IncrementalValues>(job);
}

std::unique_ptr<IncrementalSource> incremental_pairs(const MapJob& job) {
  return std::make_unique<IncrementalPairs>(job);
}

std::unique_ptr<IncrementalSource> incremental_ranges(const MapJob& job) {
  return std::make_unique<IncrementalRanges>(job);
}

int write_incremental(const MapJob& job, MakeIncremental make, const MapOutput& location,
                      const Invocation& invocation) {
  const UpdateInterval every = update_interval(job.every);
  const MapFolder folder(location.out);
  const Console& console = invocation.console;
  const EndSignals signals;
  StreamedInput input{.file = StreamedFile(job.path),
                      .unpacker = Unpacker(input_name(job.path)),
                      .source = make(job)};
  MapBefore before;
  const bool ended = read_to_end(input, every, signals, [&](MapDraft draft) {
    for (const std::string& noticed : draft.result.remarks) console.warning(noticed);
    const MapResult map = finished(std::move(draft), job, before);
    write_map(folder, location, map, false);
    console.detail(fmt::format("{} steps, {} landmarks", map.record.step, map.record.names.size()));
  });
  take_rest(input, ended);
  MapDraft draft = input.source->last_update();
  draft.result.remarks.insert(draft.result.remarks.begin(), input.remarks.begin(),
                              input.remarks.end());
  add_remarks(draft,
              remarks_of_reference(draft.result.record, job.known_anchors, job.known_ground_truth));
  const MapResult last = finished(std::move(draft), job, before);
  const std::string undrawn = write_map(folder, location, last);
  if (!undrawn.empty()) console.warning(undrawn);
  for (const auto& sentences : {last.remarks, last.warnings})
    for (const std::string& sentence : sentences) console.warning(sentence);
  return report_map(last, location, invocation);
}

}  // namespace mapproof
