#include "results/score_steps.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace skein::results {

std::vector<ScoreRow> score_steps(const std::vector<CaptureRow>& captures, double least_q, Counts counts) {
  std::vector<std::pair<double, const CaptureRow*>> rows;
  for (const CaptureRow& row : captures) {
    const auto time_s = counts == Counts::when_taken ? std::optional(row.time_s) : row.delivered_at_s;
    if (time_s && !row.voided() && row.q >= least_q) rows.emplace_back(*time_s, &row);
  }
  std::ranges::stable_sort(rows, {}, [](const auto& row) { return row.first; });
  std::map<std::size_t, double> best;
  std::vector<ScoreRow> steps = {{0.0, 0.0, 0.0}};
  for (const auto& [time_s, row] : rows) {
    double& q = best[row->point];
    if (row->q <= q) continue;
    const ScoreRow now{time_s, steps.back().score + (row->q - q), static_cast<double>(best.size())};
    q = row->q;
    if (steps.back().time_s == time_s) steps.pop_back();
    steps.push_back(now);
  }
  return steps;
}

}  // namespace skein::results
