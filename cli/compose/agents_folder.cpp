#include "cli/compose/agents_folder.hpp"

#include <string>
#include <vector>

#include "process/run_folder.hpp"

namespace skein::cli {

namespace fs = std::filesystem;

void gather_agents(const fs::path& out) {
  const fs::path agents = out / kAgentsFolder;
  if (!fs::is_directory(fs::symlink_status(agents))) return;
  std::vector<fs::path> files;  // moved once nothing iterates
  for (const auto& folder : fs::directory_iterator(agents)) {
    if (!fs::is_directory(folder.symlink_status())) continue;
    const std::string program = programs::agent_program(folder.path().filename());
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename();
      if (fs::is_regular_file(entry.symlink_status()) && name.starts_with(program + ".")) files.push_back(entry);
    }
  }
  for (const fs::path& file : files) fs::rename(file, out / file.filename());
  fs::remove_all(agents);
}

}  // namespace skein::cli
