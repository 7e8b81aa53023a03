#include "cli/keys_command.hpp"

#include <CLI/CLI.hpp>
#include <system_error>

#include "cli/compose/compose_file.hpp"
#include "cli/flight_options.hpp"
#include "cli/secure/security.hpp"
#include "process/files/private_file.hpp"
#include "process/program.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

}  // namespace

void add_keys(CLI::App& app, KeysOptions& keys) {
  CLI::App* command = app.add_subcommand("keys", "Make the certificates and permissions of a secured fleet");
  add_flight_options(*command, keys.run);
  command->add_option("--domain", keys.run.domain, "First DDS domain (default 1)");
  command->add_option("--out", keys.out, "New folder, with a folder for each program")->required();
  command->footer("Example:\n  skein keys towers --out keys");
}

void write_keys(const FleetPlan& plan, int base_domain, const fs::path& folder,
                const std::function<void(const fs::path&)>& give) {
  for (const auto& [program, files] : security_of(plan, base_domain)) {
    fs::create_directories(folder / program);
    fs::permissions(folder / program, fs::perms::owner_all);
    for (const auto& [name, text] : files) {
      write_private_file(folder / program / name, text);
      give(folder / program / name);
    }
    give(folder / program);
  }
}

int make_keys(const KeysOptions& options, const Console& console) {
  RunOptions run = options.run;
  run.secure = true;
  const FleetPlan plan = plan_fleet(run, program_dir());
  std::error_code error;
  if (!fs::create_directories(options.out, error)) {
    throw InputError("--out " + options.out.string() + ": " +
                     (error ? error.message() : "exists already; Skein never overwrites keys"));
  }
  try {
    write_keys(plan, run.domain.value_or(kComposeBaseDomain), options.out, [](const fs::path&) {});
  } catch (...) {  // a full disk, say: a part of the keys must not pass for all of them
    fs::remove_all(options.out, error);
    throw;
  }
  console.out << "keys of " << domain_count(plan) + 1 << " programs in " << options.out.string()
              << "; anyone who can read a program's folder can act as this program" << std::endl;
  return kExitDone;
}

}  // namespace skein::cli
