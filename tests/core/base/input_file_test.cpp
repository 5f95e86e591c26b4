#include "core/base/files/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/paths.hpp"
#include "tests/core/records/samples.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

using test::error_of;

/// "/dev/fd/7", as a shell calls it.
std::string shell_name(int descriptor) { return "/dev/fd/" + std::to_string(descriptor); }

TEST(Files, AreNotThereOnlyWhereTheSystemSaysSo) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.file("a.txt", "a");
  EXPECT_TRUE(is_there(file));
  EXPECT_TRUE(is_there(folder.path()));
  EXPECT_FALSE(is_there(folder / "b.txt"));
  EXPECT_FALSE(is_there(file / "b.txt"));
  std::filesystem::create_symlink("loop", folder / "loop");
  // A message holds the first 300 characters of a long name.
  for (const std::filesystem::path& path : {folder / "loop", folder / std::string(300, 'n')})
    EXPECT_NE(error_of([&] { is_there(path); })
                  .find(printable(path.string(), 300) + ": cannot be read: "),
              std::string::npos)
        << path;
}

/// A pipe that holds these bytes and was closed by who wrote them.
class FilledPipe {
 public:
  explicit FilledPipe(std::string_view bytes, int flags = 0) {
    EXPECT_EQ(::pipe2(ends_.data(), O_CLOEXEC | flags), 0);
    EXPECT_EQ(::write(ends_[1], bytes.data(), bytes.size()), std::ssize(bytes));
    ::close(ends_[1]);
  }
  ~FilledPipe() { ::close(ends_[0]); }
  FilledPipe(const FilledPipe&) = delete;
  FilledPipe& operator=(const FilledPipe&) = delete;

  std::string name() const { return shell_name(ends_[0]); }

 private:
  std::array<int, 2> ends_{};
};

TEST(InputFile, APipeThatWasHandedInIsReadToItsEnd) {
  EXPECT_EQ(read_file(FilledPipe("a,b\n").name()), "a,b\n");
  // A program before this one may have left it so.
  EXPECT_EQ(read_file(FilledPipe("a,b\n", O_NONBLOCK).name()), "a,b\n");
}

TEST(InputFile, AFileIsReadFromItsStartByWhateverName) {
  const test::TemporaryFolder folder;
  const auto path = folder.file("a.csv", "a,b\n");
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  for (int time = 0; time < 2; ++time) EXPECT_EQ(read_file(shell_name(file.get())), "a,b\n");
}

TEST(InputFile, WhatHasNoEndIsRefusedAtOnce) {
  const test::TemporaryFolder folder;
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(error_of([&] { open_input(pipe); }), pipe + ": is a named pipe, a file was expected");
  EXPECT_EQ(error_of([&] { open_input("/dev/zero"); }),
            "/dev/zero: is a device, a file was expected");
  const Descriptor zero(::open("/dev/zero", O_RDONLY | O_CLOEXEC));
  const std::string handed = shell_name(zero.get());
  EXPECT_EQ(error_of([&] { open_input(handed); }), handed + ": is a device, a file was expected");
  EXPECT_EQ(error_of([&] { open_input(folder.path()); }),
            folder.path().string() + ": is a folder, a file was expected");
  EXPECT_EQ(error_of([&] { open_input(folder / "none"); }),
            (folder / "none").string() + ": cannot be opened: No such file or directory");
  EXPECT_EQ(error_of([&] { open_input("/dev/fd/987"); }),
            "/dev/fd/987: cannot be opened: Bad file descriptor");
}

TEST(InputFile, RefusingANamedPipeDoesNotDisturbWhoWritesToIt) {
  const test::TemporaryFolder folder;
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::atomic<bool> is_open = false;
  std::thread writer([&] {
    const Descriptor file(::open(pipe.c_str(), O_WRONLY | O_CLOEXEC));  // Waits for a reader.
    is_open = file.get() >= 0;
  });
  for (int time = 0; time < 20; ++time) {
    EXPECT_THROW(open_input(pipe), IoError);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_FALSE(is_open);
  const Descriptor reader = open_streamed(pipe);
  writer.join();
  EXPECT_TRUE(is_open);
}

TEST(InputFile, StreamsAreKnownByTheirNames) {
  EXPECT_EQ(handed_in("-"), 0);
  EXPECT_EQ(handed_in("/dev/stdin"), 0);
  EXPECT_EQ(handed_in("/dev/fd/63"), 63);
  EXPECT_EQ(handed_in("/proc/self/fd/9"), 9);
  for (const char* path : {"", "--", "./-", "/dev/fd", "/dev/fd/", "/dev/fd/x", "/dev/fd/-1",
                           "/dev/fd/1/2", "/dev/fd/99999999999"})
    EXPECT_FALSE(handed_in(path)) << path;
  EXPECT_EQ(input_name("-"), "standard input");
}

TEST(InputFile, AFileMayStandThereUnpackedOrPacked) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(plain_or_packed(folder / "a.csv"), folder / "a.csv");
  folder.file("a.csv.xz", "");
  EXPECT_EQ(plain_or_packed(folder / "a.csv"), folder / "a.csv.xz");
  folder.file("a.csv.gz", "");
  EXPECT_EQ(plain_or_packed(folder / "a.csv"), folder / "a.csv.gz");
  folder.file("a.csv", "");
  EXPECT_EQ(plain_or_packed(folder / "a.csv"), folder / "a.csv");
  for (const char* name : {"a.csv", "a.csv.gz", "a.csv.xz"})
    EXPECT_EQ(unpacked_name(folder / name), folder / "a.csv");
}

}  // namespace
}  // namespace mapproof
