// The crew with simple programs ("toys"), on one thread and on several: in one process, each program behaves as in a
// process of its own.
#include "one_process/crew.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <latch>
#include <map>
#include <mutex>
#include <set>
#include <sstream>

#include "bus/lockstep/self_signal.hpp"
#include "one_process/death_notice.hpp"
#include "one_process/program_output.hpp"
#include "one_process/shared_turn.hpp"
#include "process/host/thread_cpu.hpp"

namespace skein::one_process {
namespace {

/// Records how each toy of a test ended. The toys write on any thread.
struct Diary {
  std::mutex mutex;
  std::map<std::string, int> turns;
  std::set<std::string> destroyed, ended;
  std::map<std::string, double> cpu_s;
};
Diary* diary = nullptr;
/// Programs whose turns run in parallel wait here for each other.
std::latch* meeting = nullptr;

/// Does what its option --do says, in its third turn.
class Toy final : public bus::FleetMember, public bus::LockstepNode {
 public:
  Toy(std::string name, std::string what)
      : name_(std::move(name)), what_(std::move(what)), bus_(bus::make_bus({.vendor = "inproc"})) {}
  ~Toy() override {
    const std::scoped_lock lock(diary->mutex);
    diary->destroyed.insert(name_);
  }

  bus::LockstepNode& node() override { return *this; }
  bus::Bus& bus() override { return *bus_; }
  std::optional<int> ended(bus::NodeEnd end) override {
    {
      const std::scoped_lock lock(diary->mutex);
      diary->ended.insert(name_);
    }
    if (end != bus::NodeEnd::resumed) return end == bus::NodeEnd::finished ? 0 : 7;
    end_.reset();
    return std::nullopt;
  }

  bool flies_beside() const override { return name_ != "solo" && name_ != "sim_server"; }

  void start() override {
    participant_ = bus_->join(5);
    writer_ = participant_->create_writer({"hello", "text", {}});
  }
  void turn(bool) override {
    const int turn = note_turn();
    std::printf("%s prints\n", name_.c_str());
    spdlog::info("{} logs", name_);
    std::cerr << name_ << " complains\n";
    if (turn != 3) return;
    if (what_ == "meets") meeting->arrive_and_wait();
    if (what_ == "ends") end_ = bus::NodeEnd::finished;
    if (what_ == "throws") throw std::runtime_error("enough");
    if (what_ == "dies") bus::kill_ourselves();
    if (what_ == "stops") {
      bus::stop_ourselves();
      ADD_FAILURE() << "the program went on after it had stopped itself";
    }
    if (what_ == "works") {
      for (const double until_s = thread_cpu_s() + 0.01; thread_cpu_s() < until_s;) {
      }
    }
  }
  std::optional<bus::NodeEnd> end() const override { return end_; }
  bus::Inbox& inbox() override { return inbox_; }
  Rest rest() override { return {.until_rung = false}; }

 private:
  int note_turn() {
    const std::scoped_lock lock(diary->mutex);
    diary->cpu_s[name_] = thread_cpu_s();
    return ++diary->turns[name_];
  }

  const std::string name_, what_;
  bus::Inbox inbox_;
  const std::unique_ptr<bus::Bus> bus_;
  std::unique_ptr<bus::Participant> participant_;
  std::unique_ptr<bus::Writer> writer_;
  std::optional<bus::NodeEnd> end_;
};

class ToyProgram final : public bus::FleetProgram {
 public:
  explicit ToyProgram(std::string name) : name_(std::move(name)) {}
  const char* name() const override { return name_.c_str(); }
  void add_options(CLI::App& app) override { app.add_option("--do", what_); }
  std::variant<int, std::unique_ptr<bus::FleetMember>> prepare(const ProgramOptions& options, StatusPipe&) override {
    if (options.check_only) return 9;
    if (what_ == "refuses") throw InputError("no such thing");
    if (what_ == "dies early") bus::kill_ourselves();
    if (what_ == "stops early") bus::stop_ourselves();
    return std::make_unique<Toy>(name_, what_);
  }

