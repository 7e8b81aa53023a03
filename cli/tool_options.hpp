// The command lines of what is no flight: tests, checks, scenes, measurements.
#pragma once

#include "cli/options.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

// Each adds a sub-command, whose options are read into the second argument.
CLI::App* add_test(CLI::App& app, TestOptions& test);
CLI::App* add_check(CLI::App& app, CheckOptions& check);
CLI::App* add_scene(CLI::App& app, SceneOptions& scene);
CLI::App* add_bench(CLI::App& app, BenchOptions& bench);
CLI::App* add_oracle(CLI::App& app, OracleOptions& oracle);

}  // namespace skein::cli
