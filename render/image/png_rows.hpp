#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/image/png_chunks.hpp"

namespace mapproof {

/// The rows of a PNG of any kind, decoded one after the other.
class PngRows {
 public:
  /// @param chunks  Of png_chunks(); the bytes that they refer to must outlive this.
  /// @throws InvalidInput with the reason if the pixels cannot be decoded.
  explicit PngRows(std::vector<PngChunk> chunks);
  ~PngRows();
  PngRows(PngRows&&) noexcept;
  PngRows& operator=(PngRows&&) noexcept;

  /// Decodes the next rows: 0x00RRGGBB, `count` times the width, composed over white, and over
  /// black if that is not null.
  /// @return Whether all of these pixels are opaque.
  /// @throws InvalidInput if a row is damaged or missing.
  /// @note An interlaced image is decoded, and held, whole before its first row.
  bool read(int count, std::uint32_t* over_white, std::uint32_t* over_black);

  /// @throws InvalidInput if what follows the last row is damaged. @pre All rows were read.
  void finish();

  /// As PngFile::finer_digest, of the rows so far.
  std::uint64_t finer_digest() const;

 private:
  class Decoder;
  std::unique_ptr<Decoder> decoder_;
};

}  // namespace mapproof
