#include "reports/diff/documents/pdf_diff.hpp"

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/base/byte_source.hpp"
#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 28;
constexpr std::size_t kMostPdfText = 200;

std::string problem_of(std::string_view bytes) {
  if (bytes.empty()) return "is empty";
  if (!bytes.starts_with("%PDF-")) return "is not a PDF";
  const std::size_t last = bytes.find_last_not_of(" \r\n");
  return bytes.substr(0, last + 1).ends_with("%%EOF") ? "" : "is truncated";
}

/// "cairo 1.16.0 (https://cairographics.org)", as the file says; may be empty.
std::string producer_of(std::string_view bytes) {
  constexpr std::string_view kKey = "/Producer (";
  const std::size_t at = bytes.find(kKey);
  if (at == std::string_view::npos) return "";
  const std::string_view rest = bytes.substr(at + kKey.size());
  return printable(std::string(rest.substr(0, rest.find(" ("))), kMostPdfText);
}

}  // namespace

PictureDiff pdf_diff(const std::filesystem::path& baseline, const std::filesystem::path& current) {
  const std::string before = read_input(baseline, kMostBytes);
  const std::string after = read_input(current, kMostBytes);
  PictureDiff diff;
  diff.baseline_bytes = before.size();
  diff.current_bytes = after.size();
  for (const auto& [name, bytes] :
       {std::pair("the baseline: ", &before), std::pair("the current file: ", &after)})
    if (const std::string problem = problem_of(*bytes); !problem.empty())
      diff.reason += (diff.reason.empty() ? "" : "; ") + std::string(name) + problem;
  if (!diff.reason.empty()) return diff;
  diff.baseline_renderer = producer_of(before);
  diff.current_renderer = producer_of(after);
  if (before == after) {
    diff.state = PictureState::kIdentical;
    diff.reason = "the files are equal";
  } else if (diff.baseline_renderer != diff.current_renderer) {
    diff.state = PictureState::kWithinTolerance;
    diff.reason =
        fmt::format("written by {} \u2192 {}", diff.baseline_renderer, diff.current_renderer);
  } else {
    diff.state = PictureState::kDifferent;
    diff.reason = "its bytes differ";
  }
  return diff;
}

}  // namespace mapproof
