#include "reports/diff/images/picture_changes.hpp"

namespace mapproof {

std::string_view name(PictureState state) {
  switch (state) {
    case PictureState::kIdentical:
      return "identical";
    case PictureState::kWithinTolerance:
      return "within tolerance";
    case PictureState::kDifferent:
      return "different";
    case PictureState::kUnreadable:
      break;
  }
  return "unreadable";
}

}  // namespace mapproof
