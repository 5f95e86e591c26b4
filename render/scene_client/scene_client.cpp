#include "render/scene_client/scene_client.hpp"

#include <signal.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "render/scene/scene_json.hpp"
#include "render/scene/scene_request.hpp"

namespace mapproof {
namespace {

constexpr time_t kPatience_s = 600;  // Far longer than the largest image takes.

/// In the child: runs the program, with the socket as its input and output. Makes only calls that
/// are allowed in the child of a process with threads.
[[noreturn]] void become(const char* program, int socket, int messages) {
  ::dup2(socket, STDIN_FILENO);
  ::dup2(socket, STDOUT_FILENO);
  ::dup2(messages, STDERR_FILENO);
  ::execl(program, program, static_cast<char*>(nullptr));
  constexpr int kNotStarted = 127;
  ::_exit(kNotStarted);
}

/// Sends all bytes, without a signal that would end this program. @return False if the other end is
/// closed.
bool send_all(int socket, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

/// The last line of a file of messages that is not empty.
std::string last_line(int file) {
  std::array<char, 4096> block{};
  const off_t size = ::lseek(file, 0, SEEK_END);
  const off_t from = std::max<off_t>(0, size - static_cast<off_t>(block.size()));
  const ssize_t count = ::pread(file, block.data(), block.size(), from);
  std::string text(block.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

}  // namespace

std::filesystem::path scenes_program() {
  if (const char* named = std::getenv("MAPPROOF_SCENES"); named != nullptr && *named != '\0')
    return named;
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  return self.parent_path() / "mapproof-scenes";
}

SceneClient::SceneClient(std::filesystem::path program) : program_(std::move(program)) {}

SceneClient::~SceneClient() {
  socket_.close();  // The program reads the end of its input, and ends.
  if (process_ > 0) ::waitpid(process_, nullptr, 0);
}

void SceneClient::start() {
  if (::access(program_.c_str(), X_OK) != 0 && !MAPPROOF_HAS_SCENES)
    throw SceneError(
        "3-D figures are left out: this program was built without them (MAPPROOF_SCENES=OFF)");
  if (::access(program_.c_str(), X_OK) != 0)
    throw SceneError(fmt::format("scenes cannot be drawn: {} is not a program: {}",
                                 program_.string(), std::strerror(errno)));
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw SceneError(fmt::format("scenes cannot be drawn: no socket: {}", std::strerror(errno)));
  const timeval patience{.tv_sec = kPatience_s, .tv_usec = 0};
  ::setsockopt(ends[0], SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  Descriptor theirs(ends[1]);
  socket_ = Descriptor(ends[0]);
  messages_ = Descriptor(::memfd_create("mapproof-scenes", MFD_CLOEXEC));
  unread_.clear();
  process_ = ::fork();
  if (process_ == 0) become(program_.c_str(), theirs.get(), messages_.get());
  if (process_ < 0) fail(fmt::format("no process: {}", std::strerror(errno)));
}

std::string SceneClient::ending() {
  socket_.close();
  if (process_ <= 0) return {};
  int status = 0;
  ::waitpid(std::exchange(process_, -1), &status, 0);
  if (WIFSIGNALED(status))
    return fmt::format("it was ended by signal {}, perhaps for want of memory", WTERMSIG(status));
  return fmt::format("it ended with exit code {}", WEXITSTATUS(status));
}

void SceneClient::give_up() {
  ::kill(process_, SIGKILL);
  fail(fmt::format("it gave no answer within {} s", kPatience_s));
}

void SceneClient::fail(const std::string& what) {
  const std::string end = ending();
  std::string said = messages_.get() >= 0 ? last_line(messages_.get()) : std::string();
  const std::string name = program_.filename().string();
  if (said.starts_with(name + ": ")) said.erase(0, name.size() + 2);
  std::string text = "scenes cannot be drawn: " + name + ": " + (said.empty() ? what : said);
  if (said.empty() && !end.empty()) text += "; " + end;
  throw SceneError(printable(text, 500));
}

void SceneClient::read_bytes(char* to, std::size_t count) {
  const std::size_t kept = std::min(count, unread_.size());
  std::memcpy(to, unread_.data(), kept);
  unread_.erase(0, kept);
  for (std::size_t done = kept; done < count;) {
    const ssize_t got = ::recv(socket_.get(), to + done, count - done, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && errno == EAGAIN) give_up();
    if (got <= 0) fail("it stopped in the middle of an image");
    done += static_cast<std::size_t>(got);
  }
}

std::string SceneClient::read_line() {
  constexpr std::size_t kLongest = 100'000;
  std::array<char, 4096> block{};
  std::size_t end = unread_.find('\n');
  while (end == std::string::npos) {
    const ssize_t got = ::recv(socket_.get(), block.data(), block.size(), 0);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && errno == EAGAIN) give_up();
    if (got <= 0 || unread_.size() > kLongest) fail("it gave no answer");
    unread_.append(block.data(), static_cast<std::size_t>(got));
    end = unread_.find('\n');
  }
  std::string line = unread_.substr(0, end + 1);
  unread_.erase(0, end + 1);
  return line;
}

Image SceneClient::draw(const Scene& scene, std::size_t view, int width, int height, int samples,
                        const Theme& theme) {
  require_valid(scene);
  if (view >= scene.views.size())
    throw InvalidInput(fmt::format("scene {}: there is no view {}", scene.id, view));
  if (std::min(width, height) < 1 || std::max(width, height) > kLargestSide)
    throw InvalidInput(
        fmt::format("scene {}: no image is {} x {} pixels", scene.id, width, height));
  if (samples < 0 || samples > kMostSamples)
    throw InvalidInput(fmt::format("scene {}: {} samples per pixel", scene.id, samples));
  const std::lock_guard lock(mutex_);
  if (process_ < 0) start();
  const SceneRequest request = scene_request(view, width, height, samples, theme);
  if (!send_all(socket_.get(), request_to_line(request) + scene_to_line(scene)))
    fail("it takes no scene");
  SceneReply reply;
  try {
    reply = reply_from_line(read_line(), program_.filename().string());
  } catch (const IoError& error) {
    fail(error.what());
  }
  if (!reply.error.empty()) {
    ending();
    throw SceneError(printable("scenes cannot be drawn: " + reply.error, 500));
  }
  if (reply.width != width || reply.height != height) fail("it drew another size");
  renderer_ = reply.renderer;
  Image image{width, height, {}};
  image.pixels.resize(static_cast<std::size_t>(width) * height);
  read_bytes(reinterpret_cast<char*>(image.pixels.data()), 4 * image.pixels.size());
  return image;
}

std::string SceneClient::renderer() {
  const std::lock_guard lock(mutex_);
  return renderer_;
}

}  // namespace mapproof
