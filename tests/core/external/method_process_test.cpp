#include "core/external/method_process.hpp"

#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/not_finite.hpp"
#include "core/model/experiment.hpp"
#include "core/records/experiments/external_methods.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

ExternalRequest request(const std::string& id = "run/bearing/10") {
  return {.id = id,
          .sensor = "bearing",
          .steps = 10,
          .landmarks = {"a", "b", "c"},
          .input = Eigen::MatrixXd::Identity(3, 3),
          .parameter = {},
          .seed = 7};
}

ExternalMethod shell(const std::string& script, double timeout_s = 20.0) {
  ExternalMethod method;
  method.name = "test";
  method.command = {"sh", "-c", script};
  method.timeout_s = timeout_s;
  method.folder = "";
  return method;
}

ExternalReply answer_of(const std::string& script, double timeout_s = 20.0) {
  const ExternalMethod method = shell(script, timeout_s);
  return MethodProcess(method).map(request());
}

constexpr const char* kGood =
    R"({"id": "run/bearing/10", "coordinates": [[0, 1], null, [2.5, -3e1]]})";

TEST(MethodReply, HasOneRowPerLandmark) {
  const ExternalReply reply = parse_reply(kGood, request());
  ASSERT_FALSE(reply.failure);
  EXPECT_EQ(reply.coordinates.row(2), Eigen::RowVector2d(2.5, -30.0));
  EXPECT_TRUE(std::isnan(reply.coordinates(1, 0)));
}

TEST(MethodReply, ThatIsNotOfTheProtocolIsNamed) {
  const auto failure_of = [](const char* line) {
    return parse_reply(line, request()).failure.value().reason;
  };
  EXPECT_EQ(failure_of("not JSON"), StatusReason::kMethodReply);
  EXPECT_EQ(failure_of(R"({"id": "other", "coordinates": []})"), StatusReason::kMethodReply);
  EXPECT_EQ(failure_of(R"({"id": "run/bearing/10"})"), StatusReason::kMethodReply);
  EXPECT_EQ(failure_of(R"({"id": "run/bearing/10", "coordinates": [[0, 1]]})"),
            StatusReason::kMethodReply);
  EXPECT_EQ(failure_of(R"({"id": "run/bearing/10", "coordinates": [[0], [1], [2]]})"),
            StatusReason::kMethodReply);
  EXPECT_EQ(failure_of(R"({"id": "run/bearing/10", "coordinates": [[NaN, 0], [1, 0], [0, 1]]})"),
            StatusReason::kMethodNumbers);
  EXPECT_EQ(failure_of(R"({"id": "run/bearing/10", "coordinates": [null, null, null]})"),
            StatusReason::kMethodNumbers);
  EXPECT_EQ(failure_of(R"({"id": "run/bearing/10", "error": "too few"})"),
            StatusReason::kMethodRefused);
}

TEST(MethodRequest, IsALineAndTheRowsOfTheMatrix) {
  ExternalRequest asked = request();
  asked.input = Eigen::MatrixXd(3, 2);
  asked.input << 1, 2, 3, 4, 5, kInfinity;
  const std::string bytes = request_bytes(asked, ExternalInput::kFeatures);
  const std::size_t end = bytes.find('\n');
  ASSERT_NE(end, std::string::npos);
  EXPECT_EQ(bytes.substr(0, end),
            R"({"protocol":1,"id":"run/bearing/10","input":"features","rows":3,"columns":2,)"
            R"("bytes":48,"sensor":"bearing","steps":10,"parameter":null,"seed":7,)"
            R"("landmarks":["a","b","c"]})");
  ASSERT_EQ(bytes.size(), end + 1 + 48);
  double second = 0.0;
  bytes.copy(reinterpret_cast<char*>(&second), 8, end + 1 + 8);
  EXPECT_EQ(second, 2.0);
}

