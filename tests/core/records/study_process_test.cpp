#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/records/studies/study_store.hpp"
#include "tests/core/records/samples.hpp"

namespace mapproof {
namespace {

using test::contents;
using test::error_of;
using test::made_up_provenance;
using test::made_up_result;
using test::small_experiment;
using test::TemporaryFolder;

StudyWriter open(const std::filesystem::path& folder) {
  return StudyWriter(folder, study_start(small_experiment(), made_up_provenance()));
}

/// A child process that does something and then waits to be killed.
class Child {
 public:
  explicit Child(const std::function<void()>& action) {
    int ready[2];
    if (::pipe(ready) != 0) return;
    process_ = ::fork();
    if (process_ == 0) {
      ::alarm(60);
      action();
      [[maybe_unused]] const ssize_t sent = ::write(ready[1], "x", 1);
      for (;;) ::pause();
    }
    char byte = 0;
    [[maybe_unused]] const ssize_t received = ::read(ready[0], &byte, 1);
    ::close(ready[0]);
    ::close(ready[1]);
  }

  void kill() const {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }

 private:
  pid_t process_ = -1;
};

/// While it lives, no file may grow beyond `bytes`: a disk that fills up.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &old_limit_);
    old_action_ = ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{.rlim_cur = bytes, .rlim_max = old_limit_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &old_limit_);
    ::signal(SIGXFSZ, old_action_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit old_limit_{};
  void (*old_action_)(int) = nullptr;
};

TEST(StudyLock, KeepsASecondProcessOutUntilTheFirstIsGone) {
  const TemporaryFolder folder;
  std::unique_ptr<StudyWriter> held;
  const Child child([&] { held = std::make_unique<StudyWriter>(open(folder.path())); });
  EXPECT_EQ(error_of([&] { open(folder.path()); }),
            folder.path().string() +
                ": is in use by another mapproof; wait for it, or choose another folder");
  child.kill();
  EXPECT_EQ(error_of([&] { open(folder.path()); }), "no error");
}

TEST(StudyLock, KeepsASecondStoreOfOneProcessOut) {
  const TemporaryFolder folder;
  const StudyWriter store = open(folder.path());
  EXPECT_NE(error_of([&] { open(folder.path()); }).find("in use"), std::string::npos);
}

TEST(StudyLock, LeavesNoFileBehind) {
  const TemporaryFolder folder;
  open(folder.path());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}),
            2);  // study.json, timings.jsonl
}

TEST(StudyWriter, EndsInTheSameBytesAfterAKill) {
  const TemporaryFolder folder;
  {
    StudyWriter store = open(folder / "straight");
    for (const RunId& id : {RunId{1, 1}, {1, 2}, {2, 1}}) store.write(part_of(made_up_result(id)));
  }
  const Child child([&] {
    StudyWriter store = open(folder / "killed");
    store.write(part_of(made_up_result({2, 1})));
    const std::string leftover =
        "killed/runs/layout-1-pose-1.json.part-" + std::to_string(::getpid()) + "-0123456789abcdef";
    folder.file(leftover, "half of a run");
    new StudyWriter(std::move(store));  // Never closed: the kill comes first.
  });
  child.kill();
  StudyWriter store = open(folder / "killed");
  EXPECT_TRUE(holds_run(folder / "killed", RunId{2, 1}));
  EXPECT_FALSE(holds_run(folder / "killed", RunId{1, 1}));
  store.write(part_of(made_up_result({1, 1})));
  store.write(part_of(made_up_result({1, 2})));
  EXPECT_EQ(contents(folder / "killed"), contents(folder / "straight"));
}

TEST(StudyWriter, LeavesNoPartOfAFileOnAFullDisk) {
  const TemporaryFolder folder;
  StudyWriter store = open(folder.path());
  const std::string before = contents(folder.path());
  {
    const FullDisk full(100);
    EXPECT_NE(error_of([&] {
                store.write(part_of(made_up_result({1, 1})));
              }).find("cannot be written"),
              std::string::npos);
  }
  EXPECT_EQ(contents(folder.path()), before);
  EXPECT_FALSE(holds_run(folder.path(), RunId{1, 1}));
  store.write(part_of(made_up_result({1, 1})));
  EXPECT_TRUE(holds_run(folder.path(), RunId{1, 1}));
}

TEST(StudyWriter, DoesNotBeginAStudyOnAFullDisk) {
  const TemporaryFolder folder;
  const FullDisk full(100);
  EXPECT_NE(error_of([&] { open(folder / "study"); }).find("study.json: cannot be written"),
            std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(folder / "study"));
}

TEST(Timings, TakeAllOfALineOrNoneOnAFullDisk) {
  const TemporaryFolder folder;
  StudyWriter store = open(folder.path());
  store.write_session(test::made_up_session());
  const std::string before = read_file(folder / "timings.jsonl");
  {
    const FullDisk full(before.size() + 10);
    EXPECT_NE(error_of([&] {
                store.write_session(test::made_up_session());
              }).find("timings.jsonl: cannot be appended to"),
              std::string::npos);
  }
  EXPECT_EQ(read_file(folder / "timings.jsonl"), before);
}

}  // namespace
}  // namespace mapproof
