#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace mapproof {

// All of the program uses oneTBB through these functions. Each returns after all of its calls were
// made, or throws. The calls are a task group of their own, so that work that fails around them
// cannot cancel them, which would end them early and without an error. Where the address space of
// the process is limited (ulimit -v), they use no more threads than fit into half of what is left.

/// Calls work(0) … work(count - 1) in any order, several at a time.
/// @throws The exception of the first call that failed; others may then not have been made.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& work);

/// The same on at most `jobs` threads, even if there are fewer cores; each takes one call at a
/// time. While it runs, no more than `jobs` threads work in the whole program.
/// @pre jobs >= 1
void parallel_for(int jobs, std::size_t count, const std::function<void(std::size_t)>& work);

/// Calls both, at the same time if a thread is free.
/// @throws The exception of the first that failed.
void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second);

/// Calls `work`. A thread that waits in it for others takes no task from outside of it, whose
/// memory it would hold as well.
void run_isolated(const std::function<void()>& work);

/// Version of the oneTBB that is loaded: "2021.8.0".
std::string parallel_library_version();

}  // namespace mapproof
