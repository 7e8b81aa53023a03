// Figures of a study as files for papers: self-contained SVG, black text on white. Pure; any thread.
#pragma once

#include <string>

#include "cli/study/drawings.hpp"

namespace skein::cli {

/// The SVG includes its style sheet, with numeric colours and a common font, and a legend below the drawing. Curves
/// also differ in their dashes, so that a grey copy is readable.
std::string paper_svg(const StudyFigure& figure);

}  // namespace skein::cli
