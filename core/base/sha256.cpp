#include "core/base/sha256.hpp"

#include <sha256.h>

#include "core/base/files/descriptor.hpp"
#include "core/base/files/input_file.hpp"

namespace mapproof {
namespace {

std::string in_hex(const std::array<std::uint8_t, 32>& digest) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : digest) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

}  // namespace

struct Sha256::State {
  SHA256_CTX context{};
};

Sha256::Sha256() : state_(std::make_unique<State>()) { SHA256_Init(&state_->context); }
Sha256::~Sha256() = default;

void Sha256::add(std::string_view bytes) {
  SHA256_Update(&state_->context, reinterpret_cast<const std::uint8_t*>(bytes.data()),
                bytes.size());
}

void Sha256::add_file(const std::filesystem::path& file) {
  const Descriptor descriptor = open_input(file);
  std::string block(std::size_t{1} << 16, '\0');
  while (const std::size_t count = read_some(descriptor, block, input_name(file)))
    add(std::string_view(block).substr(0, count));
}

std::string Sha256::hex() {
  std::array<std::uint8_t, 32> digest{};
  SHA256_Final(digest.data(), &state_->context);
  return in_hex(digest);
}

std::array<std::uint8_t, 32> sha256(std::string_view bytes) {
  SHA256_CTX context;
  SHA256_Init(&context);
  SHA256_Update(&context, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  std::array<std::uint8_t, 32> digest{};
  SHA256_Final(digest.data(), &context);
  return digest;
}

std::string sha256_hex(std::string_view bytes) { return in_hex(sha256(bytes)); }

}  // namespace mapproof
