#include <limits>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "tests/app/faults/fault_cases.hpp"

namespace mapproof::test {
namespace {

using CaseAndKind = std::tuple<FaultCase, std::string>;

std::string name_of(const ::testing::TestParamInfo<CaseAndKind>& one) {
  return std::get<0>(one.param).name + "_" + std::get<1>(one.param);
}

class EveryCall : public ::testing::TestWithParam<CaseAndKind> {};

TEST_P(EveryCall, ThatFailsIsOneLineAndLeavesNoWrongFile) {
  const auto& [tried, kind] = GetParam();
  for (const char* cores : {"0", "0,1"}) expect_faults_reported(tried, kind, tried.samples, cores);
}

INSTANTIATE_TEST_SUITE_P(OneByOne, EveryCall,
                         ::testing::Combine(::testing::ValuesIn(fault_cases()),
                                            ::testing::ValuesIn(kFaultKinds)),
                         name_of);

class EveryKill : public ::testing::TestWithParam<CaseAndKind> {};

TEST_P(EveryKill, LeavesWholeFilesFromWhichTheNextRunGoesOn) {
  const auto& [tried, kind] = GetParam();
  expect_kills_survived(tried, kind, std::numeric_limits<long>::max());
}

INSTANTIATE_TEST_SUITE_P(OneByOne, EveryKill,
                         ::testing::Combine(::testing::ValuesIn(kill_cases()),
                                            ::testing::Values("write", "rename")),
                         name_of);

class RandomKills : public ::testing::TestWithParam<FaultCase> {};

TEST_P(RandomKills, LeaveWholeFilesFromWhichTheNextRunGoesOn) {
  expect_random_kills_survived(GetParam(), 200, 1);
}

INSTANTIATE_TEST_SUITE_P(TwoHundred, RandomKills, ::testing::ValuesIn(kill_cases()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace mapproof::test
