// Report of an agent about a part of its work.
#pragma once

#include "process/reports/report_types.hpp"

namespace skein {

/// A named part of an agent's work, without the parts that are timed within it (uav_agent/api/work_parts.hpp).
struct WorkPartReport {
  Number cpu_s = {};
  Text part = {};
};
void describe(auto& f, WorkPartReport& part) {
  f.field("cpu_s", part.cpu_s);
  f.field("part", part.part);
}

}  // namespace skein
