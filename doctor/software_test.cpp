// How the doctor reads the shared memory of made-up processes, and how it judges facts about other software.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "doctor/software_judges.hpp"

namespace skein::doctor {
namespace {

namespace fs = std::filesystem;

class MadeUpMemory : public testing::Test {
 protected:
  MadeUpMemory() {
    std::string pattern = fs::temp_directory_path() / "skein-doctor-shm-XXXXXX";
    root_ = ::mkdtemp(pattern.data());
    fs::create_directories(root_ / "dev/shm");
    fs::create_directories(root_ / "proc/self");
  }
  ~MadeUpMemory() override { fs::remove_all(root_); }

  void segment(const std::string& name, std::size_t bytes) const {
    std::ofstream(root_ / "dev/shm" / name) << std::string(bytes, 'x');
  }
  void process(int id, const std::string& maps, const std::string& open) const {
    const fs::path folder = root_ / "proc" / std::to_string(id);
    fs::create_directories(folder / "fd");
    if (!maps.empty()) std::ofstream(folder / "maps") << "7f00-7f01 rw-s 00000000 00:1b 17   /dev/shm/" + maps + "\n";
    if (!open.empty()) fs::create_symlink("/dev/shm/" + open, folder / "fd" / "3");
  }

  fs::path root_;
};

TEST_F(MadeUpMemory, SegmentsThatNoProcessUsesAreCounted) {
  std::mt19937_64 random(1);
  std::size_t unused = 0, bytes = 0;
  for (int i = 0; i < 60; ++i) {
    const std::string name = (i % 2 == 0 ? "fastrtps_" : "sem.fastrtps_") + std::to_string(i);
    const std::size_t size = random() % 1000;
    segment(name, size);
    const auto use = random() % 3;
    if (use == 1) process(100 + i, name, "");
    if (use == 2) process(100 + i, "", name);
    if (use == 0) ++unused, bytes += size;
  }
  segment("somebody_elses", 10);
  const SharedMemoryFacts facts = read_shared_memory(root_);
  EXPECT_TRUE(facts.there && facts.writable);
  EXPECT_EQ(facts.segments, 60u);
  EXPECT_EQ(facts.unused, unused);
  EXPECT_EQ(facts.unused_bytes, bytes);
  EXPECT_EQ(judge_shared_memory(facts).verdict, Verdict::warn);
  fs::remove_all(root_ / "dev/shm");
  EXPECT_EQ(judge_shared_memory(read_shared_memory(root_)).verdict, Verdict::ok)
      << "a fleet works without shared memory";
}

TEST(SoftwareJudges, VariablesThatConfigureDdsAreNamed) {
  ASSERT_EQ(::setenv("CYCLONEDDS_URI", "file:///nowhere.xml", 1), 0);
  VariableFacts facts = read_variables();
  EXPECT_NE(judge_variables(facts)[0].found.find("CYCLONEDDS_URI"), std::string::npos);
  EXPECT_EQ(judge_variables(facts)[0].verdict, Verdict::warn);
  ::unsetenv("CYCLONEDDS_URI");
  for (const Finding& finding : judge_variables(read_variables())) EXPECT_EQ(finding.verdict, Verdict::ok);
  facts = {.ignored = {}, .vendor = {"/opt/ros/humble/lib/libfastcdr.so.1"}};
  EXPECT_EQ(judge_variables(facts)[1].verdict, Verdict::warn);
}

TEST(SoftwareJudges, DockerTroublesAreOnlyWarnings) {
  EXPECT_EQ(judge_docker({}).verdict, Verdict::ok);
  DockerFacts docker{.client = true, .host = "tcp://there:1", .trouble = "no answer"};
  EXPECT_EQ(judge_docker(docker).verdict, Verdict::warn);
  EXPECT_NE(judge_docker(docker).found.find(docker.host), std::string::npos);
  docker.engine = "28.0";
  EXPECT_EQ(judge_docker(docker).verdict, Verdict::warn) << "docker-compose is missing";
  docker.compose = "docker compose 2.30";
  EXPECT_EQ(judge_docker(docker).verdict, Verdict::ok);
}

TEST(SoftwareFacts, TheDoctorAsksDockerWithItsClient) {
  std::string pattern = fs::temp_directory_path() / "skein-doctor-docker-XXXXXX";
  const fs::path folder = ::mkdtemp(pattern.data());
  const std::string path = std::getenv("PATH");
  const auto script = [&](const std::string& body) {
    std::ofstream(folder / "docker") << "#!/bin/sh\n" + body;
    fs::permissions(folder / "docker", fs::perms::owner_all);
  };
  ::setenv("PATH", (folder.string() + ":" + path).c_str(), 1);
  script("[ $1 = compose ] && echo 2.30 || echo 28.1");
  DockerFacts docker = ask_docker();
  EXPECT_EQ(docker.engine, "28.1");
  EXPECT_EQ(docker.compose, "docker compose 2.30");
  script("echo; echo 'Cannot connect'; exit 1");
  docker = ask_docker();
  EXPECT_FALSE(docker.engine);
  EXPECT_EQ(docker.trouble, "Cannot connect");
  ::setenv("PATH", (folder / "nowhere").c_str(), 1);
  EXPECT_FALSE(ask_docker().client);
  ::setenv("PATH", path.c_str(), 1);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace skein::doctor
