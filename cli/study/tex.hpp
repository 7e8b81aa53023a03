// The ranking, the scores and the pairs of a study as tables for LaTeX. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "cli/study/pairs.hpp"

namespace skein::cli {

/// Escapes a text for LaTeX, also in a table. Line feeds and tabs become spaces, other control
/// characters and invalid UTF-8 become '?'.
std::string tex_escaped(const std::string& text);

/// A file for \input. It needs the package booktabs, and UTF-8 as LaTeX's input encoding (the default).
std::string study_tex(const Study& study, const std::vector<PlannerPair>& pairs,
                      const std::vector<std::string>& titles);

}  // namespace skein::cli
