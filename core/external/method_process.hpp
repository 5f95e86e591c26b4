#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/external/external_method.hpp"
#include "core/model/points.hpp"

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

/// How a request ended other than with a map.
enum class ExternalFailure {
  kStart,    ///< The command could not be started.
  kTimeout,  ///< No answer in time; the process was killed.
  kEnded,    ///< The process ended without an answer.
  kReply,    ///< The answer is not one of the protocol: no JSON, another id, a wrong shape.
  kNumbers,  ///< A coordinate is not a finite number, or no landmark has a position.
  kRefused,  ///< The method says that it has no map.
};

/// "cannot be started", "timed out", …
std::string_view name(ExternalFailure failure);

/// What a method answered.
struct ExternalReply {
  Points coordinates;                      ///< M x 2, any frame; NaN rows: no position.
  std::optional<ExternalFailure> failure;  ///< Then there are no coordinates.
  std::string detail;                      ///< One line for readers, such as the last of stderr.
};

/// A method's process, which answers one request after another: it is started by the first one,
/// and again after a failure. Protocol 1 is in docs/external-methods.md.
class MethodProcess {
 public:
  /// @param folder  Where the command is started.
  MethodProcess(const ExternalMethod& method, std::filesystem::path folder);
  ~MethodProcess();
  MethodProcess(MethodProcess&&) noexcept;

  /// Not thread-safe. @throws ProcessError if this machine has no process, std::bad_alloc.
  ExternalReply map(const ExternalRequest& request);

 private:
  struct Running;
  const ExternalMethod& method_;
  std::filesystem::path folder_;
  std::unique_ptr<Running> running_;
};

/// The line and the bytes of a request, as the process reads them.
std::string request_bytes(const ExternalRequest& request, ExternalInput input);

/// Reads the answer to a request. @param line  Without its line end.
ExternalReply parse_reply(std::string_view line, const ExternalRequest& request);

}  // namespace mapproof
