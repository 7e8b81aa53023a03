// The script that makes pages interactive: built from web/ apart from the programs, and not always there.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace skein::report {

/// $SKEIN_WEB, or build/web/report.js of the tree that this was built in, or what is installed beside this program.
std::optional<std::filesystem::path> find_web_bundle();

/// Its text, fit for a <script> element; nullopt where there is none, or it cannot stand in one.
std::optional<std::string> web_bundle();

/// How a page's Content-Security-Policy names this script, and no other: "sha256-...".
std::string script_hash(std::string_view script);

/// JSON made fit for a <script type="application/json">: no text in it ends the element or begins another.
std::string script_json(std::string json);

}  // namespace skein::report
