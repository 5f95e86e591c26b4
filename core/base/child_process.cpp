#include "core/base/child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <system_error>

#include <fmt/format.h>

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// Who ignores SIGCHLD hears nothing of how a child ended. A parent hands that down.
void listen_to_children() {
  struct sigaction action {};
  if (::sigaction(SIGCHLD, nullptr, &action) != 0 || action.sa_handler != SIG_IGN) return;
  action.sa_handler = SIG_DFL;
  ::sigaction(SIGCHLD, &action, nullptr);
}

/// What a program that is started does with descriptors before it runs.
class FileActions {
 public:
  FileActions() { check(::posix_spawn_file_actions_init(&actions_)); }
  ~FileActions() { ::posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;

  /// Makes `descriptor` the standard stream `number`; negative: leaves that as it is.
  void give(int descriptor, int number) {
    if (descriptor < 0) return;
    // One of the first three would be lost where an earlier stream takes its number.
    if (descriptor <= STDERR_FILENO) {
      Descriptor& copy = copies_.at(static_cast<std::size_t>(number));
      copy = Descriptor(::fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
      if (copy.get() < 0)
        throw ProcessError(fmt::format("descriptor {}: {}", descriptor, std::strerror(errno)));
      descriptor = copy.get();
    }
    check(::posix_spawn_file_actions_adddup2(&actions_, descriptor, number));
  }

  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  /// They fail for want of memory alone.
  static void check(int error) {
    if (error != 0) throw std::bad_alloc();
  }

  posix_spawn_file_actions_t actions_{};
  std::array<Descriptor, 3> copies_{Descriptor(-1), Descriptor(-1), Descriptor(-1)};
};

/// Errors that say what the file is, and not how this machine is.
bool is_about_the_file(int error) {
  constexpr std::array kErrors = {EACCES,  EISDIR,  ELIBBAD, ELOOP, ENAMETOOLONG, ENOENT,
                                  ENOEXEC, ENOTDIR, EINVAL,  EPERM, EIO,          ETXTBSY};
  return std::ranges::find(kErrors, error) != kErrors.end();
}

[[noreturn]] void refuse(const fs::path& program, int error) {
  if (error == ENOMEM) throw std::bad_alloc();
  throw ProcessError(fmt::format(
      "{} {}: {}", program.string(),
      is_about_the_file(error) ? "is not a program" : "cannot be started", std::strerror(error)));
}

/// In the copy of a process: never returns, not even by an exception.
[[noreturn]] void run_copy(pid_t parent, const std::function<int()>& work) noexcept {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(EXIT_FAILURE);
  const int code = work();
  std::fflush(nullptr);
  ::_exit(code);
}

}  // namespace

std::string ProcessEnd::text() const {
  if (signal != 0) return fmt::format("it was ended by signal {}", signal);
  return fmt::format("it ended with exit code {}", exit_code);
}

ChildProcess::ChildProcess(const ProgramCall& call, const StandardStreams& streams) {
  listen_to_children();
  FileActions files;
  files.give(streams.input, STDIN_FILENO);
  files.give(streams.output, STDOUT_FILENO);
  files.give(streams.messages, STDERR_FILENO);
  std::vector<std::string> words{call.program.string()};
  words.insert(words.end(), call.arguments.begin(), call.arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const int error = ::posix_spawn(&process_, call.program.c_str(), files.get(), nullptr,
                                  pointers.data(), environ);
  if (error != 0) {
    process_ = -1;
    refuse(call.program, error);
  }
}

ChildProcess::ChildProcess(const std::function<int()>& work) {
  listen_to_children();
  std::fflush(nullptr);  // Nothing buffered is to be written twice.
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) run_copy(parent, work);
  if (process_ < 0) throw ProcessError(fmt::format("no process: {}", std::strerror(errno)));
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : process_(std::exchange(other.process_, -1)), end_(other.end_) {}

ChildProcess::~ChildProcess() {
  if (process_ < 0) return;
  kill();
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
}

ProcessEnd ChildProcess::wait() {
  if (process_ < 0) return end_;
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0)
    if (errno != EINTR)
      throw ProcessError(fmt::format("it cannot be waited for: {}", std::strerror(errno)));
  process_ = -1;
  end_ = WIFSIGNALED(status) ? ProcessEnd{.signal = WTERMSIG(status)}
                             : ProcessEnd{.exit_code = WEXITSTATUS(status)};
  return end_;
}

void ChildProcess::kill() {
  if (process_ > 0) ::kill(process_, SIGKILL);
}

fs::path program_beside(const char* variable, const char* name) {
  if (const char* named = std::getenv(variable); named != nullptr && *named != '\0') return named;
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path beside = folder / name;
  const fs::path installed = folder.parent_path() / "libexec/mapproof" / name;
  return !is_program(beside) && is_program(installed) ? installed : beside;
}

bool is_program(const fs::path& path) { return ::access(path.c_str(), X_OK) == 0; }

Descriptor memory_file(const char* name) {
  Descriptor file(::memfd_create(name, MFD_CLOEXEC));
  if (file.get() < 0)
    throw ProcessError(fmt::format("no file in memory: {}", std::strerror(errno)));
  return file;
}

std::string content_of(const Descriptor& memory_file, std::size_t most) {
  const off_t end = ::lseek(memory_file.get(), 0, SEEK_END);
  if (end < 0) throw ProcessError(fmt::format("a file in memory: {}", std::strerror(errno)));
  const auto size = static_cast<std::size_t>(end);
  std::string bytes(std::min(size, most), '\0');
  const std::size_t first = size - bytes.size();
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t got = ::pread(memory_file.get(), bytes.data() + done, bytes.size() - done,
                                static_cast<off_t>(first + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw ProcessError("a file in memory cannot be read");
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

ProgramAnswer answer_of(const ProgramCall& call, const Descriptor& input) {
  const Descriptor output = memory_file("mapproof-output"),
                   messages = memory_file("mapproof-messages");
  if (::lseek(input.get(), 0, SEEK_SET) != 0) throw ProcessError(std::strerror(errno));
  ChildProcess process(call,
                       {.input = input.get(), .output = output.get(), .messages = messages.get()});
  const ProcessEnd end = process.wait();
  return {end, content_of(output), content_of(messages)};
}

std::string last_line(std::string_view text) {
  while (text.ends_with('\n')) text.remove_suffix(1);
  return std::string(text.substr(text.rfind('\n') + 1));
}

}  // namespace mapproof
