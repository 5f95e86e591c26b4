#pragma once

#include <string_view>

namespace mapproof {

/// A file that was embedded in the program when it was built.
struct Resource {
  std::string_view name;  ///< Relative path, '/' between the parts.
  std::string_view bytes;
};

}  // namespace mapproof
