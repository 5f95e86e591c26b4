#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/frame.h>
#include <libswscale/swscale.h>
}

namespace mapproof {

/// Returns FFmpeg's answer. @throws std::bad_alloc or std::runtime_error if it is an error.
int checked(int answer, const char* what);

/// An object that FFmpeg made. @throws std::bad_alloc if it had no memory for it.
template <typename Kind>
Kind* made(Kind* pointer) {
  if (pointer == nullptr) throw std::bad_alloc();
  return pointer;
}

struct FreeCodec {
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
};
struct FreeFrame {
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
};
struct FreeConverter {
  void operator()(SwsContext* converter) const { sws_freeContext(converter); }
};
struct FreePacket {
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};

using Codec = std::unique_ptr<AVCodecContext, FreeCodec>;
using Converter = std::unique_ptr<SwsContext, FreeConverter>;
using Frame = std::unique_ptr<AVFrame, FreeFrame>;
using Packet = std::unique_ptr<AVPacket, FreePacket>;

/// A file in memory, which FFmpeg reads or writes.
struct MemoryFile {
  std::string bytes;
  std::size_t at = 0;
};

/// The callback of an AVIOContext on a MemoryFile that goes to an offset.
std::int64_t seek_in_memory(void* opaque, std::int64_t offset, int whence);

/// A frame with room for its pixels.
Frame new_frame(AVPixelFormat format, int width, int height);

}  // namespace mapproof
