#include "app/nightly_study.hpp"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "app/failures.hpp"
#include "app/study_run.hpp"
#include "core/base/errors.hpp"
#include "core/records/results_study_json.hpp"
#include "reports/history/night_scores.hpp"

namespace mapproof {

namespace fs = std::filesystem;

std::vector<StudyOrder> read_nightly_orders(const std::vector<std::string>& experiments,
                                            OrderOptions options) {
  options.profile_if_there = options.one_of_several = true;
  std::vector<StudyOrder> orders;
  for (const std::string& experiment : experiments) {
    StudyOrder order = is_results_study(experiment)
                           ? given_study_order(experiment)
                           : read_study_order(experiment_of(experiment), options);
    for (const StudyOrder& other : orders)
      if (other.name == order.name)
        throw InvalidInput("two experiments have the name " + printable(order.name));
    orders.push_back(std::move(order));
  }
  check_data_used(orders, options);
  return orders;
}

std::vector<StudyNight> planned_studies(const std::vector<StudyOrder>& orders) {
  std::vector<StudyNight> studies;
  for (const StudyOrder& order : orders)
    studies.push_back(
        {.name = order.name, .order_digest = order_digest(study_json(order), order.name)});
  return studies;
}

int make_apart(const StudyOrder& order, const fs::path& folder, int jobs,
               const std::string& command, const Console& console) {
  // Nothing buffered is to be written twice, and no thread runs yet that the copy would lack.
  std::fflush(nullptr);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) throw IoError(folder.string(), std::string("no process: ") + std::strerror(errno));
  if (child == 0) {
    // A night that is killed takes its study with it: its locks are free at once.
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(kInternal);
    const auto make = [&] { return make_study(order, folder, jobs, command, console), kDone; };
    const int code = exit_code_of(make, order.name + ": ");
    std::fflush(nullptr);
    ::_exit(code);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw IoError(folder.string(), std::strerror(errno));
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  console.warning(fmt::format("{}: ended by signal {}", order.name, WTERMSIG(status)));
  return kInternal;
}

}  // namespace mapproof
