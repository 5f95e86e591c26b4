#include "reports/diff/shared_causes.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace mapproof {

std::vector<SharedCause> shared_causes(const std::vector<DiffItem>& items) {
  constexpr std::size_t kFewest = 3;
  std::vector<SharedCause> causes;
  std::map<std::pair<Verdict, std::string>, std::size_t> known;
  for (const DiffItem& item : items) {
    const Judgement& judgement = item.judgement;
    if (judgement.shared_cause.empty()) continue;
    const auto [at, is_new] =
        known.try_emplace({judgement.verdict, judgement.shared_cause}, causes.size());
    if (is_new) causes.push_back({judgement.shared_cause, judgement.verdict, {}});
    causes[at->second].ids.push_back(item.id);
  }
  std::erase_if(causes, [](const SharedCause& cause) { return cause.ids.size() < kFewest; });
  return causes;
}

const SharedCause* shared_cause_of(const DiffResult& result, const DiffItem& item) {
  const auto found = std::ranges::find_if(result.shared, [&](const SharedCause& shared) {
    return shared.verdict == item.judgement.verdict && shared.cause == item.judgement.shared_cause;
  });
  return found == result.shared.end() ? nullptr : &*found;
}

}  // namespace mapproof
