// Result of one check of `skein doctor`.   Pure; safe from any thread.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "process/json_text.hpp"

namespace skein::doctor {

enum class Verdict { ok, warn, fail };
/// "ok", "warn" or "FAIL".
const char* word_of(Verdict verdict);

struct Finding {
  Verdict verdict = Verdict::ok;
  std::string what;   ///< what was checked: "open files"
  std::string found;  ///< what was found, in one line
  std::string fix;    ///< how to fix it; empty if all is well
};
using Findings = std::vector<Finding>;

Finding fine(std::string what, std::string found);
Finding warning(std::string what, std::string found, std::string fix);
Finding failure(std::string what, std::string found, std::string fix);

/// kExitDone when nothing fails, else kExitCheckFailed.
int exit_code(const Findings& findings);

/// Prints one line per finding.
void print(std::ostream& out, const Findings& findings);
Json as_json(const Findings& findings);

}  // namespace skein::doctor
