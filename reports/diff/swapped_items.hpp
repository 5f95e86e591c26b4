#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/base/files/files.hpp"
#include "reports/diff/diff_result.hpp"
#include "reports/diff/diff_settings.hpp"

namespace mapproof {

/// The bytes of a file. @throws IoError.
using BytesOfFile = std::function<std::string(const std::filesystem::path&)>;

/// Replaces the causes of items whose current file is, byte by byte, the baseline file of another
/// item: swapped or renamed. All else that differs follows from it. A swapped item is at least
/// changed, whatever renderer drew it.
/// @param items  Compared, in their order.
/// @param read   Reads a file whose size a file of the other side has, too: each one once, however
///               many items there are, and those that are equal once more.
void name_swapped(
    std::vector<DiffItem>& items, const DiffSettings& settings,
    const BytesOfFile& read = [](const auto& path) { return read_file(path); });

}  // namespace mapproof
