#include "render/scene_client/scene_client.hpp"

#include <sys/socket.h>
#include <sys/time.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/base/child_process.hpp"
#include "core/base/errors.hpp"
#include "render/scene/scene_json.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kLongestMessage = 4096;

/// Sends all bytes, without a signal that would end this program. @return False if the other end is
/// closed, or takes none for too long (errno: EAGAIN).
bool send_all(int socket, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace

std::filesystem::path scenes_program() {
  return program_beside("MAPPROOF_SCENES", "mapproof-scenes");
}

SceneClient::SceneClient(std::filesystem::path program, std::chrono::seconds patience)
    : program_(std::move(program)), patience_(patience) {}

SceneClient::~SceneClient() {
  try {
    ending();
  } catch (const ProcessError&) {
    // It is killed with the object.
  }
}

void SceneClient::start() {
  if (!MAPPROOF_HAS_SCENES && !is_program(program_))
    throw SceneError(
        "3-D figures are left out: this program was built without them (MAPPROOF_SCENES=OFF)");
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw SceneError(fmt::format("scenes cannot be drawn: no socket: {}", std::strerror(errno)));
  const Descriptor theirs(ends[1]);
  socket_ = Descriptor(ends[0]);
  const timeval patience{.tv_sec = patience_.count(), .tv_usec = 0};
  for (const int limit : {SO_RCVTIMEO, SO_SNDTIMEO})
    ::setsockopt(socket_.get(), SOL_SOCKET, limit, &patience, sizeof(patience));
  unread_.clear();
  messages_ = memory_file("mapproof-scenes");
  process_.emplace(
      ProgramCall{program_},
      StandardStreams{.input = theirs.get(), .output = theirs.get(), .messages = messages_.get()});
}

std::string SceneClient::ending() {
  socket_.close();  // The program reads the end of its input, and ends.
  if (!process_) return {};
  ChildProcess process = *std::exchange(process_, std::nullopt);
  const ProcessEnd end = process.wait();
  return end.text() + (end.signal != 0 ? ", perhaps for want of memory" : "");
}

void SceneClient::give_up() {
  process_.reset();
  fail(fmt::format("it gave no answer within {} s", patience_.count()));
}

void SceneClient::fail(const std::string& what) {
  const std::string end = ending();
  std::string said = last_line(content_of(messages_, kLongestMessage));
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

void SceneClient::require_size(const Scene& scene, int width, int height) {
  if (std::min(width, height) < 1 || std::max(width, height) > kLargestSide)
    throw InvalidInput(
        fmt::format("scene {}: an image has 1 to {} pixels along a side, not {} x {} (--width, "
                    "--height, --dpi)",
                    scene.id, kLargestSide, width, height));
}

Image SceneClient::draw(const Scene& scene, const SceneRequest& request) {
  require_valid(scene);
  if (request.view >= scene.views.size())
    throw InvalidInput(fmt::format("scene {}: there is no view {}", scene.id, request.view));
  require_size(scene, request.width, request.height);
  if (request.samples < 0 || request.samples > kMostSamples)
    throw InvalidInput(fmt::format("scene {}: {} samples per pixel", scene.id, request.samples));
  const std::lock_guard lock(mutex_);
  try {
    return ask(request, scene);
  } catch (const ProcessError& error) {
    throw SceneError(printable(fmt::format("scenes cannot be drawn: {}", error.what()), 500));
  }
}

Image SceneClient::ask(const SceneRequest& request, const Scene& scene) {
  if (!process_) start();
  if (!send_all(socket_.get(), request_to_line(request) + scene_to_line(scene))) {
    if (errno == EAGAIN) give_up();
    fail("it takes no scene");
  }
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
  if (reply.width != request.width || reply.height != request.height) fail("it drew another size");
  renderer_ = reply.renderer;
  Image image{reply.width, reply.height, {}};
  image.pixels.resize(static_cast<std::size_t>(reply.width) *
                      static_cast<std::size_t>(reply.height));
  read_bytes(reinterpret_cast<char*>(image.pixels.data()), 4 * image.pixels.size());
  return image;
}

std::string SceneClient::renderer() {
  const std::lock_guard lock(mutex_);
  return renderer_;
}

}  // namespace mapproof
