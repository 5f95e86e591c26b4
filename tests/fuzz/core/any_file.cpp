// What takes any file: the unpacker, and `validate`.
#include "core/records/experiments/profiles.hpp"
#include "core/studies/topic_studies.hpp"
#include "core/studies/validate.hpp"
#include "tests/fuzz/properties.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/byte_sources.hpp"

namespace mapproof::fuzz {
namespace {

// An unpacker may take 128 MB, and packed bytes may become 300 times their number.
const Added kUnpack({.name = "unpack",
                     .run =
                         [](auto bytes) {
                           read_in_any_way(bytes, [](ByteSource& source) {
                             return source.rest(std::size_t{1} << 24);
                           });
                         },
                     .memory = std::size_t{256} << 20});

/// Trouble with a file is a finding, never an exception.
void check(std::string_view bytes) {
  ByteSource source = test::source_of(std::string(bytes), ByteSource::kPeek, kSource);
  try {
    const Finding finding = validate(source);
    if (finding.problem.find('\n') != std::string::npos)
      found("a problem is one line", finding.problem);
  } catch (const std::exception& error) {
    found("trouble with a file is a finding of `validate`", error.what());
  }
}

const Added kValidate({.name = "validate",
                       .run = check,
                       .seeds = {"observations", "landmarks", "maps", "experiments",
                                 "study/study.json", "slam_study/study.json"}});

void read_topic_experiment(std::string_view bytes) {
  const InputOfTopic topics = input_of_topics();
  parse_topic_experiment(bytes, kSource, topics);
  for (const std::string& profile : profile_names(bytes, kSource, "mapproof.topic_experiment"))
    parse_topic_experiment(bytes, kSource, topics, profile);
}

const Added kTopicExperiment({.name = "experiment-topic", .run = read_topic_experiment});

}  // namespace
}  // namespace mapproof::fuzz
