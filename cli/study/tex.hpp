// The ranking, the scores and the pairs of a study as tables for LaTeX. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "cli/study/pairs.hpp"

namespace skein::cli {

/// Text as LaTeX prints it, in a table too; control characters and what is no UTF-8 become '?'.
std::string tex_escaped(const std::string& text);

/// For \input: needs the package booktabs, and UTF-8 as LaTeX has it by default.
std::string study_tex(const Study& study, const std::vector<PlannerPair>& pairs,
                      const std::vector<std::string>& titles);

}  // namespace skein::cli
