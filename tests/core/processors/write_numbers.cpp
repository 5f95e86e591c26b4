// Prints numbers() as JSON, to be compared with another processor's (see numbers_test.cpp).
#include <cstdio>

#include "tests/core/processors/numbers.hpp"

int main() {
  const std::string text = mapproof::test::text_of(mapproof::test::numbers());
  return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() ? 0 : 1;
}
