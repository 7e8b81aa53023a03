// The command lines of what is no flight: tests, checks, scenes, measurements.
#pragma once

#include "cli/command.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

// Each adds a sub-command, whose options are read into the second argument.
void add_test(CLI::App& app, TestOptions& test);
void add_check(CLI::App& app, CheckOptions& check);
void add_scene(CLI::App& app, SceneOptions& scene);
void add_bench(CLI::App& app, BenchOptions& bench);
void add_oracle(CLI::App& app, OracleOptions& oracle);

}  // namespace skein::cli
