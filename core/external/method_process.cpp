#include "core/external/method_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <list>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/child_process.hpp"
#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

using Clock = std::chrono::steady_clock;
using nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "matrices are sent as they are held");

constexpr int kProtocol = 1;
/// An answer holds two numbers per landmark; this is a hundred times as much as it needs.
constexpr std::size_t kLongestReply = std::size_t{1} << 26;
constexpr std::size_t kMostMessages = 4096;

/// @param detail  One line for readers, without its full stop.
template <StatusReason kReason>
ExternalReply failed(std::string detail) {
  constexpr std::size_t kLongestDetail = 300;
  while (detail.ends_with('.')) detail.pop_back();
  return {.coordinates = {}, .failure = status_of<kReason>({printable(detail, kLongestDetail)})};
}

void set_non_blocking(const Descriptor& descriptor) {
  ::fcntl(descriptor.get(), F_SETFL, ::fcntl(descriptor.get(), F_GETFL) | O_NONBLOCK);
}

/// What OpenMP and BLAS libraries take their number of threads from. With several, the processes of
/// --jobs contend for the processors, where threads that wait for each other take minutes for
/// seconds, and sums depend on their number.
constexpr const char* kThreads = "OMP_NUM_THREADS";

/// Both ends of a stream; what is written to a process that ended raises no signal.
std::pair<Descriptor, Descriptor> stream_pair() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw ProcessError(fmt::format("no stream to a process: {}", std::strerror(errno)));
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

/// What ended an exchange.
enum class End { kLine, kTimeout, kClosed, kTooLong };

/// Sends bytes and receives a line, whichever is possible next.
class Exchange {
 public:
  Exchange(const Descriptor& stream, std::string_view bytes, double timeout_s)
      : stream_(stream),
        bytes_(bytes),
        deadline_(Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double>(timeout_s))) {}

  /// @param received  Bytes behind the last line; then those behind this one.
  End run(std::string& received, std::string& line) {
    while (true) {
      if (const std::size_t at = received.find('\n'); at != std::string::npos) {
        line = received.substr(0, at);
        received.erase(0, at + 1);
        return End::kLine;
      }
      if (received.size() > kLongestReply) return End::kTooLong;
      const auto left =
          std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now());
      if (left.count() <= 0) return End::kTimeout;
      pollfd poll{.fd = stream_.get(),
                  .events = static_cast<short>(bytes_.empty() ? POLLIN : POLLIN | POLLOUT),
                  .revents = 0};
      constexpr long long kLongestWait_ms = 1000;
      const int count =
          ::poll(&poll, 1, static_cast<int>(std::min<long long>(left.count(), kLongestWait_ms)));
      if (count <= 0) continue;
      if ((poll.revents & POLLOUT) != 0 && !send()) bytes_ = {};  // It may have answered already.
      if ((poll.revents & (POLLIN | POLLHUP | POLLERR)) != 0 && !receive(received))
        return End::kClosed;
    }
  }

 private:
  static bool is_for_now(int error) {
    return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
  }

  bool send() {
    const ssize_t sent =
        ::send(stream_.get(), bytes_.data(), bytes_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0) return is_for_now(errno);
    bytes_.remove_prefix(static_cast<std::size_t>(sent));
    return true;
  }

  bool receive(std::string& received) const {
    std::array<char, 65536> buffer;
    const ssize_t count = ::recv(stream_.get(), buffer.data(), buffer.size(), MSG_DONTWAIT);
    if (count < 0) return is_for_now(errno);
    received.append(buffer.data(), static_cast<std::size_t>(count));
    return count > 0;
  }

  const Descriptor& stream_;
  std::string_view bytes_;
  Clock::time_point deadline_;
};

}  // namespace

std::string request_bytes(const ExternalRequest& request, ExternalInput input) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const RowMajor rows = request.input;
  const std::size_t bytes = static_cast<std::size_t>(rows.size()) * sizeof(double);
  const ordered_json head{
      {"protocol", kProtocol},
      {"id", request.id},
      {"input", name(input)},
      {"rows", rows.rows()},
      {"columns", rows.cols()},
      {"bytes", bytes},
      {"sensor", request.sensor},
      {"steps", request.steps},
      {"parameter", request.parameter ? ordered_json(*request.parameter) : ordered_json(nullptr)},
      {"seed", request.seed},
      {"landmarks", request.landmarks}};
  std::string text = head.dump() + "\n";
  text.append(reinterpret_cast<const char*>(rows.data()), bytes);
  return text;
}

