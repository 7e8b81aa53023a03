// A hunt and related commands as a user runs them: output files, Ctrl-C, a user's own programs (`exec:`), a repeated
// capsule, folders of other files, and `skein blame`.
#include <csignal>
#include <fstream>
#include <pugixml.hpp>
#include <regex>
#include <sstream>

#include "fleet_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

class HuntCommands : public FleetTest {
 protected:
  struct Said {
    int code = -1;
    std::string out, err;
  };

  Said call(const Arguments& words) {
    ChildProcess& child = skein(words);
    return {child.wait().code, child.out(), child.err()};
  }
  static Arguments planted(const std::string& defect) {
    return {"--planner", defect.empty() ? "planted" : "planted:defect=" + defect, "--agent",
            helper_program("planted_agent")};
  }

  /// The lines of a hunt's log, parsed.
  std::vector<Json> log(const std::string& out) const {
    const std::string text = text_of(folder() / out / "log.jsonl");
    EXPECT_TRUE(text.empty() || text.back() == '\n') << "the last line of the log is incomplete";
    std::vector<Json> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
      lines.push_back(Json::parse(line, nullptr, false));
      EXPECT_TRUE(lines.back().is_object()) << line;
    }
    return lines;
  }
  /// The same lines without their order, which depends on the order in which flights ended.
  std::set<std::string> log_lines(const std::string& out) const {
    std::set<std::string> texts;
    for (const Json& line : log(out)) texts.insert(line.dump());
    return texts;
  }
};

struct Counts {
  std::size_t held = 0, failed = 0, vacuous = 0;
  bool operator==(const Counts&) const = default;
};
using CountsByProperty = std::map<std::string, Counts>;

CountsByProperty counts_of_log(const std::vector<Json>& lines) {
  CountsByProperty counts;
  for (const Json& line : lines) {
    for (const Json& finding : line["outcome"]["findings"]) {
      Counts& of = counts[finding["property"]];
      const std::string outcome = finding["outcome"];
      ++(outcome == "holds" ? of.held : outcome == "fails" ? of.failed : of.vacuous);
    }
  }
  return counts;
}

CountsByProperty counts_of_junit(const fs::path& file) {
  pugi::xml_document xml;
  EXPECT_TRUE(xml.load_file(file.c_str()));
  static const std::regex numbers(R"(held in (\d+) runs, vacuous in (\d+), failed in (\d+))");
  CountsByProperty counts;
  std::size_t failures = 0;
  const pugi::xml_node suite = xml.child("testsuites").child("testsuite");
  for (const pugi::xml_node one : suite.children("testcase")) {
    const std::string text = one.child("system-out").text().get();
    std::smatch match;
    if (!std::regex_search(text, match, numbers)) ADD_FAILURE() << text;
    counts[one.attribute("name").value()] = {std::stoul(match[1]), std::stoul(match[3]), std::stoul(match[2])};
    EXPECT_EQ(one.child("failure") != nullptr, match[3] != "0") << text;
    failures += one.child("failure") != nullptr;
  }
  EXPECT_EQ(suite.attribute("tests").as_uint(), counts.size());
  EXPECT_EQ(suite.attribute("failures").as_uint(), failures);
  return counts;
}

/// The counts in the page's table of properties.
CountsByProperty counts_of_page(const std::string& html) {
  static const std::regex row(R"(<t[dh][^>]*>(\w+)(?: \(vacuous\))?</t[dh]><td[^>]*>(\d+)</td><td[^>]*>(\d+)</td>)"
                              R"(<td[^>]*>(\d+)</td>)");
  const std::size_t begin = html.find("<section id=\"properties\">");
  const std::string section = html.substr(begin, html.find("</section>", begin) - begin);
  CountsByProperty counts;
  for (std::sregex_iterator at(section.begin(), section.end(), row), end; at != end; ++at) {
    counts[(*at)[1]] = {std::stoul((*at)[2]), std::stoul((*at)[3]), std::stoul((*at)[4])};
  }
  return counts;
}

std::string tell(const CountsByProperty& counts) {
  std::ostringstream text;
  for (const auto& [name, of] : counts) {
    text << name << ": " << of.held << " held, " << of.failed << " failed, " << of.vacuous << " vacuous\n";
  }
  return text.str();
}

