#include "app/map/incremental_map.hpp"

#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <memory>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/descriptor.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/files/unpacker.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

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

/// The map of all there was, explained.
MapResult last_map(StreamedInput& input) {
  MapResult last = input.source->last_update();
  last.remarks.insert(last.remarks.begin(), input.remarks.begin(), input.remarks.end());
  last.facts = {{"Observations", input.file.name()},
                {"Sensor", sensor_label(last.record)},
                {"Landmarks", std::to_string(last.record.names.size())},
                {"Steps read", std::to_string(last.record.step)},
                {"Method", method_label(last.record)}};
  last.facts.insert(last.facts.end(), last.read.begin(), last.read.end());
  return last;
}

}  // namespace

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

int write_incremental(const IncrementalRequest& request, const MapOutput& location,
                      const Invocation& invocation) {
  const MapFolder folder(location.out);
  const Console& console = invocation.console;
  const EndSignals signals;
  StreamedInput input{.file = StreamedFile(request.path),
                      .unpacker = Unpacker(input_name(request.path)),
                      .source = nullptr};
  IncrementalTable table = request.table;
  table.source = input.file.name();
  input.source = request.source(table);
  const bool ended = read_to_end(input, request.every, signals, [&](const MapResult& map) {
    write_map(folder, location, map, false);
    for (const std::string& remark : map.remarks) console.warning(remark);
    console.detail(fmt::format("{} steps, {} landmarks", map.record.step, map.record.names.size()));
  });
  take_rest(input, ended);
  const MapResult last = last_map(input);
  write_map(folder, location, last);
  for (const std::string& remark : last.remarks) console.warning(remark);
  return report_map(last, location, invocation);
}

}  // namespace mapproof
