#pragma once

#include "core/base/files/byte_source.hpp"
#include "core/records/observations/sources.hpp"

namespace mapproof {

/// Long CSV, as read_detections() has it.
DetectionSource read_long_detections(ByteSource& source, const TableFormat& format);

}  // namespace mapproof
