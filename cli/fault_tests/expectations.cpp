#include "cli/fault_tests/expectations.hpp"

#include "core/text/text.hpp"
#include "results/diff.hpp"

namespace skein::cli {
namespace {

/// The time at which two runs first differ; nullopt if their digests do not show it.
std::optional<double> parting_time(const results::RunRecord& run, const results::RunRecord& other) try {
  const auto difference = results::first_difference(run.dir, other.dir);
  return difference ? std::optional(difference->time_s) : std::nullopt;
} catch (const InputError&) {
  return std::nullopt;  // one of them died before it wrote any
}

class Judge {
 public:
  explicit Judge(const Evidence& evidence) : evidence_(evidence) {}

  std::vector<Judgement> all(const Expectations& wanted) {
    const Json& result = evidence_.run.result;
    const std::string status = value_or(result, "status", "nothing");
    add("status", status == wanted.status, wanted.status, status, end_s());
    add("exit_code", *wanted.exit_code, evidence_.exit_code, "");
    const bool has_digest = value_or(result, "deterministic", false) && value_or(result, "digest", nullptr).is_string();
    add("deterministic", has_digest == wanted.deterministic, wanted.deterministic ? "a digest" : "no digest",
        has_digest ? "one" : "none", end_s());
    judge_faults(wanted.faults_acted);
    const Json radio = value_or(result, "radio", Json::object());
    for (const auto& [name, limits] : wanted.radio.limits) {
      add("radio." + name, limits, value_or(radio, name.c_str(), 0.0), " " + name);
    }
    judge_digests();
    return std::move(judgements_);
  }

 private:
  double end_s() const { return value_or(evidence_.run.result, "sim_time_s", 0.0); }

  void add(const std::string& key, bool holds, const std::string& expected, const std::string& seen,
           std::optional<double> at_s = {}) {
    const std::string when = !holds && at_s ? ", at " + number_text(*at_s) + " s" : "";
    judgements_.push_back({"expect." + key, holds, "expected " + expected + ", seen " + seen + when});
  }
  void add(const std::string& key, const Limits& limits, double seen, const std::string& of) {
    add(key, limits.contain(seen), limits.text() + of, number_text(seen), end_s());
  }

  void judge_faults(bool wanted) {
    const Json entries = value_or(evidence_.run.result, "faults", Json::array());
    for (std::size_t i = 0; i < evidence_.plan.faults.size(); ++i) {
      const Fault& fault = evidence_.plan.faults[i];
      const bool began = i < entries.size() && value_or(entries[i], "began_step", nullptr).is_number();
      const std::string time = fault.waits ? " when " + fault.when->text : " at " + number_text(fault.at_s) + " s";
      add("faults_acted", began == wanted,
          "that " + fault_kind(fault) + " of " + fault_target(fault) + (wanted ? " begins" : " does not begin") + time,
          "that it " + (began ? "did" : "did not; the run ended at " + number_text(end_s()) + " s"));
    }
  }

  void judge_digests() {
    const Json digest = value_or(evidence_.run.result, "digest", nullptr);
    for (const auto& [how, run] : evidence_.repeats) {
      const Json other = value_or(run->result, "digest", nullptr);
      const bool same = digest.is_string() && digest == other;
      add("same_digest", same, "the digest " + digest.dump() + " of the repetition '" + how + "' too",
          other.dump() + (same ? "" : "; compare " + evidence_.run.dir.string() + " with " + run->dir.string()),
          same ? std::nullopt : parting_time(evidence_.run, *run));
    }
  }

  const Evidence& evidence_;
  std::vector<Judgement> judgements_;
};

}  // namespace

std::vector<Judgement> judged(const Expectations& expectations, const Evidence& evidence) {
  return Judge(evidence).all(expectations);
}

}  // namespace skein::cli
