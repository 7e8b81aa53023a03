#include "doctor/finding.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <ostream>
#include <utility>

#include "process/program.hpp"

namespace skein::doctor {

const char* word_of(Verdict verdict) {
  if (verdict == Verdict::ok) return "ok";
  return verdict == Verdict::warn ? "warn" : "FAIL";
}

Finding fine(std::string what, std::string found) { return {Verdict::ok, std::move(what), std::move(found), {}}; }

Finding warning(std::string what, std::string found, std::string fix) {
  return {Verdict::warn, std::move(what), std::move(found), std::move(fix)};
}

Finding failure(std::string what, std::string found, std::string fix) {
  return {Verdict::fail, std::move(what), std::move(found), std::move(fix)};
}

int exit_code(const Findings& findings) {
  const bool fails = std::ranges::any_of(findings, [](const Finding& f) { return f.verdict == Verdict::fail; });
  return fails ? kExitCheckFailed : kExitDone;
}

void print(std::ostream& out, const Findings& findings) {
  for (const Finding& finding : findings) {
    out << fmt::format("{:<4}  {}: {}{}{}\n", word_of(finding.verdict), finding.what, finding.found,
                       finding.fix.empty() ? "" : " -> ", finding.fix);
  }
}

Json as_json(const Findings& findings) {
  Json list = Json::array();
  for (const Finding& finding : findings) {
    list.push_back({{"verdict", word_of(finding.verdict)}, {"what", finding.what}, {"found", finding.found}});
    if (!finding.fix.empty()) list.back()["mend"] = finding.fix;
  }
  return {{"ok", exit_code(findings) == kExitDone}, {"findings", list}};
}

}  // namespace skein::doctor