ExternalReply parse_reply(std::string_view line, const ExternalRequest& request) {
  const auto landmarks = std::ssize(request.landmarks);
  const ordered_json reply = ordered_json::parse(line, nullptr, false);
  if (!reply.is_object()) {
    // Python's json writes them, JSON has neither.
    if (line.find("NaN") != std::string_view::npos ||
        line.find("Infinity") != std::string_view::npos)
      return failed<StatusReason::kMethodNumbers>("a coordinate is NaN or infinite");
    return failed<StatusReason::kMethodReply>("the answer is not a JSON object");
  }
  const auto id = reply.find("id");
  if (id == reply.end() || *id != request.id)
    return failed<StatusReason::kMethodReply>("the answer has another id than the request");
  if (const auto error = reply.find("error"); error != reply.end() && error->is_string())
    return failed<StatusReason::kMethodRefused>(error->get<std::string>());
  const auto found = reply.find("coordinates");
  if (found == reply.end() || !found->is_array() || std::ssize(*found) != landmarks)
    return failed<StatusReason::kMethodReply>(
        fmt::format("\"coordinates\" must be an array of {} rows", landmarks));
  ExternalReply result{.coordinates = Points::Constant(landmarks, 2, kNaN), .failure = {}};
  bool any = false;
  for (Eigen::Index i = 0; i < landmarks; ++i) {
    const ordered_json& row = (*found)[static_cast<std::size_t>(i)];
    if (row.is_null()) continue;
    if (!row.is_array() || row.size() != 2)
      return failed<StatusReason::kMethodReply>(
          fmt::format("row {} of \"coordinates\" is neither two numbers nor null", i));
    if (!row[0].is_number() || !row[1].is_number() || !std::isfinite(row[0].get<double>()) ||
        !std::isfinite(row[1].get<double>()))
      return failed<StatusReason::kMethodNumbers>(
          fmt::format("row {} of \"coordinates\" is not finite", i));
    result.coordinates.row(i) << row[0].get<double>(), row[1].get<double>();
    any = true;
  }
  if (!any) return failed<StatusReason::kMethodNumbers>("no landmark has a position");
  return result;
}

struct MethodProcess::Running {
  Descriptor stream;
  Descriptor messages;
  ChildProcess process;
  std::string received = {};
};

MethodProcess::MethodProcess(const ExternalMethod& method, Disclosed disclosed)
    : method_(method), disclosed_(std::move(disclosed)) {
  if (!method.folder)
    throw InvalidInput(method.name + ": its command is named by records alone and is not started");
}
MethodProcess::~MethodProcess() = default;
MethodProcess::MethodProcess(MethodProcess&&) noexcept = default;

ExternalReply MethodProcess::map(const ExternalRequest& request) {
  if (!running_) {
    auto [ours, theirs] = stream_pair();
    set_non_blocking(ours);
    Descriptor messages = memory_file("messages");
    const std::filesystem::path& folder = *method_.folder;
    // env finds the program by PATH and starts it in the folder.
    ProgramCall call{.program = "/usr/bin/env",
                     .arguments = {"-C", folder.empty() ? "." : folder.string(), "--"}};
    if (std::getenv(kThreads) == nullptr) call.arguments.push_back(std::string(kThreads) + "=1");
    call.arguments.insert(call.arguments.end(), method_.command.begin(), method_.command.end());
    ChildProcess process(call, {theirs.get(), theirs.get(), messages.get()});
    running_ = std::make_unique<Running>(
        Running{std::move(ours), std::move(messages), std::move(process)});
  }
  std::string line;
  const std::string bytes = request_bytes(request, method_.input);
  const End end =
      Exchange(running_->stream, bytes, method_.timeout_s).run(running_->received, line);
  ExternalReply reply;
  const auto disclosed = [&](std::string text) {
    return disclosed_ ? disclosed_(std::move(text)) : text;
  };
  if (end == End::kLine) {
    reply = parse_reply(disclosed(std::move(line)), request);
    if (!reply.failure || reply.failure->reason == StatusReason::kMethodRefused) return reply;
  }
  // Whatever it would still say belongs to no request: the next one gets a new process.
  const std::string said = disclosed(last_line(content_of(running_->messages, kMostMessages)));
  if (end == End::kTimeout) {
    reply = {.coordinates = {},
             .failure = status_of<StatusReason::kMethodTimeout>(method_.timeout_s)};
  } else if (end == End::kTooLong) {
    reply = failed<StatusReason::kMethodReply>("an answer without an end");
  } else if (end == End::kClosed) {
    running_->stream.close();
    const ProcessEnd ended = running_->process.wait();
    constexpr int kNotFound = 127, kNotRun = 126, kEnvFailed = 125;
    const bool never_began =
        ended.exit_code == kNotFound || ended.exit_code == kNotRun || ended.exit_code == kEnvFailed;
    const std::string detail = ended.text() + (said.empty() ? "" : ": " + said);
    reply = never_began ? failed<StatusReason::kMethodNotStarted>(detail)
                        : failed<StatusReason::kMethodEnded>(detail);
  }
  running_.reset();
  return reply;
}

/// Processes of one method, those that are at work aside.
struct MethodProcesses::Pool {
  Pool(const ExternalMethod& one, Disclosed shown) : method(one), disclosed(std::move(shown)) {}

  ExternalReply map(const ExternalRequest& request) {
    std::list<MethodProcess> mine;
    {
      const std::lock_guard lock(mutex);
      if (free.empty())
        mine.emplace_back(method, disclosed);
      else
        mine.splice(mine.begin(), free, free.begin());
    }
    ExternalReply reply = mine.front().map(request);
    const std::lock_guard lock(mutex);
    free.splice(free.begin(), mine);
    return reply;
  }

  const ExternalMethod method;
  const Disclosed disclosed;
  std::mutex mutex = {};
  std::list<MethodProcess> free = {};
};

MethodProcesses::MethodProcesses(const std::vector<ExternalMethod>& methods,
                                 const Disclosed& disclosed) {
  for (const ExternalMethod& method : methods) {
    const MethodProcess is_allowed(method);
    pools_.push_back(std::make_unique<Pool>(method, disclosed));
  }
}
MethodProcesses::~MethodProcesses() = default;

ExternalReply MethodProcesses::map(const std::string& method, const ExternalRequest& request) {
  for (const std::unique_ptr<Pool>& pool : pools_)
    if (pool->method.name == method) return pool->map(request);
  throw InvalidInput(method + ": its command was not named to be started");
}

}  // namespace mapproof
