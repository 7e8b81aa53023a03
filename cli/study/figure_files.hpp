// Figures of a study as files for papers: each an SVG that needs nothing else, black text on white. Pure; any thread.
#pragma once

#include <string>

#include "cli/study/drawings.hpp"

namespace skein::cli {

/// With its style in it, all colours as numbers, a common font, and its legend below. Curves differ by their dashes,
/// too, so that a copy in grey can be read.
std::string paper_svg(const StudyFigure& figure);

}  // namespace skein::cli
