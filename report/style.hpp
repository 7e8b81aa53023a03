// Style sheets (CSS) of reports: tables and drawings, on screens (light and dark) and on paper.
#pragma once

#include <string_view>

namespace skein::report {

/// For all pages: colours, text, tables.
std::string_view base_style();
/// For drawings, on a page or in a file of their own. It needs the variables for colours and `--font`, which
/// base_style() and run_style() set, and nothing else of a page.
std::string_view drawing_style();
/// In addition, for the page of a run.
std::string_view run_style();

}  // namespace skein::report
