// A library for LD_PRELOAD that lets calls of a program fail, or ends the program at them.
//
//   MAPPROOF_FAULT        rules, comma between: KIND:FIRST-LAST:WHAT. The calls FIRST to LAST of
//                         the kind, counted from 1 over all threads, fail or kill. LAST may be
//                         left out. A call may be of several kinds, see `Kind`.
//   MAPPROOF_FAULT_IN     the name of the program that it is for; missing: of all.
//   MAPPROOF_FAULT_COUNT  a file that gets the number of calls of each kind at the end.

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

enum class Kind : std::size_t {
  kAlloc,     ///< Memory of at least 64 KiB.
  kDisk,      ///< What changes a file system.
  kExchange,  ///< renameat2, which some file systems do not know.
  kLink,      ///< linkat, likewise.
  kOpen,      ///< Files and folders, to read or to write.
  kWrite,     ///< All but the standard streams.
  kSync,
  kRename,
  kClose,  ///< It closes the file, and fails.
  kMap,    ///< Memory or a file, of any size.
  kFork,   ///< A process of any kind.
  kExec,   ///< Another program.
  kLock,   ///< flock, which some network file systems do not know.
  kThread,
};

struct Rule {
  const char* name;
  int error;
  long first = 0, last = -1;
  bool kills = false;
  std::atomic<long> calls = 0;
};

std::array<Rule, 14> rules{{{"alloc", ENOMEM},
                            {"disk", EIO},
                            {"exchange", EINVAL},
                            {"link", EPERM},
                            {"open", EMFILE},
                            {"write", ENOSPC},
                            {"fsync", EIO},
                            {"rename", EACCES},
                            {"close", EIO},
                            {"mmap", ENOMEM},
                            {"fork", EAGAIN},
                            {"exec", EACCES},
                            {"lock", ENOLCK},
                            {"thread", EAGAIN}}};
std::atomic<bool> is_on = false;
const char* counts = nullptr;  // Programs may clear their environment.

/// Counts a call. @return Whether it has to fail; errno is set then.
bool fails(Kind kind) {
  if (!is_on) return false;
  Rule& rule = rules[static_cast<std::size_t>(kind)];
  const long call = ++rule.calls;
  if (call < rule.first || call > rule.last) return false;
  if (rule.kills) ::syscall(SYS_kill, ::getpid(), SIGKILL);
  errno = rule.error;
  return true;
}

/// The same of a call of several kinds, of which each counts it.
template <typename... Kinds>
bool fails(Kind kind, Kinds... more) {
  const bool does = fails(kind);
  return fails(more...) || does;
}

bool fails(std::size_t bytes) { return bytes >= std::size_t{1} << 16 && fails(Kind::kAlloc); }

void read_rule(const char* text) {
  std::array<char, 32> name{}, what{};
  long first = 0, last = 0;
  const bool open =
      std::sscanf(text, "%31[a-z]:%ld-:%31[a-z]", name.data(), &first, what.data()) == 3;
  if (!open &&
      std::sscanf(text, "%31[a-z]:%ld-%ld:%31[a-z]", name.data(), &first, &last, what.data()) != 4)
    std::abort();
  for (Rule& rule : rules)
    if (std::strcmp(rule.name, name.data()) == 0) {
      rule.first = first;
      rule.last = open ? LONG_MAX : last;
      rule.kills = std::strcmp(what.data(), "kill") == 0;
    }
}

__attribute__((constructor)) void read_rules() {
  const char* program = std::getenv("MAPPROOF_FAULT_IN");
  if (program != nullptr && std::strcmp(program, program_invocation_short_name) != 0) return;
  for (const char* rule = std::getenv("MAPPROOF_FAULT"); rule != nullptr && *rule != '\0';) {
    read_rule(rule);
    rule = std::strchr(rule, ',');
    if (rule != nullptr) ++rule;
  }
  counts = std::getenv("MAPPROOF_FAULT_COUNT");
  is_on = true;
}

