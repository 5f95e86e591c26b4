#include "render/animation/ffmpeg.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <string>

extern "C" {
#include <libavformat/avio.h>
}

namespace mapproof {

int checked(int answer, const char* what) {
  if (answer >= 0) return answer;
  // AVERROR_EXTERNAL is an error of zlib, which can fail here only for want of memory.
  if (answer == AVERROR(ENOMEM) || answer == AVERROR_EXTERNAL) throw std::bad_alloc();
  std::array<char, AV_ERROR_MAX_STRING_SIZE> words{};
  av_strerror(answer, words.data(), words.size());
  throw std::runtime_error(std::string(what) + ": " + words.data());
}

std::int64_t seek_in_memory(void* opaque, std::int64_t offset, int whence) {
  auto& file = *static_cast<MemoryFile*>(opaque);
  const auto size = static_cast<std::int64_t>(file.bytes.size());
  if (whence == AVSEEK_SIZE) return size;
  if (whence == SEEK_CUR) offset += static_cast<std::int64_t>(file.at);
  if (whence == SEEK_END) offset += size;
  if (offset < 0 || offset > size) return AVERROR(EINVAL);
  file.at = static_cast<std::size_t>(offset);
  return offset;
}

Frame new_frame(AVPixelFormat format, int width, int height) {
  Frame frame(made(av_frame_alloc()));
  frame->format = format;
  frame->width = width;
  frame->height = height;
  checked(av_frame_get_buffer(frame.get(), 0), "frame");
  return frame;
}

}  // namespace mapproof
