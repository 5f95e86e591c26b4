#include "core/base/child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

ProgramCall shell(const std::string& words) { return {"/bin/sh", {"-c", words}}; }

ProcessEnd end_of(const ProgramCall& call) { return ChildProcess(call, {}).wait(); }

/// What a program writes, by a file in memory.
std::string output_of(const ProgramCall& call, const std::string& input = "") {
  const Descriptor in = memory_file("input"), out = memory_file("output");
  EXPECT_TRUE(write_all(in, input));
  ::lseek(in.get(), 0, SEEK_SET);
  ChildProcess child(call, {.input = in.get(), .output = out.get()});
  EXPECT_EQ(child.wait(), ProcessEnd{});
  return content_of(out);
}

/// What is said of a program that cannot be started.
std::string refusal(const fs::path& program) {
  try {
    ChildProcess(ProgramCall{program}, {});
    return "nothing";
  } catch (const ProcessError& error) {
    return error.what();
  }
}

long descriptors() {
  return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
}

bool has_children() { return ::waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD; }

TEST(ChildProcess, SaysHowItEnded) {
  EXPECT_TRUE(end_of({"/bin/true"}).is_success());
  EXPECT_EQ(end_of({"/bin/false"}), (ProcessEnd{.exit_code = 1}));
  EXPECT_EQ(end_of(shell("exit 42")).text(), "it ended with exit code 42");
  const ProcessEnd killed = end_of(shell("kill -9 $$"));
  EXPECT_EQ(killed.signal, SIGKILL);
  EXPECT_FALSE(killed.is_success());
  EXPECT_EQ(killed.text(), "it was ended by signal 9");
}

TEST(ChildProcess, SaysItsEndAsOftenAsAsked) {
  ChildProcess child(shell("exit 3"), {});
  EXPECT_EQ(child.wait().exit_code, 3);
  child.kill();
  EXPECT_EQ(child.wait().exit_code, 3);
}

TEST(ChildProcess, ThatIsNoProgramIsOneLine) {
  const TemporaryFolder folder;
  EXPECT_EQ(refusal("/nowhere/x"), "/nowhere/x is not a program: No such file or directory");
  EXPECT_EQ(refusal(folder.path()),
            folder.path().string() + " is not a program: Permission denied");
  const fs::path text = folder / "text";
  write_file(text, "words");
  EXPECT_EQ(refusal(text), text.string() + " is not a program: Permission denied");
  fs::permissions(text, fs::perms::owner_exec, fs::perm_options::add);
  EXPECT_EQ(refusal(text), text.string() + " is not a program: Exec format error");
  EXPECT_FALSE(has_children());
}

TEST(ChildProcess, GetsItsArgumentsAsTheyAre) {
  EXPECT_EQ(output_of({"/bin/echo", {"a  b", "$HOME", "'"}}), "a  b $HOME '\n");
}

TEST(ChildProcess, PassesOnWhatItIsGivenHoweverMuch) {
  std::string much;
  for (int i = 0; much.size() < (std::size_t{4} << 20); ++i) much += std::to_string(i) + "\n";
  EXPECT_TRUE(output_of({"/bin/cat"}, much) == much);
}

TEST(ChildProcess, AnswersOverASocketWhileItRuns) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
  Descriptor ours(ends[0]), theirs(ends[1]);
  ChildProcess child({"/bin/cat"}, {.input = theirs.get(), .output = theirs.get()});
  theirs.close();
  for (const std::string word : {"one", "two"}) {
    ASSERT_TRUE(write_all(ours, word));
    std::array<char, 8> got{};
    ASSERT_EQ(::read(ours.get(), got.data(), got.size()), 3);
    EXPECT_EQ(got.data(), word);
  }
  ours.close();
  EXPECT_EQ(child.wait(), ProcessEnd{});
}

TEST(ChildProcess, HasNoDescriptorOfOurs) {
  const Descriptor file(::open("/dev/null", O_RDONLY | O_CLOEXEC)), memory = memory_file("memory");
  for (const Descriptor* ours : {&file, &memory})
    EXPECT_TRUE(end_of(shell(fmt::format("test ! -e /proc/$$/fd/{}", ours->get()))).is_success());
}

/// In a copy of this process, whose standard streams are closed: files get their numbers.
int answer_without_streams() {
  for (const int stream : {0, 1, 2}) ::close(stream);
  const Descriptor out = memory_file("output"), in = memory_file("input");
  if (out.get() != 0 || in.get() != 1 || !write_all(in, "words")) return 1;
  ::lseek(in.get(), 0, SEEK_SET);
  ChildProcess child({"/bin/cat"}, {.input = in.get(), .output = out.get()});
  return child.wait().is_success() && content_of(out) == "words" ? 0 : 2;
}

TEST(ChildProcess, GetsItsStreamsAlsoWhereTheyHaveEachOthersNumbers) {
  EXPECT_EQ(ChildProcess([] { return answer_without_streams(); }).wait(), ProcessEnd{});
}

