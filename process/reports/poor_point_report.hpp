// Interest points in the report of sim_server that no picture counts for (reports.hpp).
#pragma once

#include "process/reports/report_types.hpp"

namespace skein {

/// A point that was only in pictures too poor to count, with the qualities of the best of them.
struct PoorPointReport {
  Count index = {};
  Number q = {}, q_blur = {}, q_distance = {}, q_res = {};
};
void describe(auto& f, PoorPointReport& point) {
  f.field("index", point.index);
  f.field("q", point.q);
  f.field("q_blur", point.q_blur);
  f.field("q_distance", point.q_distance);
  f.field("q_res", point.q_res);
}

}  // namespace skein
