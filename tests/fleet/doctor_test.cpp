// `skein doctor` as a user runs it: its output, its exit codes, and that the remedies that it suggests work.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "child_process.hpp"
#include "core/text/text.hpp"
#include "tests/free_domain.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

using nlohmann::json;

class Doctor : public testing::Test {
 protected:
  Doctor() {
    std::string pattern = std::filesystem::temp_directory_path() / "skein-doctor-fleet-XXXXXX";
    folder_ = ::mkdtemp(pattern.data());
  }
  ~Doctor() override { std::filesystem::remove_all(folder_); }

  struct Answer {
    int code = -1;
    std::string out, err;
    json report;  ///< output of --json

    json finding(const std::string& what) const {
      for (const json& entry : report["findings"]) {
        if (entry["what"] == what) return entry;
      }
      return json::object();
    }
    std::string verdict(const std::string& what) const { return finding(what).value("verdict", "none"); }
  };
  /// @param before  shell commands before it: "ulimit -n 60; "
  Answer ask(const std::string& words, const std::string& before = {}, const Environment& environment = {}) {
    const std::string skein = build_path("bin/skein");
    ChildProcess child({"/bin/sh", "-c", before + "exec " + shell_word(skein) + " doctor " + words}, environment,
                       folder_ / "out", folder_ / "err");
    Answer answer{.code = child.wait().code, .out = child.out(), .err = child.err(), .report = {}};
    answer.report = json::parse(answer.out, nullptr, false);
    return answer;
  }

  std::filesystem::path folder_;
};

TEST_F(Doctor, PrintsALineForEachFindingAndTheSameAsJson) {
  const Answer text = ask(""), data = ask("--json");
  ASSERT_TRUE(data.report.is_object()) << data.out << data.err;
  EXPECT_EQ(text.code, data.report["ok"] ? 0 : 1);
  const std::vector<std::string> lines = split(text.out, '\n');
  ASSERT_EQ(lines.size(), data.report["findings"].size() + 1) << "one line per finding, and an empty one at the end";
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    const json& finding = data.report["findings"][i];
    const std::string verdict = finding["verdict"], head = verdict + std::string(6 - verdict.size(), ' ');
    EXPECT_TRUE(lines[i].starts_with(head + finding["what"].get<std::string>() + ": ")) << lines[i];
    EXPECT_EQ(finding.contains("mend"), verdict != "ok") << finding;
  }
  for (const char* what : {"host", "interfaces", "loopback multicast", "domains", "ports", "open files", "processes",
                           "socket buffers", "memory", "processors", "results folder", "shared memory",
                           "monotonic clock", "time of day", "variables", "DDS libraries", "Docker"}) {
    EXPECT_NE(data.verdict(what), "none") << what;
  }
}

TEST_F(Doctor, TooFewOpenFilesFailUnlessARunMayRaiseTheLimit) {
  const Answer poor = ask("--json", "ulimit -n 60; ");
  EXPECT_EQ(poor.code, 1) << poor.err;
  ASSERT_EQ(poor.verdict("open files"), "FAIL") << poor.out;
  EXPECT_NE(poor.finding("open files")["mend"].get<std::string>().find("limits.conf"), std::string::npos) << poor.out;
  const Answer low = ask("--json", "ulimit -S -n 60; ");
  EXPECT_EQ(low.verdict("open files"), "ok") << low.out;
  EXPECT_NE(low.finding("open files")["found"].get<std::string>().find("60 per process"), std::string::npos) << low.out;
}

TEST_F(Doctor, AMissingInterfaceFailsAsItWouldInARun) {
  const Answer answer = ask("--json --network '{jurong: eth99}'");
  EXPECT_EQ(answer.code, 1) << answer.err;
  const json finding = answer.finding("network of jurong");
  EXPECT_EQ(finding.value("verdict", ""), "FAIL") << answer.out;
  EXPECT_NE(finding["found"].get<std::string>().find("--network eth99 (jurong): this host has no"), std::string::npos);
}

TEST_F(Doctor, APeerOfUnknownNameFails) {
  const Answer answer = ask("--json --network '{world: {interface: lo, peers: [127.0.0.1, no-such-host.invalid]}}'");
  EXPECT_EQ(answer.code, 1) << answer.err;
  EXPECT_EQ(answer.verdict("peer 127.0.0.1"), "ok") << answer.out;
  EXPECT_EQ(answer.verdict("peer no-such-host.invalid"), "FAIL");
}

TEST_F(Doctor, DomainsThatAnotherProcessHoldsFail) {
  const FreeDomains held(7);
  const std::string domain = "--json --domain " + std::to_string(held.base());
  const Answer answer = ask(domain);
  EXPECT_EQ(answer.code, 1) << answer.err;
  EXPECT_NE(answer.finding("domains")["found"].get<std::string>().find(std::to_string(::getpid())), std::string::npos)
      << answer.out;
  EXPECT_NE(ask("--json").verdict("domains"), "FAIL") << "without --domain, a run takes free domains";
}

TEST_F(Doctor, VariablesOfRos2CauseAWarning) {
  const Answer answer = ask("--json", "", {{"ROS_DOMAIN_ID", "3"}});
  EXPECT_EQ(answer.verdict("variables"), "warn") << answer.out;
  EXPECT_NE(answer.finding("variables")["mend"].get<std::string>().find("unset ROS_DOMAIN_ID"), std::string::npos);
}

TEST_F(Doctor, AResultsFolderThatCannotBeWrittenFails) {
  const Answer answer = ask("--json --out /proc/here");
  EXPECT_EQ(answer.code, 1) << answer.err;
  EXPECT_EQ(answer.verdict("results folder"), "FAIL") << answer.out;
}

TEST_F(Doctor, WrongInputEndsWithExitCodeTwo) {
  for (const char* words : {"--scenario nowhere", "--network '{mars: all}'", "--network nowhere.yaml", "--domain 0",
                            "--seconds 3", "net", "net --network host", "nett"}) {
    const Answer answer = ask(words);
    EXPECT_EQ(answer.code, 2) << words << '\n' << answer.out << answer.err;
    EXPECT_FALSE(answer.err.empty()) << words;
  }
}

}  // namespace
}  // namespace skein::test
