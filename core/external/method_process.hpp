#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/model/experiment.hpp"
#include "core/model/points.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// One map that a method is asked for.
struct ExternalRequest {
  std::string id;      ///< "layout-1-pose-1/bearing/2000".
  std::string sensor;  ///< "bearing".
  int steps = 0;
  std::vector<std::string> landmarks;  ///< M names.
  Eigen::MatrixXd input;               ///< M rows; see ExternalInput.
  std::optional<double> parameter;
  std::uint64_t seed = 0;  ///< Below 2^53.
};

/// What a method answered.
struct ExternalReply {
  Points coordinates;             ///< M x 2, any frame; NaN rows: no position.
  std::optional<Status> failure;  ///< kFailed: then there are no coordinates.
};

/// What records name instead of a text that holds private paths; empty: the text itself.
using Disclosed = std::function<std::string(std::string text)>;

/// A method's process, which answers one request after another: it is started by the first one,
/// and again after a failure. Protocol 1 is in docs/external-methods.md.
class MethodProcess {
 public:
  /// @param method     Outlives the process.
  /// @param disclosed  Of what the process says.
  /// @throws InvalidInput if the method has no folder.
  explicit MethodProcess(const ExternalMethod& method, Disclosed disclosed = {});
  ~MethodProcess();
  MethodProcess(MethodProcess&&) noexcept;

  /// Not thread-safe. @throws ProcessError if this machine has no process, std::bad_alloc.
  ExternalReply map(const ExternalRequest& request);

 private:
  struct Running;
  const ExternalMethod& method_;
  Disclosed disclosed_;
  std::unique_ptr<Running> running_;
};

/// The processes of some methods: as many of each as threads ask at a time.
class MethodProcesses {
 public:
  /// @throws InvalidInput if a method has no folder, so that nobody named it to be started.
  explicit MethodProcesses(const std::vector<ExternalMethod>& methods,
                           const Disclosed& disclosed = {});
  ~MethodProcesses();
  MethodProcesses(const MethodProcesses&) = delete;
  MethodProcesses& operator=(const MethodProcesses&) = delete;

  /// Thread-safe. @param method  The name of one of the methods. @throws as MethodProcess::map().
  ExternalReply map(const std::string& method, const ExternalRequest& request);

 private:
  struct Pool;
  std::vector<std::unique_ptr<Pool>> pools_;
};

/// The line and the bytes of a request, as the process reads them.
std::string request_bytes(const ExternalRequest& request, ExternalInput input);

/// Reads the answer to a request. @param line  Without its line end.
ExternalReply parse_reply(std::string_view line, const ExternalRequest& request);

}  // namespace mapproof
