#pragma once

#include <span>
#include <string>

namespace mapproof {

/// Refuses inputs of which one would take what another is to read: standard input twice, or a pipe
/// by two names.
/// @param inputs  Paths, those that were not given empty.
/// @throws InvalidInput.
void refuse_shared_streams(std::span<const std::string> inputs);

/// Reads a stream that was handed in and replaces it by a file, unpacked, which can be read as
/// often as needed, by the same name. Other paths stay as they are.
/// @return The path; /dev/stdin for "-".
/// @throws IoError as read_input(), or if the stream holds more than 2^28 bytes.
std::string made_file(const std::string& path);

}  // namespace mapproof
