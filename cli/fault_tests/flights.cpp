#include "cli/fault_tests/flights.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "core/scenario/scenario_reader.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

/// Whether the command line names this repetition.
bool is_named(const TestOptions& options, Repeat repeat) {
  return std::ranges::find(options.repeat, name_of(repeat)) != options.repeat.end();
}

/// The repetitions that the command line asks for.
std::vector<Repeat> asked_repeats(const TestOptions& options) {
  std::vector<Repeat> repeats;
  for (const auto& entry : enum_names(Repeat{})) {
    if (options.long_tests || is_named(options, entry.value)) repeats.push_back(entry.value);
  }
  return repeats;
}

/// The same flight, flown that way. @param number  of the test.
FaultFlight repeated(FaultFlight flight, Repeat repeat, std::size_t number) {
  switch (repeat) {
    case Repeat::again:
      break;
    case Repeat::chaos:
      flight.chaos = number;
      break;
    case Repeat::one_process:
      flight.options.one_process = true;
      break;
    case Repeat::cyclonedds:
    case Repeat::fastdds:
    case Repeat::mixed:
      flight.options.one_process = false;
      flight.options.dds = name_of(repeat);
      break;
  }
  return flight;
}

/// Whether this repetition is over DDS, and the fleet is too large for it.
bool is_impossible(const FaultTest& test, Repeat repeat) {
  return needs_dds(repeat) && test.plan.scenario.fleet.size() > kMostUavsOverDds;
}

/// @throws InputError if this repetition is impossible.
void check_repeat(const FaultTest& test, Repeat repeat) {
  if (!is_impossible(test, repeat)) return;
  throw InputError(
      fmt::format("{}: cannot be repeated with '{}', because over DDS at most {} UAVs fly, and this fleet "
                  "has {}; it flies in one process only",
                  test.file.string(), name_of(repeat), kMostUavsOverDds, test.plan.scenario.fleet.size()));
}

class Planning {
 public:
  explicit Planning(const TestOptions& options) : options_(options), asked_(asked_repeats(options)) {}

  void add(const FaultTest& test) {
    const std::size_t index = planned_.tests.size();
    FlightsOfTest flights;
    flights.own = add_flight({test.name, test.plan.options}, test.file.string());
    if (test.needs_fault_free()) flights.fault_free = fault_free(test);
    std::map<std::string, std::size_t> repeats;  // each way once
    for (const Repeat repeat : repeats_of(test, index)) {
      const std::string how = name_of(repeat);
      if (repeats.contains(how)) continue;
      check_repeat(test, repeat);
      repeats[how] = add_flight(repeated({test.name + "-" + how, test.plan.options}, repeat, index + 1),
                                "the repetition '" + how + "' of " + test.file.string());
    }
    flights.repeats.assign(repeats.begin(), repeats.end());
    planned_.tests.push_back(std::move(flights));
  }
  FaultFlights planned() { return std::move(planned_); }

 private:
  /// @param what  is flown, for the message if another flight has the same name.
  std::size_t add_flight(FaultFlight flight, const std::string& what) {
    const auto [known, is_new] = names_.try_emplace(flight.name, what);
    if (!is_new) {
      throw InputError(what + " and " + known->second + " would both write to the folder " + flight.name +
                       "; give one of the files another name");
    }
    flight.options.out = std::filesystem::absolute(options_.out) / flight.name;
    planned_.flights.push_back(std::move(flight));
    return planned_.flights.size() - 1;
  }

  std::size_t fault_free(const FaultTest& test) {
    FaultFlight flight{"without-faults-" + std::to_string(fault_free_.size() + 1), test.plan.options};
    flight.options.faults.reset();
    const auto [found, is_new] = fault_free_.try_emplace(what_is_flown(flight.options));
    if (is_new) found->second = add_flight(std::move(flight), "the run without faults for " + test.file.string());
    return found->second;
  }

  std::vector<Repeat> repeats_of(const FaultTest& test, std::size_t index) const {
    std::vector<Repeat> all = test.expect.same_digest, asked = asked_;
    // --long means all that are possible.
    std::erase_if(asked, [&](Repeat repeat) { return is_impossible(test, repeat) && !is_named(options_, repeat); });
    if (options_.rotate && !asked.empty()) {
      all.push_back(asked[index % asked.size()]);
    } else {
      all.insert(all.end(), asked.begin(), asked.end());
    }
    return all;
  }

  const TestOptions& options_;
  const std::vector<Repeat> asked_;
  FaultFlights planned_;
  std::map<std::string, std::size_t> fault_free_;  ///< by what is flown
  std::map<std::string, std::string> names_;       ///< what flies under each name
};

}  // namespace

FaultFlights plan_fault_flights(const std::vector<FaultTest>& tests, const TestOptions& options) {
  Planning planning(options);
  for (const FaultTest& test : tests) planning.add(test);
  return planning.planned();
}

std::string what_is_flown(const RunOptions& options) {
  std::ostringstream text;
  text << options.scenario << '\n' << options.planner << '\n' << options.seed << '\n';
  if (options.duration_s) text << *options.duration_s;
  text << '\n';
  if (options.scene_seed) text << *options.scene_seed;
  if (options.uavs) text << "\n" << *options.uavs << " UAVs";
  if (options.conditions) text << "\nconditions " << *options.conditions;
  return text.str();
}

}  // namespace skein::cli