TEST(MethodProcess, AnswersOneRequestAfterAnother) {
  // It counts the requests that it got, so that it must be one process.
  const ExternalMethod method = shell(
      "n=0; while head -c 300 > /dev/null; do n=$((n+1)); "
      R"(echo "{\"id\": \"run/bearing/10\", \"coordinates\": [[$n, 1], [0, 0], [0, 2]]}"; done)");
  ExternalRequest asked = request();
  // 300 bytes with line and matrix.
  const std::size_t bytes = request_bytes(asked, method.input).size();
  asked.sensor += std::string(300 - bytes, 'x');
  MethodProcess process(method);
  for (int i = 1; i <= 3; ++i) {
    const ExternalReply reply = process.map(asked);
    ASSERT_FALSE(reply.failure);
    EXPECT_EQ(reply.coordinates(0, 0), i);
  }
}

TEST(MethodProcess, ThatDoesNotAnswerIsKilled) {
  const Status status = answer_of("sleep 100", 0.1).failure.value();
  EXPECT_EQ(status, status_of<StatusReason::kMethodTimeout>(0.1));
}

TEST(MethodProcess, ThatEndsIsNamedWithItsLastMessage) {
  const ExternalReply reply = answer_of("echo first >&2; echo 'no licence.' >&2; exit 3");
  EXPECT_EQ(reply.failure.value(),
            status_of<StatusReason::kMethodEnded>({"it ended with exit code 3: no licence"}));
}

TEST(MethodProcess, HasOneThreadUnlessTheEnvironmentGivesANumber) {
  const auto threads = [] {
    const ExternalReply reply = answer_of("echo $OMP_NUM_THREADS threads >&2; exit 3");
    return reply.failure.value().names.front();
  };
  const char* before = std::getenv("OMP_NUM_THREADS");
  const std::string given = before == nullptr ? "" : before;
  ::unsetenv("OMP_NUM_THREADS");
  EXPECT_EQ(threads(), "it ended with exit code 3: 1 threads");
  ::setenv("OMP_NUM_THREADS", "3", 1);
  EXPECT_EQ(threads(), "it ended with exit code 3: 3 threads");
  ::unsetenv("OMP_NUM_THREADS");
  if (before != nullptr) ::setenv("OMP_NUM_THREADS", given.c_str(), 1);
}

TEST(MethodProcess, ThatIsNotThereCannotBeStarted) {
  ExternalMethod method = shell("");
  method.command = {"no-such-program-anywhere"};
  EXPECT_EQ(MethodProcess(method).map(request()).failure.value().reason,
            StatusReason::kMethodNotStarted);
}

TEST(MethodProcess, IsNotStartedWhereRecordsAloneNameIt) {
  ExternalMethod method = shell("");
  method.folder.reset();
  EXPECT_THROW(MethodProcess{method}, InvalidInput);
  EXPECT_THROW(MethodProcesses({method}), InvalidInput);
}

TEST(MethodProcesses, AreFoundByTheirNames) {
  ExternalMethod one =
      shell("cat > /dev/null & echo '{\"id\": \"run/bearing/10\", \"error\": \"1\"}'");
  ExternalMethod two =
      shell("cat > /dev/null & echo '{\"id\": \"run/bearing/10\", \"error\": \"2\"}'");
  one.name = "one";
  two.name = "two";
  MethodProcesses processes({one, two});
  EXPECT_EQ(processes.map("two", request()).failure.value(),
            status_of<StatusReason::kMethodRefused>({"2"}));
  EXPECT_THROW(processes.map("three", request()), InvalidInput);
}

TEST(MethodProcess, IsStartedAgainAfterAFailure) {
  // The first process writes nonsense; the request after it is answered by another one.
  const ExternalMethod method = shell("echo nonsense");
  MethodProcess process(method);
  EXPECT_EQ(process.map(request()).failure.value().reason, StatusReason::kMethodReply);
  EXPECT_EQ(process.map(request()).failure.value().reason, StatusReason::kMethodReply);
}

TEST(MethodProcess, ReadsALargeRequestWhileItAnswersALot) {
  ExternalRequest asked = request();
  asked.input = Eigen::MatrixXd::Ones(3, 500'000);  // 12 MB: more than a stream holds.
  const ExternalMethod method =
      shell(std::string("cat > /dev/null & head -c 100 > /dev/null; echo '") + kGood + "'; wait");
  const ExternalReply reply = MethodProcess(method).map(asked);
  EXPECT_FALSE(reply.failure);
}

std::string file_of(const std::string& methods) {
  return R"({"schema": {"name": "mapproof.methods", "version": 1}, "methods": [)" + methods + "]}";
}

constexpr const char* kTsne =
    R"({"name": "tsne", "label": "t-SNE", "input": "history", "command": ["x"],
        "parameter": {"symbol": "perplexity", "values": [0.5, 5]}})";

TEST(ExternalMethods, AreReadStrictly) {
  const std::vector<ExternalMethod> methods =
      parse_external_methods(file_of(kTsne), "folder/methods.json");
  EXPECT_EQ(methods.at(0).folder, "folder");
  const std::vector<MethodSetting> settings =
      settings_of(std::vector{MethodGrid{method_of(methods[0]), methods[0].values}});
  ASSERT_EQ(settings.size(), 2U);
  EXPECT_EQ(slug(settings[0]), "tsne-perplexity0.5");
  EXPECT_EQ(label(settings[1]), "t-SNE, perplexity = 5");
  for (const std::string& bad :
       {// A name of mapproof, no command, an unknown input, a name twice, an id twice.
        std::string(R"({"name": "isomap", "label": "x", "input": "history", "command": ["x"]})"),
        std::string(R"({"name": "pairs", "label": "x", "input": "history", "command": ["x"]})"),
        std::string(R"({"name": "a", "label": "x", "input": "history", "command": []})"),
        std::string(R"({"name": "a", "label": "x", "input": "maps", "command": ["x"]})"),
        std::string(kTsne) + ", " + kTsne,
        std::string(R"({"name": "a-b5", "label": "x", "input": "history", "command": ["x"]},
                          {"name": "a", "label": "x", "input": "history", "command": ["x"],
                           "parameter": {"symbol": "b", "values": [5]}})"),
        std::string(R"({"name": "a", "label": "x", "input": "history", "command": ["x"],
                           "parameter": {"symbol": "b_c", "values": [5]}})")})
    EXPECT_THROW(parse_external_methods(file_of(bad), "methods.json"), IoError) << bad;
}

TEST(ExternalMethods, HaveTheDigestOfTheirFilesBelowTheirFolder) {
  const test::TemporaryFolder folder;
  ExternalMethod method = parse_external_methods(file_of(kTsne), folder / "methods.json").at(0);
  EXPECT_EQ(digest_of(method), "");
  method.files = {"b.py", "a.py"};
  EXPECT_THROW(digest_of(method), IoError);
  write_file(folder / "a.py", "a");
  write_file(folder / "b.py", "b");
  const std::string digest = digest_of(method);
  EXPECT_EQ(digest.size(), 64U);
  method.files = {"a.py", "b.py"};
  EXPECT_EQ(digest_of(method), digest);
  write_file(folder / "b.py", "c");
  EXPECT_NE(digest_of(method), digest);
  for (const char* outside : {"../a.py", "/etc/hostname"}) {
    method.files = {outside};
    EXPECT_THROW(digest_of(method), IoError) << outside;
  }
}

}  // namespace
}  // namespace mapproof
