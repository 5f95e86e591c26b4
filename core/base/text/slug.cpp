#include "core/base/text/slug.hpp"

#include <utility>

#include "core/base/sha256.hpp"
#include "core/base/text/words.hpp"

namespace mapproof {

std::string slug_of(const std::string& text) {
  std::string slug;
  for (const char c : lower_case(text)) {
    const bool is_kept = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (is_kept)
      slug += c;
    else if (!slug.empty() && slug.back() != '-')
      slug += '-';
  }
  while (!slug.empty() && slug.back() == '-') slug.pop_back();
  return bounded_id(std::move(slug), 60);
}

std::string bounded_id(std::string id, std::size_t most) {
  if (id.size() <= most) return id;
  const std::string digest = sha256_hex(id).substr(0, 8);
  return id.substr(0, most - digest.size() - 1) + "-" + digest;
}

}  // namespace mapproof