TEST_F(HuntCommands, PageAndJUnitCountWhatTheLogSaysAndTheCapsuleFliesTheFindAgain) {
  const fs::path properties = write("properties.yaml",
                                    "name: few\nproperties:\n  all_fly_on: {meanwhile: 30 m}\n"
                                    "  restarted_works: ready\n  no_collision: ready\n");
  const Said hunt = call(joined({"hunt",         "towers",
                                 "--uavs",       "2",
                                 "--duration",   "60",
                                 "--faults",     "kill",
                                 "--properties", properties,
                                 "--runs",       "5",
                                 "--seed",       "2",
                                 "--shrink",     "1",
                                 "--out",        folder() / "hunt",
                                 "--junit",      folder() / "hunt.xml"},
                                planted("no_boxes_again")));
  ASSERT_EQ(hunt.code, 1) << hunt.out << hunt.err;
  const CountsByProperty counts = counts_of_log(log("hunt"));
  EXPECT_EQ(counts.size(), 4u) << tell(counts);
  EXPECT_GT(counts.at("all_fly_on").failed, 0u) << tell(counts);
  EXPECT_EQ(tell(counts_of_junit(folder() / "hunt.xml")), tell(counts));
  EXPECT_EQ(tell(counts_of_page(text_of(folder() / "hunt" / "report.html"))), tell(counts));

  std::smatch find;
  const std::regex named(R"(FIND (all_fly_on-\d+): )");
  ASSERT_TRUE(std::regex_search(hunt.out, find, named)) << hunt.out;
  const fs::path capsule = folder() / "hunt" / "finds" / (find[1].str() + ".yaml");
  std::smatch digest;
  const std::string text = text_of(capsule);
  ASSERT_TRUE(std::regex_search(text, digest, std::regex("digest: '?([0-9a-f]{64})"))) << text;

  const Said again = call({"run", capsule, "--agent", helper_program("planted_agent"), "--out", folder() / "again"});
  EXPECT_EQ(again.code, 1) << again.out << again.err;
  const Json result = Json::parse(text_of(folder() / "again" / "result.json"));
  EXPECT_EQ(result["digest"], digest[1].str());
  EXPECT_FALSE(result["faults"].empty());
  EXPECT_NE(again.out.find("all_fly_on fails: "), std::string::npos) << again.out;
  EXPECT_NE(again.out.find("this is the run that was found, bit for bit"), std::string::npos) << again.out;
  EXPECT_NE(again.err.find("second run, without the faults"), std::string::npos) << again.err;
  // There is one table, that of the run with faults.
  std::vector<std::string> tables;
  const std::regex table(R"((?:^|\n)score +([0-9.]+) of )");
  for (std::sregex_iterator at(again.out.begin(), again.out.end(), table), end; at != end; ++at) {
    tables.push_back((*at)[1]);
  }
  ASSERT_EQ(tables.size(), 1u) << again.out;
  EXPECT_NEAR(std::stod(tables[0]), result["score"].get<double>(), 0.0005);
  EXPECT_NE(again.out.find("this run, with its faults: score " + tables[0] + ", results in "), std::string::npos)
      << again.out;
}

TEST_F(HuntCommands, ReportWithoutAFolderIsRefusedBeforeTheSearch) {
  const Said hunt =
      call({"hunt", "towers", "--uavs", "1", "--out", folder() / "hunt", "--junit", folder() / "none" / "hunt.xml"});
  EXPECT_EQ(hunt.code, 2) << hunt.out;
  EXPECT_NE(hunt.err.find("there is no folder " + (folder() / "none").string()), std::string::npos) << hunt.err;
  EXPECT_TRUE(log("hunt").empty());
}

