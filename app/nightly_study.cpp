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

#include "app/embedded_experiments.hpp"
#include "app/study_run.hpp"
#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/base/sha256.hpp"
#include "core/records/experiment_json.hpp"
#include "core/records/slam_experiment_json.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

ExperimentText text_of(const std::string& experiment) {
  std::error_code error;
  const std::vector<std::string> known = experiment_names();
  if (std::ranges::find(known, experiment) != known.end() &&
      !fs::is_regular_file(experiment, error))
    return experiment_text(experiment, std::nullopt);
  return {read_file(experiment), experiment};
}

/// The profile if the experiment has it.
std::string usable(const std::string& profile, const std::vector<std::string>& known) {
  return std::ranges::find(known, profile) == known.end() ? "" : profile;
}

NightlyOrder read_order(const std::string& experiment, const std::string& profile,
                        const std::optional<std::string>& plaza) {
  const ExperimentText file = text_of(experiment);
  NightlyOrder order{
      .name = "", .digest = sha256_hex(profile + "\n" + file.text), .experiment = {}};
  if (is_slam_experiment(file.text, file.source)) {
    NightlySlam slam{
        .experiment = parse_slam_experiment(file.text, file.source,
                                            usable(profile, slam_profiles(file.text, file.source))),
        .data = {}};
    slam.data = read_slam_data(slam.experiment, plaza);
    order.name = slam.experiment.name;
    order.experiment = std::move(slam);
    return order;
  }
  Experiment parsed =
      parse_experiment(file.text, file.source, usable(profile, profiles(file.text, file.source)));
  order.name = parsed.name;
  order.experiment = std::move(parsed);
  return order;
}

void make(const NightlyOrder& order, const fs::path& folder, int jobs, const std::string& command,
          const Console& console) {
  if (const auto* slam = std::get_if<NightlySlam>(&order.experiment))
    make_slam_records(slam->experiment, slam->data, folder, jobs, command, console);
  else
    make_records(std::get<Experiment>(order.experiment), folder, jobs, command, console);
}

/// What the process apart does; its errors are told here as the program tells them.
int run_apart(const NightlyOrder& order, const fs::path& folder, int jobs,
              const std::string& command, const Console& console) {
  try {
    make(order, folder, jobs, command, console);
    return kDone;
  } catch (const IoError& error) {
    console.warning(error.what());
    return kUsage;
  } catch (const InvalidInput& error) {
    console.warning(error.what());
    return kUsage;
  } catch (const std::bad_alloc&) {
    console.warning(order.name + ": out of memory");
    return kInternal;
  } catch (const std::exception& error) {
    console.warning(order.name + ": internal error: " + error.what());
    return kInternal;
  }
}

}  // namespace

std::vector<NightlyOrder> read_nightly_orders(const std::vector<std::string>& experiments,
                                              const std::string& profile,
                                              const std::optional<std::string>& plaza) {
  std::vector<NightlyOrder> orders;
  for (const std::string& experiment : experiments) {
    NightlyOrder order = read_order(experiment, profile, plaza);
    for (const NightlyOrder& other : orders)
      if (other.name == order.name)
        throw InvalidInput("two experiments have the name " + printable(order.name));
    orders.push_back(std::move(order));
  }
  return orders;
}

int make_apart(const NightlyOrder& order, const fs::path& folder, int jobs,
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
    const int code = run_apart(order, folder, jobs, command, console);
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
