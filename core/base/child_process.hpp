#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/files/descriptor.hpp"

namespace mapproof {

/// A process could not be started or waited for: one line, "/bin/x is not a program: No such file
/// or directory".
class ProcessError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How a process ended.
struct ProcessEnd {
  int exit_code = 0;  ///< 0 to 255, if no signal ended it.
  int signal = 0;     ///< Its number; 0: it ended by itself.

  bool is_success() const { return exit_code == 0 && signal == 0; }
  /// "it ended with exit code 1", "it was ended by signal 9".
  std::string text() const;

  bool operator==(const ProcessEnd&) const = default;
};

/// A program and the words that it is called with, its name apart. It gets the environment of this
/// process.
struct ProgramCall {
  std::filesystem::path program;
  std::vector<std::string> arguments = {};
};

/// The descriptors that a program gets as its standard streams; negative: that of this process.
struct StandardStreams {
  int input = -1;
  int output = -1;
  int messages = -1;
};

/// A process that this one has started, alone or among threads.
class ChildProcess {
 public:
  /// Starts a program. It gets the three streams, and no descriptor that is closed on exec, as all
  /// of this library are.
  /// @throws ProcessError if there is no such program or no process for it, std::bad_alloc.
  ChildProcess(const ProgramCall& call, const StandardStreams& streams);

  /// Runs `work` in a copy of this process, which ends with its answer as the exit code. It runs no
  /// destructor of what the caller holds. A signal ends it if this thread ends before it.
  /// @param work  Throws nothing: an exception ends the copy by SIGABRT.
  /// @throws ProcessError if there is no process for it.
  /// @note The copy has this thread alone: no other may hold a lock that `work` needs.
  explicit ChildProcess(const std::function<int()>& work);

  /// Kills a process that was not waited for.
  ~ChildProcess();
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;

  /// Waits for its end; says it again if that is known. @throws ProcessError.
  ProcessEnd wait();
  /// Ends it by SIGKILL if it runs. wait() says how it ended.
  void kill();

 private:
  pid_t process_ = -1;  ///< Negative once its end is known.
  ProcessEnd end_;
};

/// What the environment variable names, else `name` beside this program or in ../libexec/mapproof.
std::filesystem::path program_beside(const char* variable, const char* name);

bool is_program(const std::filesystem::path& path);

/// A file in memory: as a program's stream it is never full, and needs no reader meanwhile.
/// @param name  For people who list descriptors. @throws ProcessError.
Descriptor memory_file(const char* name);

/// The bytes of such a file from its start, or the last `most` of them. @throws ProcessError.
std::string content_of(const Descriptor& memory_file, std::size_t most = std::string::npos);

/// What a program gave until its end.
struct ProgramAnswer {
  ProcessEnd end;
  std::string output, messages;
};

/// Runs a program to its end. @param input  A file in memory, read from its start.
/// @throws ProcessError, std::bad_alloc.
ProgramAnswer answer_of(const ProgramCall& call, const Descriptor& input);

/// The last line that is not empty.
std::string last_line(std::string_view text);

}  // namespace mapproof
