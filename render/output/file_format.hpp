#pragma once

#include <optional>
#include <set>
#include <string_view>

namespace mapproof {

/// What a figure or a scene can be written as.
enum class FileFormat { kSvg, kPng, kPdf, kEps, kJson, kCsv, kMatplotlib };

using FileFormats = std::set<FileFormat>;

/// SVG, PNG and PDF, and the value itself as JSON.
inline FileFormats usual_formats() {
  return {FileFormat::kSvg, FileFormat::kPng, FileFormat::kPdf, FileFormat::kJson};
}

}  // namespace mapproof
