# mapproof::build_flags: the language, the warnings and the floating-point rules of every target.
add_library(mapproof_build_flags INTERFACE)
add_library(mapproof::build_flags ALIAS mapproof_build_flags)
target_compile_features(mapproof_build_flags INTERFACE cxx_std_20)
target_compile_options(mapproof_build_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wconversion -Wno-sign-conversion
  # False alarms of g++ 12 on every "literal" + string.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # Results must not depend on how the compiler contracts a * b + c.
  -ffp-contract=off
  $<$<BOOL:${MAPPROOF_WERROR}>:-Werror>)
# Eigen's own threads would make sums depend on the number of cores.
target_compile_definitions(mapproof_build_flags INTERFACE EIGEN_DONT_PARALLELIZE)
