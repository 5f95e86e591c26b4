#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace mapproof {

// The only way to oneTBB. What these are asked to do is done when they return; otherwise they throw.
// The work of each is a group of its own: the failure of work around it cannot cancel it, which
// would end it early and in silence. Where the address space of the process is limited, there are no
// more threads than have room.

/// Calls work(0) … work(count - 1) in any order, several at a time.
/// @throws What the first call that failed threw; some of the others were not made then.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& work);

/// The same with a limit of its own: calls are shared out one by one, to `jobs` threads, even if
/// there are fewer cores. While it runs, no more work elsewhere in the program.
/// @pre jobs >= 1
void parallel_for(int jobs, std::size_t count, const std::function<void(std::size_t)>& work);

/// Calls both, at the same time if a thread is free. @throws What the first to fail threw.
void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second);

/// Calls `work`. A thread that waits in it for others takes no work from outside of it meanwhile,
/// whose memory it would hold as well.
void run_isolated(const std::function<void()>& work);

/// Of the library that is loaded: "2021.8.0".
std::string parallel_library_version();

}  // namespace mapproof
