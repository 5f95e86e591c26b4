#include "app/map/growing_file.hpp"

#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "core/base/errors.hpp"
#include "core/base/input_file.hpp"

namespace mapproof {
namespace {

volatile std::sig_atomic_t g_asked = 0;

extern "C" void ask_to_end(int) { g_asked = 1; }

}  // namespace

GrowingFile::GrowingFile(const std::string& path)
    : path_(path), name_(input_name(path)), file_(open_followed(path)) {
  struct stat status {};
  if (::fstat(file_.get(), &status) != 0) throw IoError(name_, std::strerror(errno));
  regular_ = S_ISREG(status.st_mode);
}

GrowingFile::State GrowingFile::read(std::string& bytes, double seconds) {
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
  // Standard input that is a file does not grow for us: it ends here.
  if (path_ == "-") return State::kEnd;
  ::poll(nullptr, 0, static_cast<int>(std::ceil(1000.0 * seconds)));
  return State::kNothing;
}

bool GrowingFile::replaced() const {
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

}  // namespace mapproof
