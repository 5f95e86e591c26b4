#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
}

#include "core/base/out_of_memory.hpp"

namespace mapproof {
namespace {

/// The input of the program that encodes animations: one line of these four numbers, then the
/// pixels of each frame as Image has them.
struct AnimationInput {
  int width = 0;   ///< Pixels.
  int height = 0;  ///< Pixels.
  int frames = 0;
  int frame_ms = 0;  ///< How long each frame is shown.
};

/// Encodes frame by frame into an animated PNG, by libavcodec and libavformat, on one thread. The
/// file has no version and no time in it.
class ApngEncoder {
 public:
  /// @throws std::runtime_error if FFmpeg has no encoder of APNG or refuses such frames.
  explicit ApngEncoder(const AnimationInput& input);
  ~ApngEncoder();
  ApngEncoder(const ApngEncoder&) = delete;
  ApngEncoder& operator=(const ApngEncoder&) = delete;

  /// Adds a frame. @param pixels  width * height of them, row by row, each 0x00RRGGBB.
  /// @throws std::runtime_error if it cannot be encoded.
  void add(const std::vector<std::uint32_t>& pixels);
  /// Ends the file and returns its bytes. @throws std::runtime_error if it cannot be encoded.
  std::string finish();

 private:
  struct State;
  void drain();
  std::unique_ptr<State> state_;
};

constexpr int kMillisecondsASecond = 1000;

/// Returns FFmpeg's answer. @throws std::bad_alloc or std::runtime_error if it is an error.
int checked(int answer, const char* what) {
  if (answer >= 0) return answer;
  // AVERROR_EXTERNAL is an error of zlib, which can fail here only for want of memory.
  if (answer == AVERROR(ENOMEM) || answer == AVERROR_EXTERNAL) throw std::bad_alloc();
  std::array<char, AV_ERROR_MAX_STRING_SIZE> words{};
  av_strerror(answer, words.data(), words.size());
  throw std::runtime_error(std::string(what) + ": " + words.data());
}

/// An object that FFmpeg made. @throws std::bad_alloc if it had no memory for it.
template <typename Kind>
Kind* made(Kind* pointer) {
  if (pointer == nullptr) throw std::bad_alloc();
  return pointer;
}

struct FreeCodec {
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
};
struct FreeFormat {
  void operator()(AVFormatContext* format) const {
    if (format->pb != nullptr) av_freep(&format->pb->buffer);
    avio_context_free(&format->pb);
    avformat_free_context(format);
  }
};
struct FreeFrame {
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
};
struct FreePacket {
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};

/// A file in memory. FFmpeg's own dynamic buffer appends padding at the current offset, which is
/// inside the file here: the number of frames is written into the header last.
struct MemoryFile {
  std::string bytes;
  std::size_t at = 0;
};

/// FFmpeg 7 and newer hand over const bytes.
template <typename Byte>
int write_to_memory(void* opaque, Byte* data, int size) {
  auto& file = *static_cast<MemoryFile*>(opaque);
  const auto count = static_cast<std::size_t>(size);
  try {
    if (file.bytes.size() < file.at + count) file.bytes.resize(file.at + count);
  } catch (const std::bad_alloc&) {
    return AVERROR(ENOMEM);
  }
  std::memcpy(file.bytes.data() + file.at, data, count);
  file.at += count;
  return size;
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

AVIOContext* opened(MemoryFile& file) {
  constexpr int kBlock = 1 << 16;
  auto* block = static_cast<std::uint8_t*>(made(av_malloc(kBlock)));
  AVIOContext* context =
      avio_alloc_context(block, kBlock, 1, &file, nullptr, write_to_memory, seek_in_memory);
  if (context == nullptr) av_free(block);
  return made(context);
}

struct ApngEncoder::State {
  MemoryFile file;
  std::unique_ptr<AVCodecContext, FreeCodec> codec;
  std::unique_ptr<AVFormatContext, FreeFormat> format;
  std::unique_ptr<AVFrame, FreeFrame> frame;
  std::unique_ptr<AVPacket, FreePacket> packet;
  int frame_ms = 0;
  std::int64_t next = 0;  ///< Frames that were added.
};

ApngEncoder::ApngEncoder(const AnimationInput& input) : state_(std::make_unique<State>()) {
  state_->frame_ms = input.frame_ms;
  const AVCodec* kind = avcodec_find_encoder(AV_CODEC_ID_APNG);
  if (kind == nullptr) throw std::runtime_error("FFmpeg has no encoder of APNG");
  state_->codec.reset(made(avcodec_alloc_context3(kind)));
  AVCodecContext& codec = *state_->codec;
  codec.width = input.width;
  codec.height = input.height;
  codec.pix_fmt = AV_PIX_FMT_RGB24;
  codec.time_base = {1, kMillisecondsASecond};
  codec.thread_count = 1;
  codec.flags |= AV_CODEC_FLAG_BITEXACT;
  codec.compression_level = 9;
  checked(av_opt_set(codec.priv_data, "pred", "mixed", 0), "prediction");
  checked(avcodec_open2(&codec, kind, nullptr), "encoder");

  AVFormatContext* format = nullptr;
  checked(avformat_alloc_output_context2(&format, nullptr, "apng", nullptr), "APNG");
  state_->format.reset(format);
  format->flags |= AVFMT_FLAG_BITEXACT;
  AVStream* stream = made(avformat_new_stream(format, nullptr));
  stream->time_base = codec.time_base;
  checked(avcodec_parameters_from_context(stream->codecpar, &codec), "stream");
  checked(av_opt_set_int(format->priv_data, "plays", 0, 0), "endless play");
  format->pb = opened(state_->file);
  checked(avformat_write_header(format, nullptr), "header");

  state_->frame.reset(made(av_frame_alloc()));
  state_->frame->format = codec.pix_fmt;
  state_->frame->width = input.width;
  state_->frame->height = input.height;
  checked(av_frame_get_buffer(state_->frame.get(), 0), "frame");
  state_->packet.reset(made(av_packet_alloc()));
}

ApngEncoder::~ApngEncoder() = default;

void ApngEncoder::add(const std::vector<std::uint32_t>& pixels) {
  AVFrame& frame = *state_->frame;
  checked(av_frame_make_writable(&frame), "frame");
  std::size_t next = 0;
  for (int y = 0; y < frame.height; ++y) {
    std::uint8_t* to = frame.data[0] + static_cast<std::ptrdiff_t>(y) * frame.linesize[0];
    for (int x = 0; x < frame.width; ++x) {
      const std::uint32_t pixel = pixels.at(next++);
      for (const int shift : {16, 8, 0}) *to++ = static_cast<std::uint8_t>(pixel >> shift);
    }
  }
  frame.pts = state_->next++ * state_->frame_ms;
  checked(avcodec_send_frame(state_->codec.get(), &frame), "frame");
  drain();
}

void ApngEncoder::drain() {
  while (true) {
    AVPacket* packet = state_->packet.get();
    const int answer = avcodec_receive_packet(state_->codec.get(), packet);
    if (answer == AVERROR(EAGAIN) || answer == AVERROR_EOF) return;
    checked(answer, "packet");
    packet->stream_index = 0;
    packet->duration = state_->frame_ms;
    av_packet_rescale_ts(packet, state_->codec->time_base, state_->format->streams[0]->time_base);
    checked(av_write_frame(state_->format.get(), packet), "packet");
    av_packet_unref(packet);
  }
}

std::string ApngEncoder::finish() {
  checked(avcodec_send_frame(state_->codec.get(), nullptr), "end");
  drain();
  checked(av_write_trailer(state_->format.get()), "end");
  avio_flush(state_->format->pb);
  checked(state_->format->pb->error, "end");
  return std::move(state_->file.bytes);
}

AnimationInput read_header() {
  AnimationInput input;
  if (std::scanf("%d %d %d %d", &input.width, &input.height, &input.frames, &input.frame_ms) != 4 ||
      std::getchar() != '\n')
    throw std::runtime_error("no header");
  constexpr int kLargest = 100'000;
  for (const int number : {input.width, input.height, input.frames, input.frame_ms})
    if (number < 1 || number > kLargest) throw std::runtime_error("a header out of range");
  return input;
}

void run() {
  const AnimationInput input = read_header();
  ApngEncoder encoder(input);
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(input.width) *
                                    static_cast<std::size_t>(input.height));
  for (int i = 0; i < input.frames; ++i) {
    if (std::fread(pixels.data(), sizeof(pixels[0]), pixels.size(), stdin) != pixels.size())
      throw std::runtime_error("the frames end too soon");
    encoder.add(pixels);
  }
  const std::string file = encoder.finish();
  if (std::fwrite(file.data(), 1, file.size(), stdout) != file.size() || std::fflush(stdout) != 0)
    throw std::runtime_error("the file cannot be written");
}

}  // namespace

}  // namespace mapproof

/// Reads an AnimationInput with its frames and writes an animated PNG. mapproof starts it; it is
/// not meant for direct use.
int main() {
  try {
    mapproof::run();
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "%s\n", mapproof::kOutOfMemory);
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
