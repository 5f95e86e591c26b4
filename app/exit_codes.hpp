#pragma once

namespace mapproof {

/// What every command ends with.
enum ExitCode {
  kDone = 0,      ///< Done.
  kNo = 1,        ///< The check failed, or there is no map.
  kUsage = 2,     ///< Usage or input.
  kInternal = 3,  ///< A fault of the program.
  kCostGrew = 4,  ///< Of nightly: only seconds or memory got worse.
  kCannotTest = 125,  ///< Of nightly --bisect: git bisect skips the commit.
};

/// As the help of a command ends; nightly has one of its own.
inline constexpr const char* kExitCodes =
    "Exit codes:\n"
    "  0  done\n"
    "  1  the check failed, or there is no map\n"
    "  2  wrong usage or input\n"
    "  3  internal error\n";

}  // namespace mapproof