TEST_F(HuntCommands, CtrlCLeavesAWholeLogAndTheSameCommandContinues) {
  const auto words = [&](const std::string& out, std::size_t runs) {
    return Arguments{"hunt",       "towers",
                     "--planner",  "hover",
                     "--uavs",     "2",
                     "--duration", "50",
                     "--faults",   "kill,link,blackout",
                     "--without",  "explorers_fly_on,others_fly_on,linked_delivers",
                     "--runs",     std::to_string(runs),
                     "--jobs",     "2",
                     "--out",      folder() / out};
  };
  ChildProcess& stopped = start_program("stopped", joined({program("skein")}, words("stopped", 100'000)));
  const auto lines = [&] {
    const std::string text = text_of(folder() / "stopped" / "log.jsonl");
    return std::ranges::count(text, '\n');
  };
  ASSERT_TRUE(eventually([&] { return lines() >= 3 || stopped.ended(); })) << stopped.err();
  stopped.signal(SIGINT);
  const ExitStatus exit = stopped.wait();
  EXPECT_EQ(exit.code, 130) << stopped.err();
  EXPECT_EQ(exit.signal, 0);
  const std::string below = folder().string() + "/";
  EXPECT_TRUE(eventually([&] { return command_lines_with(below).empty(); }))
      << testing::PrintToString(command_lines_with(below));
  const std::size_t flown = log("stopped").size();
  EXPECT_GE(flown, 3u);
  EXPECT_NE(stopped.out().find(" runs, "), std::string::npos)
      << "the hunt does not report what it has flown: " << stopped.out();
  EXPECT_TRUE(fs::exists(folder() / "stopped" / "report.html"));

  const Said whole = call(words("whole", flown + 2)), on = call(words("stopped", flown + 2));
  EXPECT_EQ(on.code, whole.code) << on.err;
  EXPECT_NE(on.err.find(std::to_string(flown) + " of " + std::to_string(flown + 2) + " runs are complete already"),
            std::string::npos)
      << on.err;
  EXPECT_EQ(log_lines("stopped"), log_lines("whole"));
}

TEST_F(HuntCommands, AUsersProgramIsHuntedOverDds) {
  const Said hunt =
      call({"hunt",     "towers",    "--planner",  "hover,raffles=exec:" + helper_program("minimal_client"),
            "--uavs",   "2",         "--duration", "50",
            "--faults", "kill,link", "--without",  "explorers_fly_on,others_fly_on,linked_delivers",
            "--runs",   "3",         "--seed",     "5",
            "--shrink", "1",         "--out",      folder() / "hunt"});
  ASSERT_EQ(hunt.code, 0) << hunt.out << hunt.err;
  ASSERT_FALSE(Json::parse(text_of(folder() / "hunt" / "hunt.json"))["one_process"].get<bool>());
  const std::vector<Json> lines = log("hunt");
  ASSERT_EQ(lines.size(), 3u);
  std::size_t with_faults = 0;
  for (const Json& line : lines) {
    ASSERT_FALSE(line["outcome"]["findings"].empty()) << line;
    const Json& completes = line["outcome"]["findings"][0];
    EXPECT_EQ(completes["property"], "completes");
    EXPECT_EQ(completes["outcome"], "holds") << completes;
    with_faults += line["flown"].get<std::string>().find("faults: []") == std::string::npos;
  }
  EXPECT_EQ(with_faults, 2u) << "all three cases but the first have faults";
  // `skein run` flies the same run.
  const std::string flown = lines[1]["flown"];
  std::smatch seed;
  ASSERT_TRUE(std::regex_search(flown, seed, std::regex(R"(^seed: (\d+)\n)"))) << flown;
  SkeinRun& same = run("same", {"towers", "--planner", "hover,raffles=exec:" + helper_program("minimal_client"),
                                "--uavs", "2", "--duration", "50", "--seed", seed[1], "--faults",
                                write("faults.yaml", flown.substr(flown.find('\n') + 1))});
  EXPECT_EQ(same.digest(), lines[1]["outcome"]["digest"].get<std::string>());
}

// ---- folders ----------------------------------------------------------------------------------------------------

TEST_F(HuntCommands, BlameAndCheckPlannerRefuseAFolderThatIsNotEmpty) {
  const std::string capsule = source_path("config/faults/found/patrol_restart_in_its_climb.yaml");
  const fs::path mine = folder() / "mine/as-it-was/mine";
  fs::create_directories(mine.parent_path());
  std::ofstream(mine) << "mine";
  for (const Arguments& command : {Arguments{"blame", capsule}, Arguments{"check-planner", "hover"}}) {
    const Said said = call(joined(command, {"--out", folder() / "mine"}));
    EXPECT_EQ(said.code, 2) << said.err;
    EXPECT_NE(said.err.find("'as-it-was' exists already; choose another --out"), std::string::npos) << said.err;
    EXPECT_EQ(text_of(mine), "mine");
  }
}

// ---- blame ------------------------------------------------------------------------------------------------------

/// The output of `skein blame` about one fault.
struct Blamed {
  double points = 0.0;
  std::optional<double> seconds;
  std::size_t step = 0;
};

std::map<std::string, Blamed> blamed(const std::string& said) {
  static const std::regex entry(
      R"(([+-][0-9.]+) points(?:, ([+-][0-9.]+) s)?  without (.*)\n +the runs first differ at step (\d+) )");
  std::map<std::string, Blamed> all;
  for (std::sregex_iterator at(said.begin(), said.end(), entry), end; at != end; ++at) {
    Blamed& one = all[(*at)[3]];
    one.points = std::stod((*at)[1]);
    if ((*at)[2].matched) one.seconds = std::stod((*at)[2]);
    one.step = std::stoul((*at)[4]);
  }
  return all;
}

/// Time at which a run reached this score [s]; -1: never.
double time_of_score(const fs::path& dir, double score) {
  for (const auto& row : read_csv(dir / "score_timeline.csv")) {
    if (std::stod(row.at("score")) >= score - 1e-6) return std::stod(row.at("time_s"));
  }
  return -1.0;
}

/// The first step whose digests differ.
std::size_t first_other_step(const fs::path& a, const fs::path& b) {
  const auto rows = read_csv(a / "digests.csv"), others = read_csv(b / "digests.csv");
  const auto at = std::ranges::mismatch(rows, others);
  return at.in1 == rows.end() ? 0 : std::stoul(at.in1->at("k"));
}

TEST_F(HuntCommands, BlameReportsTheNumbersOfTheSameFlightsFlownIndividually) {
  const std::vector<std::string> faults = {"{at_s: 4.6, until_s: 5.9, kill: raffles}",
                                           "{at_s: 20, until_s: 40, stuck_gimbal: jurong}",
                                           "{at_s: 2, until_s: 2.5, camera_failure: raffles}"};
  const auto fly = [&](const std::string& name, std::optional<std::size_t> without) -> SkeinRun& {
    std::string text = "faults:\n";
    for (std::size_t i = 0; i < faults.size(); ++i) {
      if (i != without) text += "  - " + faults[i] + "\n";
    }
    return run(name, joined({"towers", "--uavs", "2", "--duration", "60", "--seed", "0", "--one-process", "--faults",
                             write(name + ".yaml", text)},
                            planted("no_boxes_again")));
  };
  SkeinRun& with = fly("with", std::nullopt);
  const double score = with.result()["score"];
  const Said said =
      call({"blame", with.dir(), "--agent", helper_program("planted_agent"), "--out", folder() / "blame"});
  ASSERT_EQ(said.code, 0) << said.err;
  std::smatch as_it_was;
  ASSERT_TRUE(std::regex_search(said.out, as_it_was, std::regex(R"(^the run as it was flown: score ([0-9.]+)\n)")))
      << said.out;
  EXPECT_NEAR(std::stod(as_it_was[1]), score, 0.0005);
  const std::map<std::string, Blamed> all = blamed(said.out);
  const std::string same =
      said.out.substr(std::min(said.out.size(), said.out.find("the run stays the same, bit for bit")));
  std::size_t effective_faults = 0;
  for (std::size_t i = 0; i < faults.size(); ++i) {
    SkeinRun& less = fly("without-" + std::to_string(i), i);
    if (less.digest() == with.digest()) {
      EXPECT_NE(same.find(faults[i]), std::string::npos) << said.out;
      continue;
    }
    ++effective_faults;
    ASSERT_TRUE(all.contains(faults[i])) << faults[i] << "\n" << said.out;
    const Blamed& one = all.at(faults[i]);
    const double score_less = less.result()["score"], reached = std::min(score, score_less);
    EXPECT_NEAR(one.points, score_less - score, 0.0011) << faults[i];
    ASSERT_TRUE(one.seconds) << said.out;
    EXPECT_NEAR(*one.seconds, time_of_score(with.dir(), reached) - time_of_score(less.dir(), reached), 0.0051);
    EXPECT_EQ(one.step, first_other_step(with.dir(), less.dir())) << faults[i];
  }
  EXPECT_EQ(all.size(), effective_faults) << said.out;
  EXPECT_GE(effective_faults, 1u);
  EXPECT_GT(all.at(faults[0]).points, 1.0) << "the restart, which reveals the defect, must cost points";
}

TEST_F(HuntCommands, BlameFliesInAGeneratedWorld) {
  const std::string fault = "{at_s: 5, until_s: 16, camera_failure: uav0003}";
  SkeinRun& with = run("district", {"district", "--uavs", "3", "--duration", "16", "--one-process", "--faults",
                                    write("district.yaml", "faults:\n  - " + fault + "\n")});
  const Said said = call({"blame", with.dir(), "--out", folder() / "blame"});
  ASSERT_EQ(said.code, 0) << said.err;
  EXPECT_EQ(said.out.find("could not be flown"), std::string::npos) << said.out;
  EXPECT_EQ(read_csv(folder() / "blame/as-it-was/digests.csv"), read_csv(with.dir() / "digests.csv"));
  EXPECT_TRUE(blamed(said.out).contains(fault)) << said.out;
}

}  // namespace
}  // namespace skein::test