__attribute__((destructor)) void write_counts() {
  if (!is_on.exchange(false) || counts == nullptr) return;
  const int file = ::open(counts, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  for (const Rule& rule : rules) ::dprintf(file, "%s %ld\n", rule.name, rule.calls.load());
  ::close(file);
}

/// @param arguments  Of the system call, at most five.
long changing(long number, std::array<long, 5> arguments) {
  const auto [a, b, c, d, e] = arguments;
  return fails(Kind::kDisk) ? -1 : ::syscall(number, a, b, c, d, e);
}

long at(const char* path) { return reinterpret_cast<long>(path); }

/// Whether an open fails. @param changes  It makes or empties a file.
bool open_fails(bool changes) {
  return changes ? fails(Kind::kOpen, Kind::kDisk) : fails(Kind::kOpen);
}

int opened(int folder, const char* path, int flags, mode_t mode) {
  if (open_fails((flags & (O_CREAT | O_TRUNC)) != 0)) return -1;
  return static_cast<int>(::syscall(SYS_openat, folder, path, flags, mode));
}

/// The function of that name which this one stands before.
template <typename Function>
Function real(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

/// Whether code of oneTBB's allocator stands there. Version 2022.1 holds the locks that its own
/// exception needs while it sets up its threads: if memory is short just then, it waits for ever.
bool is_of_tbb(void* code) {
  Dl_info facts{};
  return ::dladdr(code, &facts) != 0 && facts.dli_fname != nullptr &&
         std::strstr(facts.dli_fname, "libtbbmalloc") != nullptr;
}

using Spawn = decltype(&::posix_spawn);

mode_t mode_in(int flags, std::va_list more) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
}

}  // namespace

extern "C" {

void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t bytes) { return fails(bytes) ? nullptr : __libc_malloc(bytes); }
void* calloc(std::size_t count, std::size_t bytes) {
  return fails(count * bytes) ? nullptr : __libc_calloc(count, bytes);
}
void* realloc(void* old, std::size_t bytes) {
  return fails(bytes) ? nullptr : __libc_realloc(old, bytes);
}
void* memalign(std::size_t alignment, std::size_t bytes) {
  return fails(bytes) ? nullptr : __libc_memalign(alignment, bytes);
}
void* aligned_alloc(std::size_t alignment, std::size_t bytes) { return memalign(alignment, bytes); }
int posix_memalign(void** out, std::size_t alignment, std::size_t bytes) {
  *out = memalign(alignment, bytes);
  return *out == nullptr ? ENOMEM : 0;
}
void* mmap(void* address, std::size_t bytes, int access, int flags, int file, off_t from) {
  if (!is_of_tbb(__builtin_return_address(0))) {
    const bool does = fails(Kind::kMap);
    if (fails(bytes) || does) return MAP_FAILED;
  }
  return reinterpret_cast<void*>(::syscall(SYS_mmap, address, bytes, access, flags, file, from));
}
void* mmap64(void* address, std::size_t bytes, int access, int flags, int file, off_t from)
    __attribute__((alias("mmap")));

int open(const char* path, int flags, ...) {
  std::va_list more;
  va_start(more, flags);
  const int file = opened(AT_FDCWD, path, flags, mode_in(flags, more));
  va_end(more);
  return file;
}
int openat(int folder, const char* path, int flags, ...) {
  std::va_list more;
  va_start(more, flags);
  const int file = opened(folder, path, flags, mode_in(flags, more));
  va_end(more);
  return file;
}
int open64(const char*, int, ...) __attribute__((alias("open")));
int openat64(int, const char*, int, ...) __attribute__((alias("openat")));

ssize_t write(int file, const void* bytes, std::size_t count) {
  if (file > STDERR_FILENO && fails(Kind::kWrite, Kind::kDisk)) return -1;
  return ::syscall(SYS_write, file, bytes, count);
}
ssize_t pwrite(int file, const void* bytes, std::size_t count, off_t to) {
  if (fails(Kind::kWrite, Kind::kDisk)) return -1;
  return ::syscall(SYS_pwrite64, file, bytes, count, to);
}
ssize_t pwrite64(int, const void*, std::size_t, off_t) __attribute__((alias("pwrite")));
ssize_t writev(int file, const iovec* parts, int count) {
  if (file > STDERR_FILENO && fails(Kind::kWrite, Kind::kDisk)) return -1;
  return ::syscall(SYS_writev, file, parts, count);
}
int fsync(int file) {
  return fails(Kind::kSync, Kind::kDisk) ? -1 : static_cast<int>(::syscall(SYS_fsync, file));
}
int fdatasync(int file) {
  return fails(Kind::kSync) ? -1 : static_cast<int>(::syscall(SYS_fdatasync, file));
}
int close(int file) {
  const int code = static_cast<int>(::syscall(SYS_close, file));
  return fails(Kind::kClose) ? -1 : code;
}
FILE* fopen(const char* path, const char* mode) {
  if (open_fails(mode[0] != 'r')) return nullptr;
  return real<decltype(&::fopen)>("fopen")(path, mode);
}
FILE* fopen64(const char*, const char*) __attribute__((alias("fopen")));

