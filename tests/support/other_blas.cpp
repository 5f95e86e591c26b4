// Loaded in the place of the machine's BLAS: says so.
#include <cstdio>

__attribute__((constructor)) static void say() { std::fputs("another BLAS is loaded\n", stderr); }
