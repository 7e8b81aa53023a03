// The scripts that make pages interactive. They are built from web/ separately from the programs, and may be missing.
// Any thread, as long as no thread changes the environment.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace skein::report {

/// Scripts of report.html, and of the live page of a run (view/).
inline constexpr std::string_view kReportScript = "report.js", kLiveScript = "live.js";

/// The file of a script. If $SKEIN_WEB is set, it names the report's script, and other scripts lie beside it.
/// Otherwise: in build/web/ of the source tree, else in share/skein/web/ of the installation. nullopt: not found.
std::optional<std::filesystem::path> find_web_bundle(std::string_view name = kReportScript);

/// The text of a script, for a <script> element. nullopt if there is no script, it is larger than 3 MiB, or it contains
/// text that would end the element.
std::optional<std::string> web_bundle(std::string_view name = kReportScript);

/// The hash by which a page's Content-Security-Policy allows this script and no other: "sha256-...".
std::string script_hash(std::string_view script);

/// Content-Security-Policy of a page that is a file: it loads nothing, and runs no script except this one.
std::string policy_of_file(const std::optional<std::string>& script);

/// Escapes JSON for a <script type="application/json">, so that no text in it ends the element or begins another.
std::string script_json(std::string json);

}  // namespace skein::report
