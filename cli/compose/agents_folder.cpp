#include "cli/compose/agents_folder.hpp"

#include <string>
#include <vector>

#include "results/run_folder.hpp"

namespace skein::cli {

namespace fs = std::filesystem;

void gather_agents(const fs::path& out) {
  const fs::path agents = out / kAgentsFolder;
  if (!fs::is_directory(fs::symlink_status(agents))) return;
  std::vector<fs::path> files;  // moved after the iteration
  for (const auto& folder : fs::directory_iterator(agents)) {
    if (!fs::is_directory(folder.symlink_status())) continue;
    const std::string member = folder.path().filename(), program = programs::agent_program(member);
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename();
      const bool own = name.starts_with(program + ".") || run_folder::is_maps_file(name, member);
      if (fs::is_regular_file(entry.symlink_status()) && own) files.push_back(entry);
    }
  }
  for (const fs::path& file : files) fs::rename(file, out / file.filename());
  fs::remove_all(agents);
}

}  // namespace skein::cli