pid_t fork() noexcept { return fails(Kind::kFork) ? -1 : real<pid_t (*)()>("fork")(); }
int posix_spawn(pid_t* process, const char* path, const posix_spawn_file_actions_t* actions,
                const posix_spawnattr_t* attributes, char* const words[], char* const names[]) {
  if (fails(Kind::kFork, Kind::kExec)) return errno;
  return real<Spawn>("posix_spawn")(process, path, actions, attributes, words, names);
}
int posix_spawnp(pid_t* process, const char* file, const posix_spawn_file_actions_t* actions,
                 const posix_spawnattr_t* attributes, char* const words[], char* const names[]) {
  if (fails(Kind::kFork, Kind::kExec)) return errno;
  return real<Spawn>("posix_spawnp")(process, file, actions, attributes, words, names);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*),
                   void* argument) noexcept {
  if (fails(Kind::kThread)) return errno;
  return real<int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)>(
      "pthread_create")(thread, attributes, work, argument);
}

// Named by its symbol: the system has a struct of that name too.
int lock(int file, int how) noexcept __asm__("flock");
int lock(int file, int how) noexcept {
  return fails(Kind::kLock) ? -1 : real<int (*)(int, int)>("flock")(file, how);
}

int rename(const char* from, const char* to) {
  if (fails(Kind::kRename)) return -1;
  return static_cast<int>(changing(SYS_renameat2, {AT_FDCWD, at(from), AT_FDCWD, at(to)}));
}
int renameat(int from_folder, const char* from, int to_folder, const char* to) noexcept {
  if (fails(Kind::kRename)) return -1;
  return static_cast<int>(changing(SYS_renameat2, {from_folder, at(from), to_folder, at(to)}));
}
int renameat2(int from_folder, const char* from, int to_folder, const char* to,
              unsigned flags) noexcept {
  if (fails(Kind::kRename, Kind::kExchange)) return -1;
  return static_cast<int>(
      changing(SYS_renameat2, {from_folder, at(from), to_folder, at(to), flags}));
}
int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) noexcept {
  if (fails(Kind::kLink)) return -1;
  return static_cast<int>(changing(SYS_linkat, {from_folder, at(from), to_folder, at(to), flags}));
}
int symlink(const char* target, const char* path) noexcept {
  return static_cast<int>(changing(SYS_symlinkat, {at(target), AT_FDCWD, at(path)}));
}
int unlink(const char* path) noexcept {
  return static_cast<int>(changing(SYS_unlinkat, {AT_FDCWD, at(path), 0}));
}
int unlinkat(int folder, const char* path, int flags) noexcept {
  return static_cast<int>(changing(SYS_unlinkat, {folder, at(path), flags}));
}
int mkdirat(int folder, const char* path, mode_t mode) noexcept {
  return static_cast<int>(changing(SYS_mkdirat, {folder, at(path), mode}));
}
int mkdir(const char* path, mode_t mode) noexcept {
  return static_cast<int>(changing(SYS_mkdirat, {AT_FDCWD, at(path), mode}));
}
int chmod(const char* path, mode_t mode) noexcept {
  return static_cast<int>(changing(SYS_fchmodat, {AT_FDCWD, at(path), mode}));
}
int fchmod(int file, mode_t mode) noexcept {
  return static_cast<int>(changing(SYS_fchmod, {file, mode, 0}));
}
int ftruncate(int file, off_t bytes) noexcept {
  return static_cast<int>(changing(SYS_ftruncate, {file, bytes, 0}));
}

}  // extern "C"
