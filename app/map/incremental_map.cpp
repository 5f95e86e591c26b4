#include "app/map/incremental_map.hpp"

#include <chrono>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "app/map/growing_file.hpp"
#include "core/base/errors.hpp"
#include "core/base/unpacker.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kWait_s = 0.2;  ///< Between two looks at a file that does not grow.

/// Whether it is time for an update.
class Due {
 public:
  explicit Due(const FollowInterval& every) : every_(every) {}

  bool after(long steps) {
    steps_ += steps;
    if (steps_ == 0) return false;
    if (every_.steps > 0) return steps_ >= every_.steps;
    return std::chrono::duration<double>(Clock::now() - last_).count() >= every_.seconds;
  }

  void done() {
    steps_ = 0;
    last_ = Clock::now();
  }

 private:
  FollowInterval every_;
  long steps_ = 0;
  Clock::time_point last_ = Clock::now();
};

}  // namespace

FollowInterval follow_interval(const std::string& text) {
  const bool seconds = text.ends_with('s');
  const auto number = number_in(std::string_view(text).substr(0, text.size() - (seconds ? 1 : 0)));
  const bool right =
      number && *number > 0.0 && *number <= 1e6 && (seconds || *number == std::floor(*number));
  if (!right)
    throw InvalidInput("--every: expected a number of steps, or of seconds as 2s, got " +
                       in_quotes(text));
  return seconds ? FollowInterval{.steps = 0, .seconds = *number}
                 : FollowInterval{.steps = static_cast<long>(*number), .seconds = 0.0};
}

MapResult follow_map(const FollowOrder& order, const Console& console, const WriteFollowed& write) {
  const EndSignals signals;
  GrowingFile file(order.path);
  Unpacker unpacker(file.name());
  FollowedTable table = order.table;
  table.source = file.name();
  const std::unique_ptr<Follower> follower = order.follower(table);
  Due due(order.every);
  std::vector<std::string> remarks;
  std::string bytes;
  bool ended = false;
  while (!signals.asked()) {
    const GrowingFile::State state = file.read(bytes, kWait_s);
    ended = state == GrowingFile::State::kEnd;
    if (ended) break;
    if (state == GrowingFile::State::kReplaced) {
      remarks.push_back(file.name() +
                        " was cut short, removed or replaced: the map is that of what was read "
                        "before. Start again to follow the new file.");
      break;
    }
    follower->take(unpacker.take(bytes));
    if (!due.after(follower->take_steps())) continue;
    const MapResult map = follower->update();
    write(map, false);
    for (const std::string& remark : map.remarks) console.warning(remark);
    console.detail(fmt::format("{} steps, {} landmarks", map.record.step, map.record.names.size()));
    due.done();
  }
  if (ended) {
    unpacker.end();
    follower->take(unpacker.take({}));
  }
  if (ended && unpacker.is_cut())
    remarks.push_back(
        fmt::format("{} is {}'ed and stops before its end: the map is of what there was.",
                    file.name(), unpacker.packing()));
  if (!ended || unpacker.is_cut()) follower->drop_half_line();
  follower->end();
  follower->take_steps();
  if (follower->steps() == 0) throw IoError(file.name(), "held no observations");
  MapResult last = follower->last_update();
  last.remarks.insert(last.remarks.begin(), remarks.begin(), remarks.end());
  write(last, true);
  return last;
}

}  // namespace mapproof
