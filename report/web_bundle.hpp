// The script that makes pages interactive: built from web/ apart from the programs, and not always there.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace skein::report {

/// Of report.html, and of the page that follows a run (view/).
inline constexpr std::string_view kReportScript = "report.js", kLiveScript = "live.js";

/// The file of a script: $SKEIN_WEB for the report's and beside it for others, or below build/web/ of the tree that
/// this was built in, or what is installed beside this program.
std::optional<std::filesystem::path> find_web_bundle(std::string_view name = kReportScript);

/// Its text, fit for a <script> element; nullopt where there is none, or it cannot stand in one.
std::optional<std::string> web_bundle(std::string_view name = kReportScript);

/// How a page's Content-Security-Policy names this script, and no other: "sha256-...".
std::string script_hash(std::string_view script);

/// JSON made fit for a <script type="application/json">: no text in it ends the element or begins another.
std::string script_json(std::string json);

}  // namespace skein::report
