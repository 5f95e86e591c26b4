#pragma once

#include <csignal>
#include <string>

#include "core/base/descriptor.hpp"

namespace mapproof {

/// A file that others write to while it is read, a pipe or a device.
class GrowingFile {
 public:
  /// @param path  "-": standard input. @throws IoError if it cannot be opened.
  explicit GrowingFile(const std::string& path);

  enum class State {
    kMore,      ///< Bytes came.
    kNothing,   ///< None now; there may be more.
    kEnd,       ///< There will be none: a pipe was closed.
    kReplaced,  ///< The file was cut short, removed or replaced by another: what follows is none
                ///< of it.
  };

  /// Reads what is there, at most 64 KiB. Waits for a pipe up to `seconds`, for a signal less.
  /// @throws IoError if it cannot be read.
  State read(std::string& bytes, double seconds);

  const std::string& name() const { return name_; }

 private:
  bool replaced() const;

  std::string path_;
  std::string name_;
  Descriptor file_;
  bool regular_ = false;
  long long at_ = 0;
};

/// Takes SIGINT and SIGTERM as long as it lives: they ask to end, instead of ending the program.
class EndSignals {
 public:
  EndSignals();
  ~EndSignals();
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;

  bool asked() const;

 private:
  struct sigaction interrupt_;
  struct sigaction terminate_;
};

}  // namespace mapproof
