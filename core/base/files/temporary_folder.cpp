#include "core/base/files/temporary_folder.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <vector>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// Locks a folder of this user. @return None if it is another's, or is locked already.
Descriptor locked(const fs::path& folder) {
  Descriptor lock(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  struct stat facts {};
  if (lock.get() < 0 || ::fstat(lock.get(), &facts) != 0 || facts.st_uid != ::geteuid() ||
      ::flock(lock.get(), LOCK_EX | LOCK_NB) != 0)
    return Descriptor(-1);
  return lock;
}

/// Removes the folders of runs that were killed: those that nobody holds locked.
void remove_abandoned(const fs::path& parent, const std::string& prefix) {
  std::error_code error;
  std::vector<fs::path> folders;
  for (fs::directory_iterator it(parent, error), end; !error && it != end; it.increment(error))
    if (it->path().filename().string().starts_with(prefix)) folders.push_back(it->path());
  for (const fs::path& folder : folders)
    if (const Descriptor lock = locked(folder); lock.get() >= 0) fs::remove_all(folder, error);
}

}  // namespace

TemporaryFolder::TemporaryFolder(const std::string& purpose) {
  const fs::path parent = fs::temp_directory_path();
  const std::string prefix = "mapproof-" + purpose + "-";
  remove_abandoned(parent, prefix);
  // One that another run took for abandoned before it was locked is made again.
  while (true) {
    std::string name = (parent / (prefix + "XXXXXX")).string();
    if (::mkdtemp(name.data()) == nullptr) throw IoError(name, std::strerror(errno));
    lock_ = locked(name);
    const bool is_taken = lock_.get() < 0 && errno == EWOULDBLOCK;
    if (std::error_code error; !is_taken && fs::exists(name, error)) {
      path_ = name;
      return;
    }
  }
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code error;
  if (!path_.empty()) fs::remove_all(path_, error);
}

}  // namespace mapproof
