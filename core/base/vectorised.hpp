#pragma once

/// Before a function whose loops gain from wide vectors: it is compiled for AVX2 as well, and the
/// program takes what the processor has. Nothing on other processors than x86-64. Results must not
/// depend on the width: no sum that the compiler would have to reorder.
///
/// Nothing by Clang 19 either, which does not emit the inline functions that only a clone calls, nor
/// under ThreadSanitizer, which is not ready when the choice is made.
#if defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define MAPPROOF_VECTORISED [[gnu::target_clones("avx2", "default")]]
/// The same, and AVX-512 too: for loops over eight entries at a time.
#define MAPPROOF_VECTORISED_WIDE [[gnu::target_clones("avx512f", "avx2", "default")]]
#else
#define MAPPROOF_VECTORISED
#define MAPPROOF_VECTORISED_WIDE
#endif
