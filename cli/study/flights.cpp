#include "cli/study/flights.hpp"

#include <spdlog/fmt/fmt.h>

#include <chrono>
#include <cmath>
#include <deque>
#include <ostream>
#include <system_error>

#include "cli/study/side_by_side.hpp"
#include "core/text/suggestion.hpp"
#include "core/types.hpp"
#include "host/supervisor.hpp"
#include "process/files/atomic_file.hpp"
#include "results/result_file.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_plan.hpp"
#include "run/results_dir.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

}  // namespace

bool went_to_its_end(const Json& result) {
  const Json status = value_or(result, "status", "");
  return status == name_of(RunStatus::completed) || status == name_of(RunStatus::no_takeoff);
}

Json sound_result(const fs::path& dir, std::ostream* say) try {
  std::error_code error;
  return fs::exists(dir / run_folder::kResult, error) ? results::read_result_file(dir) : Json();
} catch (const InputError& damage) {
  if (say != nullptr) *say << damage.what() << "; Skein flies this flight again" << std::endl;
  return {};
}

std::string problem_of(const fs::path& dir, const Json& result, const ExitStatus& exit) {
  std::string reasons;
  const auto add = [&](const std::string& reason) { reasons += (reasons.empty() ? "" : "; ") + reason; };
  for (const Json& lost : value_or(result, "lost_members", Json::array())) {
    add(fmt::format("{} at {:.1f} s: {}", text_in(lost, "member"), number_in(lost, "time_s"), text_in(lost, "reason")));
  }
  for (const Json& warning : value_or(result, "warnings", Json::array())) {
    const std::string text = warning.is_string() ? warning.get<std::string>() : "";
    if (results::is_failure(text)) add(text);
  }
  if (reasons.empty()) {
    for (const std::string& line : last_lines(dir / run_folder::kFlightLog, 1)) add(line);
  }
  return "skein run ended with " + exit.text() + (reasons.empty() ? "" : ": " + reasons);
}

namespace {

/// One call of fly_study().
class StudyRun {
 public:
  StudyRun(const StudyPlan& plan, const Console& console) : plan_(plan), console_(console) {
    outcomes_.flights.resize(plan.flights.size());
  }

  StudyOutcomes fly() {
    std::deque<std::size_t> waiting;
    for (std::size_t i = 0; i < plan_.flights.size(); ++i) {
      if (auto outcome = flown_before(plan_.flights[i], &console_.err)) {
        outcomes_.flights[i] = std::move(*outcome);
        ++over_;
      } else {
        waiting.push_back(i);
        left_s_ += plan_.flights[i].mission_s;
      }
    }
    if (over_ > 0) tell(fmt::format("{} of {} flights are complete already", over_, plan_.flights.size()));
    SideBySide side_by_side(static_cast<std::size_t>(plan_.jobs), console_);
    outcomes_.interrupted = !side_by_side.fly(
        std::move(waiting), [this](std::size_t index) { return start(index); },
        [this](std::size_t index, const ExitStatus& exit) { on_exit(index, exit); });
    return std::move(outcomes_);
  }

 private:
  ProgramSpec start(std::size_t index) const {
    const StudyFlight& flight = plan_.flights[index];
    if (const std::error_code error = make_results_folder(flight.dir)) throw std::system_error(error, flight.dir);
    fs::remove(flight.dir / kFlightMark);
    fs::remove(flight.dir / run_folder::kResult);  // if the flight is refused, the former result must not count
    return flight_program(flight_options(plan_, flight));
  }

  void on_exit(std::size_t index, const ExitStatus& exit) {
    const StudyFlight& flight = plan_.flights[index];
    StudyOutcome& outcome = outcomes_.flights[index];
    const Json result = read_json(flight.dir / run_folder::kResult);
    if (!exit.ok() || !went_to_its_end(result)) outcome.problem = problem_of(flight.dir, result, exit);
    if (went_to_its_end(result)) outcome.figures = figures_of(result);
    write_file_atomically(flight.dir / kFlightMark,
                          json_text({{"command", flight.command()}, {"problem", outcome.problem}}, 2) + "\n");
    ++over_;
    flown_s_ += flight.mission_s;
    left_s_ -= flight.mission_s;
    tell(fmt::format("{} of {}: {}", over_, plan_.flights.size(), news_of(flight, outcome)));
  }

  std::string news_of(const StudyFlight& flight, const StudyOutcome& outcome) const {
    std::string news =
        fmt::format("{}, {}, seed {}: ", plan_.scenarios[flight.scenario], plan_.labels[flight.planner], flight.seed);
    if (const auto& figures = outcome.figures) {
      news +=
          fmt::format("score {:.1f}, {}, x{:.1f} real time", figures->score,
                      counted(static_cast<std::size_t>(figures->collisions), "collision"), figures->real_time_factor);
    }
    if (!outcome.problem.empty()) news += (outcome.figures ? "; " : "") + outcome.problem;
    const double wall_s = std::chrono::duration<double>(Clock::now() - started_).count();
    if (over_ < plan_.flights.size()) news += "; about " + duration_text(left_s_ / flown_s_ * wall_s) + " left";
    return news;
  }

  void tell(const std::string& text) const { console_.err << text << std::endl; }

  const StudyPlan& plan_;
  const Console console_;
  StudyOutcomes outcomes_;
  std::size_t over_ = 0;
  double flown_s_ = 0.0, left_s_ = 0.0;  ///< mission time of this call's flights: of the finished ones; of the others
  const Clock::time_point started_ = Clock::now();
};

}  // namespace

bool is_of_sound_flight(const Json& mark, const Json& command) {
  static const Json no_problem = "";
  return value_or(mark, "command", nullptr) == command && value_or(mark, "problem", nullptr) == no_problem;
}

std::optional<StudyOutcome> flown_before(const StudyFlight& flight, std::ostream* say) {
  const Json mark = read_json(flight.dir / kFlightMark);
  if (!is_of_sound_flight(mark, flight.command())) return std::nullopt;
  const Json result = sound_result(flight.dir, say);
  if (value_or(result, "seed", nullptr) != flight.seed || !went_to_its_end(result)) return std::nullopt;
  return StudyOutcome{figures_of(result), ""};
}

StudyOutcomes fly_study(const StudyPlan& plan, const Console& console) { return StudyRun(plan, console).fly(); }

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(std::lround(std::max(seconds, 0.0)));
  if (whole < 90) return fmt::format("{} s", whole);
  const long minutes = (whole + 30) / 60;
  if (minutes < 90) return fmt::format("{} min", minutes);
  return fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

}  // namespace skein::cli
