// Files that show a finished run: a self-contained page of one run or of two, and a film.
#include <csignal>
#include <fstream>
#include <sstream>

#include "view_fixture.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

const Arguments kKeptFlight = {"towers", "--planner", "kios", "--duration", "60", "--one-process", "--no-report"};

class KeptRun : public ViewTest {
 protected:
  ChildProcess& replay(const Arguments& arguments, int exit_code = 0) {
    ChildProcess& command = skein(joined({"replay"}, arguments));
    EXPECT_EQ(command.wait(kBrowserPatience).code, exit_code) << command.err() << command.out();
    return command;
  }

  /// Expects a script in this folder to find no problem with a page.
  void look(const std::string& script, const Arguments& arguments) {
    if (const std::string why = no_browser(); !why.empty()) GTEST_SKIP() << why;
    look_with_browser(script, arguments);
  }
};

TEST_F(KeptRun, IsShownByAFileThatMakesNoRequests) {
  const SkeinRun& done = run("done", joined(kKeptFlight, {"--seed", "3"}));
  const fs::path file = folder() / "flight.html";
  replay({done.dir(), "--export", file});
  look("kept", {file, done.dir()});

  // A flight of 600 s with five UAVs must fit into 4 MB; this one is a tenth as long.
  const std::uintmax_t script = fs::file_size(source_path("build/web/live.js"));
  EXPECT_LT(fs::file_size(file) - script, (4'000'000 - script) / 10)
      << "the file of a flight of one minute is too large";

  const std::string before = text_of(file);
  EXPECT_NE(replay({done.dir(), "--export", file}, 2).err().find("--force"), std::string::npos);
  EXPECT_EQ(text_of(file), before);
  replay({done.dir(), "--export", file, "--force"});
  EXPECT_EQ(text_of(file), before) << "the same run must give the same file";
}

TEST_F(KeptRun, RefusesInvalidOptions) {
  const SkeinRun& done =
      run("done", {"towers", "--planner", "hover", "--duration", "5", "--one-process", "--no-oracle", "--no-report"});
  EXPECT_NE(replay({done.dir(), "--export", folder() / "flight.avi"}, 2).err().find(".mp4"), std::string::npos);
  replay({done.dir(), "--export", folder() / "nowhere/flight.html"}, 2);
  replay({done.dir(), "--export", folder() / "flight.html", "--seconds", "3"}, 2);
  replay({done.dir(), "--export", folder() / "flight.mp4", "--seconds", "3", "--speed", "2"}, 2);
  replay({done.dir(), "--seconds", "3"}, 2);
  replay({done.dir(), "--export", folder() / "flight.html", "--view", "8080"}, 2);
  replay({folder(), "--export", folder() / "flight.html"}, 2);
  fs::create_directory(folder() / "folder.html");
  replay({done.dir(), "--export", folder() / "folder.html", "--force"}, 2);
  ChildProcess& without =
      start_program("without", {program("skein"), "replay", done.dir(), "--export", folder() / "flight.mp4"},
                    {{"PATH", folder().string()}});
  EXPECT_EQ(without.wait().code, 2);
  EXPECT_NE(without.err().find("apt-get install chromium"), std::string::npos) << without.err();
  EXPECT_FALSE(fs::exists(folder() / "flight.html") || fs::exists(folder() / "flight.mp4"));
}

