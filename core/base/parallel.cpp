#include "core/base/parallel.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/version.h>

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace mapproof {
namespace {

/// Tells ThreadSanitizer the order that oneTBB keeps, whose library is not built with it: what was
/// done before work was shared out comes before each piece, and each piece before what follows. Of
/// two pieces none comes first. Nothing in other builds.
class Order {
 public:
#if defined(__SANITIZE_THREAD__)
  Order() { __tsan_release(&begin_); }
  ~Order() { __tsan_acquire(&end_); }
  Order(const Order&) = delete;
  Order& operator=(const Order&) = delete;

  void begin_piece() { __tsan_acquire(&begin_); }
  void end_piece() { __tsan_release(&end_); }

 private:
  char begin_ = 0, end_ = 0;
#else
  void begin_piece() {}
  void end_piece() {}
#endif
};

/// Work that is shared out.
struct OrderedWork {
  Order& order;
  const std::function<void(std::size_t)>& work;

  /// @note Reads its members before ThreadSanitizer knows who wrote them.
  __attribute__((no_sanitize("thread"))) void operator()(std::size_t i) const {
    struct End {  // Also if the piece throws.
      Order& order;
      ~End() { order.end_piece(); }
    } const end{order};
    order.begin_piece();
    work(i);
  }
};

/// How many threads, this one included, fit into the address space that the process may use: oneTBB
/// aborts the program if it cannot start a thread.
std::size_t affordable_threads() {
  constexpr std::size_t kOfThread = std::size_t{72} << 20;  // Its stack and glibc's heap for it.
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return std::numeric_limits<std::size_t>::max();
  std::ifstream file("/proc/self/statm");
  std::size_t pages = 0;
  file >> pages;
  const std::size_t used = pages * static_cast<std::size_t>(::getpagesize());
  if (used == 0 || used >= limit.rlim_cur) return 1;
  return 1 + (limit.rlim_cur - used) / 2 / kOfThread;  // Half of the room is for the work itself.
}

/// Isolated: by default a group is bound to the one around it; cancelled from there, it returns as
/// if it had finished.
template <typename Partitioner>
void share_out(std::size_t count, const std::function<void(std::size_t)>& work,
               const Partitioner& partitioner) {
  const std::size_t most = affordable_threads();
  if (most == 1) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  std::optional<tbb::global_control> fewer;
  if (most < std::numeric_limits<int>::max())
    fewer.emplace(tbb::global_control::max_allowed_parallelism, most);
  tbb::task_group_context own(tbb::task_group_context::isolated);
  Order order;
  tbb::parallel_for(std::size_t{0}, count, OrderedWork{order, work}, partitioner, own);
  if (own.is_group_execution_cancelled())
    throw std::logic_error("work that was shared out was cancelled");
}

}  // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& work) {
  share_out(count, work, tbb::auto_partitioner());
}

void parallel_for(int jobs, std::size_t count, const std::function<void(std::size_t)>& work) {
  if (affordable_threads() == 1) {
    share_out(count, work, tbb::simple_partitioner());
    return;
  }
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(jobs));
  tbb::task_arena arena(jobs);
  arena.execute([&] { share_out(count, work, tbb::simple_partitioner()); });
}

void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second) {
  const auto either = [&](std::size_t i) { i == 0 ? first() : second(); };
  share_out(2, either, tbb::simple_partitioner());
}

void run_isolated(const std::function<void()>& work) { tbb::this_task_arena::isolate(work); }

std::string parallel_library_version() { return TBB_runtime_version(); }

}  // namespace mapproof
