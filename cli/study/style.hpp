// How the report of a study looks: one style sheet for tables and drawings, on screens (light and dark) and on paper.
#pragma once

#include <string_view>

namespace skein::cli {

std::string_view study_style();

}  // namespace skein::cli
