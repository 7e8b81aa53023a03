// bench_floor_<vendor>: measures lock-step rounds over the vendor's own API; prints one line of JSON on stdout.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <exception>
#include <iostream>

#include "bench/floor/floor.hpp"
#include "core/text/number_checks.hpp"
#include "process/program.hpp"

int main(int argc, char** argv) try {
  skein::bench::FloorOptions options;
  CLI::App app("Lock-step rounds over bare DDS");
  app.add_option("--uavs", options.uavs, "Size of the fleet")->check(CLI::Range(1, 128));
  app.add_option("--rounds", options.rounds, "Number of rounds")
      ->check(CLI::Validator(skein::check_positive, "POSITIVE"));
  app.add_option("--domain", options.base_domain, "First DDS domain")->check(CLI::Range(0, skein::bus::kMaxDomain));
  CLI11_PARSE(app, argc, argv);
  const skein::bench::FloorResult result = skein::bench::run_floor(options);
  std::cout << nlohmann::json{{"uavs", options.uavs},
                              {"rounds", result.rounds},
                              {"wall_s", result.wall_s},
                              {"cpu_s", result.cpu_s},
                              {"messages", result.messages},
                              {"bytes", result.bytes},
                              {"server_cpu_s", result.server_cpu_s}}
            << std::endl;
  return skein::kExitDone;
} catch (const std::exception& error) {
  std::cerr << error.what() << std::endl;
  return skein::kExitProcessFailed;
}
