#include "app/failures.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string_view>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/out_of_memory.hpp"
#include "render/animation/animation.hpp"
#include "render/figures/status_text.hpp"
#include "render/scene_client/scene_client.hpp"

namespace mapproof {
namespace {

constexpr const char* kNoThread =
    "no further thread can be started: the system allows no more threads or processes (ulimit -u); "
    "--jobs 1 needs the fewest";

int try_work(const std::function<int()>& work, const std::string& of) {
  try {
    return work();
  } catch (const IoError& error) {
    return report_failure(of + error.what(), kUsage);
  } catch (const InvalidInput& error) {
    return report_failure(of + error.what(), kUsage);
  } catch (const SceneError& error) {
    return report_failure(of + error.what(), kInternal);
  } catch (const AnimationError& error) {
    return report_failure(of + error.what(), kInternal);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    // The standard library and oneTBB pass on why pthread_create failed.
    if (std::string_view(error.what()).ends_with(std::strerror(EAGAIN)))
      return report_failure(of + kNoThread, kInternal);
    return report_failure(of + "internal error: " + error.what(), kInternal);
  }
}

/// What may leave a map without positions; all else is about a map that came out, or its alignment.
constexpr std::array kMayLeaveNoMap = {
    StatusCode::kNotConverged,       StatusCode::kRankDeficient,      StatusCode::kLandmarkUnseen,
    StatusCode::kDegenerateGeometry, StatusCode::kTooFewObservations, StatusCode::kFailed};

/// Why there is no map: the sentences of the statuses, each once.
std::string reasons(const std::vector<Status>& statuses) {
  std::vector<std::string> sentences;
  for (const Status& status : statuses) {
    if (std::ranges::find(kMayLeaveNoMap, status.code) == kMayLeaveNoMap.end()) continue;
    std::string sentence = status_text(status);
    if (std::ranges::find(sentences, sentence) == sentences.end())
      sentences.push_back(std::move(sentence));
  }
  std::string text;
  for (const std::string& sentence : sentences) text += (text.empty() ? "" : " ") + sentence;
  return text;
}

}  // namespace

ExitCode report_failure(const std::string& what, ExitCode code) {
  wipe_progress_line();
  // Any layer may pass on the system's message.
  const bool is_memory = what.ends_with(std::strerror(ENOMEM));
  std::cerr << "mapproof: " << (is_memory ? "out of memory: " : "") << printable(what, 4000)
            << "\n";
  return is_memory ? kInternal : code;
}

ExitCode report_no_map(const std::string& input, const std::vector<Status>& statuses) {
  const std::string why = reasons(statuses);
  return report_failure(
      input_name(input) + ": no map was made: " + (why.empty() ? "no method gave one" : why), kNo);
}

int exit_code_of(const std::function<int()>& work, const std::string& of) {
  // The message must not allocate memory.
  try {
    return try_work(work, of);
  } catch (const OutOfMemory& error) {
    std::cerr << "mapproof: " << of << error.what() << "\n";
  } catch (const std::bad_alloc&) {
    std::cerr << "mapproof: " << of << kOutOfMemory << "\n";
  }
  return kInternal;
}

}  // namespace mapproof