 private:
  const std::string name_;
  std::string what_;
};

/// The parameter is the number of threads.
class CrewTest : public testing::TestWithParam<int> {
 protected:
  CrewTest() : stdout_(::dup(STDOUT_FILENO)), stderr_(::dup(STDERR_FILENO)), workers_(GetParam()) {
    diary = &diary_;
    if (GetParam() > 1) {
      [[maybe_unused]] static const bool led = [] {
        ProgramOutput::lead_by_thread(std::cout);
        return true;
      }();
    }
    std::string pattern = (std::filesystem::temp_directory_path() / "skein-crew-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    EXPECT_EQ(::pipe2(pipe_, O_NONBLOCK), 0);
    status_.emplace(pipe_[1]);
    crew_.emplace(
        *status_, [](const std::string& name) { return std::make_unique<ToyProgram>(name); }, nullptr, -1,
        GetParam() > 1 ? &workers_ : nullptr);
  }
  ~CrewTest() override {
    crew_.reset();
    std::fflush(stdout);
    ::dup2(stdout_, STDOUT_FILENO);
    ::dup2(stderr_, STDERR_FILENO);
    for (const int fd : {stdout_, stderr_, pipe_[0], pipe_[1]}) ::close(fd);
    std::filesystem::remove_all(folder_);
  }

  void start(const std::string& name, const std::string& what, const std::vector<std::string>& more = {}) {
    shared_lines::Start order{name, {name, "--do", what}, (folder_ / (name + ".log")).string(), false};
    order.argv.insert(order.argv.end(), more.begin(), more.end());
    crew_->obey(order);
  }
  void rounds(int count) {
    for (int i = 0; i < count; ++i) crew_->round();
  }
  std::string log(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / (name + ".log")).rdbuf();
    return text.str();
  }
  /// The ends that were reported to the launcher, by program.
  std::map<std::string, shared_lines::Ended> ends() {
    std::string text(1 << 16, '\0');
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(::read(pipe_[0], text.data(), text.size()), 0)));
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      const auto news = shared_lines::read_news(line);
      if (news && std::holds_alternative<shared_lines::Ended>(*news)) {
        ends_[std::get<shared_lines::Ended>(*news).program] = std::get<shared_lines::Ended>(*news);
      }
      if (news && std::holds_alternative<shared_lines::Stopped>(*news))
        stopped_.insert(std::get<shared_lines::Stopped>(*news).program);
    }
    return ends_;
  }

  Diary diary_;
  std::filesystem::path folder_;
  int pipe_[2] = {-1, -1};
  const int stdout_, stderr_;
  Workers workers_;
  std::optional<StatusPipe> status_;
  std::optional<Crew> crew_;
  std::map<std::string, shared_lines::Ended> ends_;
  std::set<std::string> stopped_;
};

INSTANTIATE_TEST_SUITE_P(Threads, CrewTest, testing::Values(1, 2, 16));

TEST_P(CrewTest, EveryEndIsReportedAndTheOthersGoOn) {
  for (const char* what : {"ends", "throws", "dies", "stays"}) start(what, what);
  start("checks", "stays", {"--check"});
  start("refuses", "refuses");
  start("mistypes", "stays", {"--nonsense"});
  rounds(6);
  auto told = ends();
  EXPECT_EQ(told.size(), 6U);
  EXPECT_EQ(told["ends"].code, 0);
  EXPECT_EQ(told["throws"].code, kExitProcessFailed);
  EXPECT_EQ(told["dies"].signal, SIGKILL);
  EXPECT_EQ(told["checks"].code, 9);
  EXPECT_EQ(told["refuses"].code, kExitBadInput);
  EXPECT_EQ(told["mistypes"].code, kExitBadInput);
  for (const auto& [program, end] : told) EXPECT_FALSE(end.fatal) << program;
  EXPECT_EQ(diary_.turns["stays"], 6);
  EXPECT_EQ(diary_.turns["ends"], 3);
  EXPECT_FALSE(crew_->empty());
  EXPECT_NE(log("throws").find("throws: failed: enough"), std::string::npos) << log("throws");
  EXPECT_NE(log("refuses").find("no such thing"), std::string::npos);
}

TEST_P(CrewTest, AKilledProgramEndsWithoutAMessage) {
  start("dies", "dies");
  start("stays", "stays");
  const auto outside = bus::make_bus({.vendor = "inproc"})->join(5);
  const auto reader = outside->create_reader({"hello", "text", {}}, [](bus::Sample&&) {});
  rounds(1);
  EXPECT_EQ(reader->matched().size(), 2U);
  rounds(3);
  EXPECT_EQ(reader->matched().size(), 1U) << "the killed program has no endpoints any more";
  EXPECT_FALSE(diary_.destroyed.contains("dies"));
  EXPECT_FALSE(diary_.ended.contains("dies"));
  crew_->obey(shared_lines::Signal{"stays", SIGKILL});
  EXPECT_EQ(reader->matched().size(), 0U);
  rounds(1);
  EXPECT_FALSE(diary_.destroyed.contains("stays"));
  EXPECT_TRUE(crew_->empty());
  start("dies", "stays");  // restarts it
  rounds(2);
  EXPECT_EQ(diary_.turns["dies"], 5);
}