TEST_F(KeptRun, IsShownBesideAnotherRunOnOneClock) {
  const SkeinRun& a = run("a", joined(kKeptFlight, {"--no-oracle"}));
  const SkeinRun& b =
      run("b", {"towers", "--planner", "star", "--duration", "60", "--one-process", "--no-oracle", "--no-report"});
  const fs::path file = folder() / "pair.html", same = folder() / "same.html";
  const std::string said = replay({a.dir(), b.dir(), "--export", file}).out();
  ChildProcess& diff = skein({"diff", a.dir(), b.dir()});
  EXPECT_EQ(diff.wait().code, 1);
  std::smatch found;
  const std::string differ = diff.out();
  ASSERT_TRUE(std::regex_search(differ, found, std::regex("\\((\\S+) s\\)"))) << differ;
  EXPECT_NE(said.find("first difference at " + found[1].str()), std::string::npos) << said;
  look("pair", {file, a.dir(), b.dir(), found[1].str()});

  EXPECT_NE(replay({a.dir(), a.dir(), "--export", same}).out().find("the same, step by step"), std::string::npos);
  look("pair", {same, a.dir(), a.dir(), "same"});

  fs::copy(b.dir(), folder() / "elsewhere", fs::copy_options::recursive);
  std::istringstream rows(text_of(b.dir() / "score.csv"));
  std::ofstream moved(folder() / "elsewhere/score.csv");
  std::string row;
  for (int i = 0; std::getline(rows, row); ++i) moved << (i == 7 ? "999" + row.substr(row.find(',')) : row) << '\n';
  moved.close();
  EXPECT_NE(
      replay({a.dir(), folder() / "elsewhere", "--export", folder() / "no.html"}, 2).err().find("different scenes"),
      std::string::npos);
}

class FilmOfARun : public KeptRun {
 protected:
  void SetUp() override {
    KeptRun::SetUp();
    if (IsSkipped()) return;
    for (const char* name : {"chromium", "ffmpeg"}) {
      if (command_file(name).empty()) GTEST_SKIP() << "there is no " << name << ": apt-get install " << name;
    }
  }

  /// Number of processes whose command line names this test's folder for temporary files.
  std::size_t processes_there() const { return command_lines_with(temporary()).size(); }
  fs::path temporary() const { return folder() / "temporary"; }
};

TEST_F(FilmOfARun, IsTheSameEachTime) {
  const SkeinRun& done =
      run("done", {"towers", "--planner", "kios", "--duration", "40", "--one-process", "--no-report", "--no-oracle"});
  const Arguments how = {"--fps", "2", "--seconds", "2", "--from-address", "#uav=changi&view=camera&t=20"};
  for (const char* name : {"one.mp4", "two.mp4"}) replay(joined({done.dir(), "--export", folder() / name}, how));
  EXPECT_EQ(text_of(folder() / "one.mp4"), text_of(folder() / "two.mp4"));
  ChildProcess& pictures = start_program(
      "pictures", {command_file("ffmpeg"), "-v", "error", "-i", folder() / "one.mp4", "-f", "framemd5", "-"});
  ASSERT_EQ(pictures.wait(kBrowserPatience).code, 0) << pictures.err();
  std::istringstream lines(pictures.out());
  std::set<std::string> sums;
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#")) continue;
    ++count;
    sums.insert(line.substr(line.rfind(' ')));
  }
  EXPECT_EQ(count, 5U);
  EXPECT_GE(sums.size(), 4U) << "the pictures of the film are the same";
  EXPECT_NE(pictures.out().find("1280x720"), std::string::npos);
}

TEST_F(FilmOfARun, LeavesNoProcessBehind) {
  const SkeinRun& done =
      run("done", {"towers", "--planner", "hover", "--duration", "5", "--one-process", "--no-oracle", "--no-report"});
  fs::create_directory(temporary());
  for (const int signal : {SIGINT, SIGKILL}) {
    const fs::path film = folder() / ("film" + std::to_string(signal) + ".mp4");
    ChildProcess& command =
        start_program("film" + std::to_string(signal),
                      {program("skein"), "replay", done.dir(), "--export", film, "--seconds", "3000"},
                      {{"TMPDIR", temporary().string()}});
    ASSERT_TRUE(eventually([&] { return fs::exists(film.string() + ".part"); })) << command.err();
    EXPECT_GT(processes_there(), 1U);
    command.signal(signal);
    const ExitStatus ended = command.wait(kBrowserPatience);
    EXPECT_EQ(signal == SIGINT ? ended.code : ended.signal, signal == SIGINT ? 130 : SIGKILL);
    EXPECT_TRUE(eventually([&] { return processes_there() == 0; }));
    EXPECT_FALSE(fs::exists(film));
    if (signal == SIGINT) {
      EXPECT_TRUE(fs::is_empty(temporary()) && !fs::exists(film.string() + ".part"));
    }
  }
}

}  // namespace
}  // namespace skein::test
