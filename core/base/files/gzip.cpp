#include "core/base/files/gzip.hpp"

#include <libdeflate.h>

#include <memory>
#include <new>

namespace mapproof {

std::string gzipped(std::string_view bytes) {
  // Of 20 MB of results level 6 leaves 9.2 % in 0.12 s, level 9 9.0 % in 0.4 s, level 12 8.4 % in
  // 5 s.
  constexpr int kLevel = 6;
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kLevel), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::string packed(libdeflate_gzip_compress_bound(compressor.get(), bytes.size()), '\0');
  packed.resize(libdeflate_gzip_compress(compressor.get(), bytes.data(), bytes.size(),
                                         packed.data(), packed.size()));
  return packed;
}

}  // namespace mapproof
