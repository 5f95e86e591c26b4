#include "core/model/status.hpp"

#include <array>
#include <utility>

namespace mapproof {
namespace {

constexpr std::array kStatusNames = {
    std::string_view("bridged"),
    std::string_view("not_converged"),
    std::string_view("uncertified"),
    std::string_view("rank_deficient"),
    std::string_view("undetermined"),
    std::string_view("arbitrary_neighbours"),
    std::string_view("landmark_unseen"),
    std::string_view("distances_completed"),
    std::string_view("not_euclidean"),
    std::string_view("anchors_missing"),
    std::string_view("anchors_degenerate"),
    std::string_view("degenerate_geometry"),
    std::string_view("too_few_observations"),
    std::string_view("left_out"),
    std::string_view("failed"),
};

}  // namespace

std::string_view name(StatusCode code) { return kStatusNames[static_cast<std::size_t>(code)]; }

std::string_view name(StatusReason reason) { return info(reason).name; }

Status status_with_message(StatusCode code, std::string message) {
  return {.code = code, .reason = StatusReason::kMessage, .names = {std::move(message)}};
}

}  // namespace mapproof
