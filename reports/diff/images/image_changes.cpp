#include "reports/diff/images/image_changes.hpp"

namespace mapproof {

std::string_view name(ImageState state) {
  switch (state) {
    case ImageState::kIdentical:
      return "identical";
    case ImageState::kWithinTolerance:
      return "within tolerance";
    case ImageState::kDifferent:
      return "different";
    case ImageState::kUnreadable:
      break;
  }
  return "unreadable";
}

}  // namespace mapproof
