#include "reports/html/sha256.hpp"

#include <cstddef>
#include <cstdint>

#include "core/base/text/base64.hpp"

namespace mapproof {

std::string policy_hash(std::string_view text) {
  const auto digest = sha256(text);
  return "sha256-" + base64({reinterpret_cast<const char*>(digest.data()), digest.size()});
}

}  // namespace mapproof
