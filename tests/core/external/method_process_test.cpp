#include "core/external/method_process.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"

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
  return method;
}

ExternalReply answer_of(const std::string& script, double timeout_s = 20.0) {
  const ExternalMethod method = shell(script, timeout_s);
  return MethodProcess(method, "").map(request());
}

constexpr const char* kGood =
    R"({"id": "run/bearing/10", "coordinates": [[0, 1], null, [2.5, -3e1]]})";

TEST(MethodReply, HasOneRowPerLandmark) {
  const ExternalReply reply = parse_reply(kGood, request());
  ASSERT_FALSE(reply.failure) << reply.detail;
  EXPECT_EQ(reply.coordinates.row(2), Eigen::RowVector2d(2.5, -30.0));
  EXPECT_TRUE(std::isnan(reply.coordinates(1, 0)));
}

TEST(MethodReply, ThatIsNotOfTheProtocolIsNamed) {
  const auto failure_of = [](const char* line) { return parse_reply(line, request()).failure; };
  EXPECT_EQ(failure_of("not JSON"), ExternalFailure::kReply);
  EXPECT_EQ(failure_of(R"({"id": "other", "coordinates": []})"), ExternalFailure::kReply);
  EXPECT_EQ(failure_of(R"({"id": "run/bearing/10"})"), ExternalFailure::kReply);
  EXPECT_EQ(failure_of(R"({"id": "run/bearing/10", "coordinates": [[0, 1]]})"),
            ExternalFailure::kReply);
  EXPECT_EQ(failure_of(R"({"id": "run/bearing/10", "coordinates": [[0], [1], [2]]})"),
            ExternalFailure::kReply);
  EXPECT_EQ(failure_of(R"({"id": "run/bearing/10", "coordinates": [[NaN, 0], [1, 0], [0, 1]]})"),
            ExternalFailure::kNumbers);
  EXPECT_EQ(failure_of(R"({"id": "run/bearing/10", "coordinates": [null, null, null]})"),
            ExternalFailure::kNumbers);
  EXPECT_EQ(failure_of(R"({"id": "run/bearing/10", "error": "too few"})"),
            ExternalFailure::kRefused);
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
  MethodProcess process(method, "");
  for (int i = 1; i <= 3; ++i) {
    const ExternalReply reply = process.map(asked);
    ASSERT_FALSE(reply.failure) << reply.detail;
    EXPECT_EQ(reply.coordinates(0, 0), i);
  }
}

TEST(MethodProcess, ThatDoesNotAnswerIsKilled) {
  EXPECT_EQ(answer_of("sleep 100", 0.1).failure, ExternalFailure::kTimeout);
}

TEST(MethodProcess, ThatEndsIsNamedWithItsLastMessage) {
  const ExternalReply reply = answer_of("echo first >&2; echo 'no licence' >&2; exit 3");
  EXPECT_EQ(reply.failure, ExternalFailure::kEnded);
  EXPECT_EQ(reply.detail, "it ended with exit code 3: no licence");
}

TEST(MethodProcess, ThatIsNotThereCannotBeStarted) {
  ExternalMethod method = shell("");
  method.command = {"no-such-program-anywhere"};
  EXPECT_EQ(MethodProcess(method, "").map(request()).failure, ExternalFailure::kStart);
}

TEST(MethodProcess, IsStartedAgainAfterAFailure) {
  // The first process writes nonsense; the request after it is answered by another one.
  const ExternalMethod method = shell("echo nonsense");
  MethodProcess process(method, "");
  EXPECT_EQ(process.map(request()).failure, ExternalFailure::kReply);
  EXPECT_EQ(process.map(request()).failure, ExternalFailure::kReply);
}

TEST(MethodProcess, ReadsALargeRequestWhileItAnswersALot) {
  ExternalRequest asked = request();
  asked.input = Eigen::MatrixXd::Ones(3, 500'000);  // 12 MB: more than a stream holds.
  const ExternalMethod method =
      shell(std::string("cat > /dev/null & head -c 100 > /dev/null; echo '") + kGood + "'; wait");
  const ExternalReply reply = MethodProcess(method, "").map(asked);
  EXPECT_FALSE(reply.failure) << reply.detail;
}

TEST(ExternalMethods, AreReadStrictly) {
  const auto text = [](const std::string& method) {
    return R"({"schema": {"name": "mapproof.methods", "version": 1}, "methods": [)" + method + "]}";
  };
  const std::string good =
      R"({"name": "tsne", "label": "t-SNE", "input": "history", "command": ["x"],
          "parameter": {"symbol": "perplexity", "values": [5, 0.5]}})";
  const ExternalMethods methods = parse_external_methods(text(good), "methods.json");
  ASSERT_EQ(settings_of(methods).size(), 2U);
  EXPECT_EQ(slug(settings_of(methods)[1]), "tsne-perplexity0.5");
  EXPECT_EQ(label(settings_of(methods)[0]), "t-SNE, perplexity = 5");
  for (const std::string& bad :
       {std::string(R"({"name": "isomap", "label": "x", "input": "history", "command": ["x"]})"),
        std::string(R"({"name": "a", "label": "x", "input": "history", "command": []})"),
        std::string(R"({"name": "a", "label": "x", "input": "maps", "command": ["x"]})"),
        good + ", " + good})
    EXPECT_THROW(parse_external_methods(text(bad), "methods.json"), IoError) << bad;
}

}  // namespace
}  // namespace mapproof
