#pragma once

#include "render/image/image.hpp"

namespace mapproof {

/// An image of half the size, each pixel the rounded mean of four; the last row or column of an odd
/// size is dropped.
Image halved(const Image& image);

}  // namespace mapproof
