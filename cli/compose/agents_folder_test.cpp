// Which files of an agent become part of a run's results.
#include "cli/compose/agents_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <set>
#include <string>

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

TEST(AgentsFolder, GivesTheFilesNamedAfterTheAgentAndItsMapsInTime) {
  std::string name = fs::temp_directory_path() / "skein-agents-XXXXXX";
  ASSERT_NE(::mkdtemp(name.data()), nullptr);
  const fs::path out = name, folder = out / kAgentsFolder / "jurong";
  fs::create_directories(folder);
  const std::set<std::string> own = {"uav_agent-jurong.log", "maps-jurong.mcap", "maps-jurong.2.mcap"};
  for (const std::string& file : own) std::ofstream(folder / file) << "x";
  for (const char* file : {"maps-raffles.mcap", "uav_agent-raffles.log", "result.json"}) std::ofstream(folder / file);
  gather_agents(out);
  std::set<std::string> found;
  for (const auto& entry : fs::directory_iterator(out)) found.insert(entry.path().filename());
  EXPECT_EQ(found, own);
  fs::remove_all(out);
}

}  // namespace
}  // namespace skein::cli
