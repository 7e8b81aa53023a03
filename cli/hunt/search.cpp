#include "cli/hunt/search.hpp"

#include <algorithm>
#include <iterator>

#include "cli/hunt/draws.hpp"

namespace skein::cli {
namespace {

constexpr double kShareOfNew = 0.4;         ///< of cases that are drawn afresh
constexpr double kShareOfNearest = 0.5;     ///< of the others: variations of a case with a small margin
constexpr double kShareOfOtherSeeds = 0.2;  ///< of variations: other seed and conditions than the original

}  // namespace

bool HuntSearch::may_go_on(const std::vector<std::optional<TrialOutcome>>& before) const {
  const std::size_t needed = cases_.size() < lag_ ? 0 : cases_.size() - lag_ + 1;
  for (std::size_t i = learnt_; i < needed; ++i) {
    if (i >= before.size() || !before[i]) return false;
  }
  return true;
}

const HuntCase& HuntSearch::next(const std::vector<std::optional<TrialOutcome>>& before) {
  const std::size_t index = cases_.size(), known = index < lag_ ? 0 : index - lag_ + 1;
  for (; learnt_ < known; ++learnt_) learn(learnt_, *before[learnt_]);
  RandomStream draw(seed_, "hunt", index);
  HuntCase made;
  made.seed = 1 + below(draw, kRunSeeds);
  if (!conditions_.empty()) made.conditions = conditions_[index == 0 ? 0 : below(draw, conditions_.size())];
  if (index == 0) return cases_.emplace_back(std::move(made));
  if (discoverers_.empty() || draw.uniform() < kShareOfNew) {
    made.faults = maker_.under(made.conditions).schedule(draw);
  } else {
    const HuntCase& like = parent(draw);
    if (draw.uniform() >= kShareOfOtherSeeds) {
      made.seed = like.seed;
      made.conditions = like.conditions;
    }
    made.faults = maker_.under(made.conditions).varied(like.faults, parent(draw).faults, draw);
  }
  return cases_.emplace_back(std::move(made));
}

const HuntCase& HuntSearch::parent(RandomStream& draw) const {
  if (!nearest_.empty() && draw.uniform() < kShareOfNearest) {
    return cases_[std::next(nearest_.begin(), static_cast<std::ptrdiff_t>(below(draw, nearest_.size())))->second.index];
  }
  // Prefers later discoverers, since many cases have met the states of the first ones since.
  const std::size_t late = std::max(below(draw, discoverers_.size()), below(draw, discoverers_.size()));
  return cases_[discoverers_[late]];
}

void HuntSearch::learn(std::size_t index, const TrialOutcome& outcome) {
  bool is_new = false;
  for (const std::uint64_t state : outcome.states) is_new = states_.insert(state).second || is_new;
  if (is_new) discoverers_.push_back(index);
  for (const TrialFinding& finding : outcome.findings) {
    // Failures are known already. The search goes on from cases that hold with a small margin.
    if (finding.fails() || !finding.margin) continue;
    const auto [nearest, first] = nearest_.try_emplace(finding.property, Nearest{*finding.margin, index});
    if (!first && *finding.margin < nearest->second.margin) nearest->second = {*finding.margin, index};
  }
}

}  // namespace skein::cli
