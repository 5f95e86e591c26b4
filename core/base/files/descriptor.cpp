#include "core/base/files/descriptor.hpp"

#include <unistd.h>

#include <cerrno>
#include <utility>

namespace mapproof {

bool Descriptor::close() {
  const int number = std::exchange(number_, -1);
  // A close that was interrupted has closed all the same, and must not be repeated.
  return number < 0 || ::close(number) == 0 || errno == EINTR;
}

bool write_all(const Descriptor& file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file.get(), bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace mapproof