TEST_P(CrewTest, AProgramThatIsStoppedStandsStillUntilItGoesOn) {
  start("stops", "stops");
  start("stays", "stays");
  rounds(8);
  ends();
  EXPECT_TRUE(stopped_.contains("stops"));
  EXPECT_EQ(diary_.turns["stops"], 3);
  EXPECT_EQ(diary_.turns["stays"], 8);
  crew_->obey(shared_lines::Signal{"stops", SIGCONT});
  rounds(2);
  EXPECT_EQ(diary_.turns["stops"], 5);
}

TEST_P(CrewTest, AProgramThatIsKilledOrStoppedBeforeItIsReadyHasEnded) {
  start("dies", "dies early");
  start("stops", "stops early");
  start("stays", "stays");
  crew_->obey(shared_lines::Signal{"stops", SIGCONT});
  rounds(3);
  auto told = ends();
  EXPECT_EQ(told.size(), 2U);
  EXPECT_EQ(told["dies"].signal, SIGKILL);
  EXPECT_EQ(told["stops"].code, kExitProcessFailed);
  EXPECT_TRUE(stopped_.empty()) << "the launcher must not continue this program";
  EXPECT_NE(log("stops").find("stopped before it was ready"), std::string::npos) << log("stops");
  EXPECT_EQ(diary_.turns["stays"], 3);
}

TEST_P(CrewTest, AProgramThatIsAskedToEndDoesSo) {
  start("stays", "stays");
  start("stops", "stops");
  rounds(4);
  crew_->stop();
  rounds(2);
  auto told = ends();
  EXPECT_EQ(told["stays"].code, 7);
  EXPECT_EQ(told["stops"].code, 7) << "a stopped program ends, too";
  EXPECT_TRUE(crew_->empty());
  EXPECT_TRUE(diary_.destroyed.contains("stays"));
}

TEST_P(CrewTest, EachProgramWritesToItsOwnLog) {
  for (const char* name : {"one", "two", "solo"}) start(name, "stays");
  rounds(40);
  for (const std::string name : {"one", "two", "solo"}) {
    const std::string text = log(name);
    EXPECT_NE(text.find(name + " prints"), std::string::npos) << text;
    EXPECT_NE(text.find(name + " complains"), std::string::npos) << text;
    EXPECT_NE(text.find("[" + name + "] info " + name + " logs"), std::string::npos) << text;
    for (const std::string other : {"one", "two", "solo"}) {
      EXPECT_EQ(text.find(other) == std::string::npos, other != name) << text;
    }
  }
}

TEST_P(CrewTest, MembersThatShareNothingHaveTheirTurnsSideBySide) {
  if (GetParam() == 1) GTEST_SKIP() << "there is one thread";
  std::latch both(2);
  meeting = &both;
  for (const char* name : {"a", "b"}) start(name, "meets");
  rounds(4);  // in the third round, each program waits for the other
  EXPECT_EQ(diary_.turns["a"], 4);
  EXPECT_EQ(diary_.turns["b"], 4);
}

TEST_P(CrewTest, AThreadThatSharesATurnWorksForItsProgram) {
  const ForEach for_each = shared_turn(workers_);
  const DeathNotice notice("shared");
  ProgramOutput output(folder_ / "shared.log", false);
  output.enter();
  notice.enter();
  std::vector<const DeathNotice*> notices(100);
  std::vector<const ProgramOutput*> outputs(notices.size());
  for_each(notices.size(), [&](std::size_t i) {
    notices[i] = DeathNotice::here();
    outputs[i] = ProgramOutput::here();
  });
  for (const auto* one : notices) EXPECT_EQ(one, &notice);
  for (const auto* one : outputs) EXPECT_EQ(one, &output);
  EXPECT_EQ(DeathNotice::here(), &notice) << "the thread goes on with its own turn";
  DeathNotice::stand_down();
}

TEST_P(CrewTest, TheCpuTimeOfTheServerIsItsOwn) {
  start("sim_server", "stays");
  start("works", "works");
  rounds(2);
  const double before_s = diary_.cpu_s["sim_server"];
  rounds(2);
  EXPECT_LT(diary_.cpu_s["sim_server"] - before_s, 0.01)
      << "the time between the server's turns, in which the other program works, does not count";
  EXPECT_GE(diary_.cpu_s["sim_server"], before_s);
}

}  // namespace
}  // namespace skein::one_process
