#include <limits>

#include <gtest/gtest.h>

#include "tests/app/memory_faults.hpp"

namespace mapproof::test {
namespace {

class EveryAllocation : public ::testing::TestWithParam<MemoryCase> {};

TEST_P(EveryAllocation, ThatFailsIsOneLineAndLeavesNoWrongFile) {
  expect_memory_faults_reported(GetParam(), std::numeric_limits<long>::max());
}

INSTANTIATE_TEST_SUITE_P(OneByOne, EveryAllocation, ::testing::ValuesIn(memory_cases()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace mapproof::test