TEST(ChildProcess, LeavesNothingBehind) {
  const long before = descriptors();
  for (int i = 0; i < 20; ++i) {
    end_of({"/bin/true"});
    refusal("/nowhere/x");
    const ChildProcess unasked({"/bin/cat"}, {.input = memory_file("input").get()});
  }
  EXPECT_EQ(descriptors(), before);
  EXPECT_FALSE(has_children());
}

TEST(ChildProcess, IsKilledWithTheObjectAndWhenAsked) {
  const auto begin = std::chrono::steady_clock::now();
  { const ChildProcess unasked({"/bin/sleep", {"100"}}, {}); }
  ChildProcess child({"/bin/sleep", {"100"}}, {});
  ChildProcess other = std::move(child);
  other.kill();
  EXPECT_EQ(other.wait().signal, SIGKILL);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(50));
  EXPECT_FALSE(has_children());
}

TEST(ChildProcess, IsWaitedForThroughSignals) {
  static volatile sig_atomic_t rung = 0;
  struct sigaction action {
  }, before{};
  action.sa_handler = [](int) { rung = rung + 1; };  // Without SA_RESTART: calls end with EINTR.
  ::sigaction(SIGALRM, &action, &before);
  const itimerval often{.it_interval = {0, 5000}, .it_value = {0, 5000}}, never{};
  ::setitimer(ITIMER_REAL, &often, nullptr);
  const ProcessEnd end = end_of(shell("sleep .2; exit 7"));
  ::setitimer(ITIMER_REAL, &never, nullptr);
  ::sigaction(SIGALRM, &before, nullptr);
  EXPECT_EQ(end.exit_code, 7);
  EXPECT_GT(rung, 3);
}

TEST(ChildProcess, SaysHowItEndedAlsoToWhoWasStartedDeafToChildren) {
  const auto deaf = ::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(end_of({"/bin/false"}).exit_code, 1);
  ::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(ChildProcess([] { return 5; }).wait().exit_code, 5);
  ::signal(SIGCHLD, deaf);
}

TEST(ChildProcess, MayBeStartedByManyThreads) {
  std::array<std::thread, 8> threads;
  std::array<std::string, 8> said;
  for (std::size_t i = 0; i < threads.size(); ++i)
    threads[i] = std::thread([&said, i] {
      for (int k = 0; k < 10; ++k) said[i] += output_of({"/bin/cat"}, std::to_string(i));
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < said.size(); ++i)
    EXPECT_EQ(said[i], std::string(10, static_cast<char>('0' + i)));
}

TEST(CopyOfAProcess, EndsWithTheAnswerOfItsWork) {
  int touched = 0;
  EXPECT_EQ(ChildProcess([&] { return touched = 6; }).wait().exit_code, 6);
  EXPECT_EQ(touched, 0);
  EXPECT_EQ(ChildProcess([]() -> int { std::abort(); }).wait().signal, SIGABRT);
}

TEST(CopyOfAProcess, WritesNothingTwice) {
  const TemporaryFolder folder;
  const std::string path = (folder / "text").string();
  std::FILE* file = std::fopen(path.c_str(), "we");
  ASSERT_NE(file, nullptr);
  std::fputs("before ", file);
  ChildProcess child([file] { return std::fputs("within ", file) < 0 ? 1 : 0; });
  EXPECT_TRUE(child.wait().is_success());
  std::fclose(file);
  EXPECT_EQ(read_file(path), "before within ");
}

TEST(CopyOfAProcess, EndsWithItsParent) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  Descriptor read_end(ends[0]), write_end(ends[1]);
  ChildProcess parent([&] {
    ChildProcess child([&] { return write_all(write_end, "x") ? ::pause() : 1; });
    return child.wait().exit_code;
  });
  write_end.close();
  char byte = 0;
  ASSERT_EQ(::read(read_end.get(), &byte, 1), 1);  // The inner copy runs.
  parent.kill();
  parent.wait();
  EXPECT_EQ(::read(read_end.get(), &byte, 1), 0);  // Nobody holds the other end any more.
}

TEST(MemoryFile, GivesBackItsBytesOrTheLastOfThem) {
  const Descriptor file = memory_file("file");
  EXPECT_EQ(content_of(file), "");
  ASSERT_TRUE(write_all(file, "first\nsecond\n\n"));
  EXPECT_EQ(content_of(file), "first\nsecond\n\n");
  EXPECT_EQ(content_of(file, 4), "nd\n\n");
  EXPECT_EQ(last_line(content_of(file)), "second");
  EXPECT_EQ(last_line("one"), "one");
  EXPECT_EQ(last_line("\n"), "");
  EXPECT_THROW(content_of(Descriptor(-1)), ProcessError);
}

TEST(ProgramBeside, IsTheOneThatAVariableNames) {
  ::setenv("MAPPROOF_TEST_PROGRAM", "/some/where", 1);
  EXPECT_EQ(program_beside("MAPPROOF_TEST_PROGRAM", "x"), "/some/where");
  ::setenv("MAPPROOF_TEST_PROGRAM", "", 1);
  EXPECT_EQ(program_beside("MAPPROOF_TEST_PROGRAM", "x"),
            fs::read_symlink("/proc/self/exe").parent_path() / "x");
  ::unsetenv("MAPPROOF_TEST_PROGRAM");
}

}  // namespace
}  // namespace mapproof::test
