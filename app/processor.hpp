#pragma once

#include <string>
#include <string_view>

namespace mapproof {

/// The kind of processor that the program runs on, as the system names it, with its architecture:
/// "AMD EPYC 7763 64-Core Processor (x86_64)". Records are equal to the byte on one kind.
std::string processor_kind();

/// The same of a text like that of /proc/cpuinfo; where it has no name, as on ARM, the numbers of
/// maker and part; "unknown (riscv64)" where it has nothing of that.
std::string processor_kind(std::string_view cpuinfo, std::string_view architecture);

}  // namespace mapproof
