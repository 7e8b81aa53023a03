// What conditions cost planners: a study that flew every scene under several. Pure.
#pragma once

#include <iosfwd>

#include "cli/study/figures.hpp"

namespace skein::cli {

/// For each conditions and planner: the median share of the estimate over all scenes and seeds, that as a share of the
/// first conditions' median, collisions, and those of UAVs whose battery was empty. Markdown, as docs/conditions.md has
/// it. Nothing if the study names no conditions.
void print_conditions(std::ostream& out, const Study& study);

}  // namespace skein::cli
