#include "core/base/packed_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/base/descriptor.hpp"
#include "core/base/errors.hpp"
#include "core/base/inflater.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

std::string errno_reason() { return std::strerror(errno); }

std::size_t size_of(const Descriptor& file, const fs::path& path) {
  if (file.get() < 0) throw IoError(path.string(), "cannot be opened: " + errno_reason());
  struct stat facts {};
  if (::fstat(file.get(), &facts) != 0) throw IoError(path.string(), errno_reason());
  if (S_ISDIR(facts.st_mode)) throw IoError(path.string(), "is a folder, a file was expected");
  return static_cast<std::size_t>(facts.st_size);
}

}  // namespace

struct PackedFile::State {
  explicit State(const fs::path& path)
      : source(path.string()),
        descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC)),
        size(size_of(descriptor, path)),
        stream(::gzdopen(::dup(descriptor.get()), "rb")) {
    if (stream == nullptr) throw IoError(source, "cannot be opened: " + errno_reason());
    ::gzbuffer(stream, 1U << 17);
  }
  ~State() { ::gzclose(stream); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  std::string source;
  Descriptor descriptor;
  std::size_t size;
  gzFile stream;
  std::size_t inflated = 0;
};

PackedFile::PackedFile(const fs::path& path) : state_(std::make_unique<State>(path)) {}

PackedFile::~PackedFile() = default;

double PackedFile::expected_size() const {
  const auto packed = static_cast<double>(std::max<z_off_t>(1, ::gzoffset(state_->stream)));
  return static_cast<double>(state_->size) * static_cast<double>(state_->inflated) / packed;
}

bool PackedFile::append(std::string& bytes, std::size_t count) {
  const std::size_t before = bytes.size();
  bytes.resize(before + count);
  const int got = ::gzread(state_->stream, bytes.data() + before, static_cast<unsigned>(count));
  bytes.resize(before + static_cast<std::size_t>(std::max(got, 0)));
  int error = Z_OK;
  const char* words = ::gzerror(state_->stream, &error);
  if (got < 0 || error == Z_BUF_ERROR) {
    if (error == Z_ERRNO) throw IoError(state_->source, "cannot be read: " + errno_reason());
    if (error == Z_BUF_ERROR) throw IoError(state_->source, "the gzip'ed file is cut off");
    throw IoError(state_->source, std::string("the gzip'ed file is damaged: ") + words);
  }
  state_->inflated += static_cast<std::size_t>(got);
  const auto packed = static_cast<double>(std::max<z_off_t>(1, ::gzoffset(state_->stream)));
  refuse_bomb(state_->source, packed, static_cast<double>(state_->inflated));
  return got > 0;
}

std::string read_packed_file(const fs::path& path, std::size_t limit) {
  PackedFile file(path);
  std::string bytes;
  while (file.append(bytes, std::size_t{1} << 20))
    if (bytes.size() > limit)
      throw IoError(path.string(), "is larger than " + std::to_string(limit) + " bytes");
  return bytes;
}

fs::path unpacked_name(const fs::path& path) {
  return path.extension() == ".gz" ? path.parent_path() / path.stem() : path;
}

}  // namespace mapproof
