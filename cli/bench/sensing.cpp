#include "cli/bench/sensing.hpp"

#include <fstream>

#include "cli/bench/flown.hpp"
#include "cli/bench/report.hpp"
#include "cli/bench/scenario.hpp"
#include "host/preflight.hpp"
#include "host/supervisor.hpp"
#include "process/files/atomic_file.hpp"
#include "process/host/environment.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {
namespace {

constexpr const char* kProgram = "bench_sensing";
constexpr const char* kAgent = "bench_sensing_agent";  // its planner `look` asks for beams or does not
constexpr double kFlightS = 60.0, kQuickFlightS = 3.0;
constexpr int kRepeats = 3;
constexpr const char* kSeed = "1";  // with the range noise of the LiDAR

class SensingBench {
 public:
  SensingBench(const BenchOptions& options, const Console& console) : options_(options), console_(console) {}

  int run() {
    const std::filesystem::path vendors = scratch_.path() / "vendors.json";
    write_file_atomically(vendors, fly_over_vendors().dump());
    std::vector<std::string> argv = {program_dir() / kProgram, "--seed", kSeed, "--vendors", vendors};
    if (options_.quick) argv.push_back("--quick");
    if (options_.write) argv.insert(argv.end(), {"--write", *options_.write});
    console_.err << "bench: flights at two sites" << std::endl;
    const std::filesystem::path log = scratch_.path() / run_folder::log_file(kProgram);
    const ExitStatus exit = run_to_end({kProgram, argv, fleet_environment(false), log});
    // Nothing to insert would count as an error of the console.
    if (std::ifstream said(log); said.peek() != std::ifstream::traits_type::eof()) console_.out << said.rdbuf();
    console_.out << std::flush;
    return exit.ok() && !failed_ ? kExitDone : kExitProcessFailed;
  }

 private:
  /// Without and with beams by turns, so that other load of the machine affects both alike.
  Json fly_over_vendors() {
    const std::filesystem::path scenario = scratch_.path() / "one.yaml";
    write_file_atomically(scenario, bench_scenario({.uavs = 1, .duration_s = 600.0}));
    Json vendors = Json::array();
    for (const std::string vendor : {"cyclonedds", "fastdds"}) {
      std::vector<Json> plain, beams;
      for (int i = 0; i < (options_.quick ? 1 : options_.repeats.value_or(kRepeats)); ++i) {
        plain.push_back(fly(scenario, vendor, "look"));
        beams.push_back(fly(scenario, vendor, "look:beams=true"));
      }
      vendors.push_back({{"vendor", vendor}, {"plain", step_entry(plain)}, {"beams", step_entry(beams)}});
    }
    return vendors;
  }

  Json fly(const std::string& scenario, const std::string& vendor, const std::string& planner) {
    const std::string what = planner + " over " + vendor;
    console_.err << "bench: " << what << std::endl;
    RunOptions run;
    run.scenario = scenario;
    run.planner = planner;
    run.agent = program_dir() / kAgent;
    run.dds = vendor;
    run.stop_at_s = options_.quick ? kQuickFlightS : kFlightS;
    run.out = scratch_.path() / "run";
    run.force = true;
    run.attainable = run.report = false;
    return cli::fly(run, what, console_.err, failed_);
  }

  const BenchOptions& options_;
  const Console console_;
  const ScratchDir scratch_;
  bool failed_ = false;
};

}  // namespace

int bench_sensing(const BenchOptions& options, const Console& console) {
  for (const char* program : {kProgram, kAgent}) {
    if (!std::filesystem::exists(program_dir() / program)) {
      throw InputError(std::string("bench: ") + program + " is not built; `./skein bench` builds it");
    }
  }
  return SensingBench(options, console).run();
}

}  // namespace skein::cli
