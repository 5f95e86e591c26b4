#include "app/map/incremental_options.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

void refuse(bool is_asked, const char* option, const char* why) {
  if (is_asked) throw InvalidInput(fmt::format("{}: not with --follow: {}", option, why));
}

}  // namespace

void require_followable(const MapInput& input, const MapOptions& options) {
  if (input.kind.empty())
    throw InvalidInput(
        "--follow: say by --sensor what the values are: visibility, bearing, range or "
        "range-bearing");
  refuse(options.choose, "--method auto",
         "it makes some twenty maps by each method, far more than an update may take; choose on a "
         "part of the file, then follow by that method");
  refuse(options.ellipse_replicates > 0, "--ellipses",
         "they come of hundreds of maps of steps drawn anew, far more than an update may take; map "
         "the file as a whole");
  refuse(options.missing.way != MissingChoice().way, "--missing",
         "filling entries in takes the whole history, and followed steps are not kept; a followed "
         "map takes the distances over common steps");
  refuse(options.submaps > 0, "--submaps", "a followed map is made as a whole");
  refuse(options.steps > 0, "--steps", "it takes every step that comes");
  refuse(options.drop_unseen, "--drop-unseen",
         "landmarks come as they are observed, there are no others");
  refuse(input.layout == Layout::kWide, "--layout wide", "only a long table grows step by step");
  refuse(input.labels.check || input.labels.repair, "--check-ids, --repair-ids",
         "labels are judged by all scans together; check the file as a whole");
  refuse(input.labels.find_moved && input.kind != kRangeBearing, "--find-moved",
         "one kind of value alone does not tell what moved; follow detections with --sensor "
         "range-bearing");
}

}  // namespace mapproof
