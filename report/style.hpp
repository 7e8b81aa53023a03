// How reports look: one style sheet for tables and drawings, on screens (light and dark) and on paper.
#pragma once

#include <string_view>

namespace skein::report {

/// Of all pages: colours, text, tables.
std::string_view base_style();
/// Of what is drawn, on pages and on its own. Its colours and `--font` are variables, which base_style() and
/// run_style() set; nothing else in it needs a page.
std::string_view drawing_style();
/// What the page of a run has besides.
std::string_view run_style();

}  // namespace skein::report
