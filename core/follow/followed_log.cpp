#include "core/follow/followed_log.hpp"

#include <cmath>

#include "core/base/errors.hpp"

namespace mapproof {

void FollowedLog::add(const LookKey& look, const std::vector<Sighting>& sightings) {
  if (look.robot < 0 || look.robot > std::ssize(robots_) || !std::isfinite(look.key))
    throw InvalidInput("robots are numbered as they come, and their looks have a step or time");
  if (look.robot == std::ssize(robots_)) robots_.emplace_back();
  Robot& robot = robots_[static_cast<std::size_t>(look.robot)];
  if (!robot.keys.empty() && look.key <= robot.keys.back())
    throw InvalidInput("a robot's looks come in ascending order");
  for (Sighting seen : sightings) {
    seen.step = static_cast<int>(robot.keys.size());
    robot.sightings.push_back(seen);
  }
  robot.keys.push_back(look.key);
  ++steps_;
}

SightingLog FollowedLog::log(const std::vector<std::string>& names, bool is_timed) const {
  SightingLog log;
  log.names = names;
  log.looks = looks();
  for (const Robot& robot : robots_) {
    for (Sighting seen : robot.sightings) {
      seen.step += log.steps;
      log.sightings.push_back(seen);
    }
    log.steps += static_cast<int>(robot.keys.size());
    if (is_timed) log.times_s.insert(log.times_s.end(), robot.keys.begin(), robot.keys.end());
  }
  return log;
}

std::vector<LookKey> FollowedLog::looks() const {
  std::vector<LookKey> looks;
  for (std::size_t k = 0; k < robots_.size(); ++k)
    for (const double key : robots_[k].keys) looks.push_back({static_cast<int>(k), key});
  return looks;
}

}  // namespace mapproof
