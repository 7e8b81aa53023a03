// The components of an installation and their Debian packages: the files in them, and flights from a prefix to which
// the user may not write.
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <set>

#include "core/files/command_file.hpp"
#include "fleet_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;
using Paths = std::set<std::string>;

const Paths kAllPrograms = {"skein",   "skein_doctor", "sim_server",     "comm_router",
                            "station", "uav_agent",    "uav_agent_fleet"};

bool has_program(const std::string& name) { return std::system(("command -v " + name + " >/dev/null").c_str()) == 0; }

/// Paths of the files below `folder` that begin with `prefix`, without the prefix.
Paths below(const Paths& files, const std::string& prefix) {
  Paths found;
  for (const std::string& file : files) {
    if (file.starts_with(prefix)) found.insert(file.substr(prefix.size()));
  }
  return found;
}

Paths files_of(const fs::path& folder) {
  Paths files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_directory()) files.insert(fs::relative(entry.path(), folder));
  }
  return files;
}

class Packages : public FleetTest {
 protected:
  /// These tests need no scripts for pages, which could only be built with a network.
  Packages() { ::setenv("SKEIN_WITHOUT_WEB", "1", 1); }
  ~Packages() override { ::unsetenv("SKEIN_WITHOUT_WEB"); }

  /// Runs a program to its end; its exit code must be 0. @returns its stdout and stderr.
  std::string done(const Arguments& argv) {
    const std::string name = "step" + std::to_string(steps_++);
    const Arguments in_shell = {"/bin/sh", "-c", "exec \"$@\" 2>&1", "sh"};
    Arguments all = in_shell;
    all.insert(all.end(), argv.begin(), argv.end());
    ChildProcess& process = start_program(name, all);
    EXPECT_EQ(process.wait().code, 0) << argv[0] << ": " << process.out();
    return process.out();
  }

  fs::path install(const std::string& component) {
    const fs::path prefix = folder() / component;
    done({"cmake", "--install", build_path(), "--prefix", prefix, "--component", component});
    return prefix;
  }

  /// The package whose name begins with `name`; empty: there is none. cpack writes the packages once for all tests.
  fs::path package_that_begins_with(const std::string& name) {
    if (debs_.empty()) {
      debs_ = fs::temp_directory_path() / ("skein-packages-" + std::to_string(::getpid()));
      done({"env", "-C", build_path(), "cpack", "-B", debs_});
    }
    for (const fs::directory_entry& file : fs::directory_iterator(debs_)) {
      if (file.path().filename().string().starts_with(name)) return file.path();
    }
    return {};
  }
  static void TearDownTestSuite() {
    if (!debs_.empty()) fs::remove_all(debs_);
  }

 private:
  static inline fs::path debs_;

  int steps_ = 0;
};

TEST_F(Packages, EachComponentContainsItsFiles) {
  const Paths runtime = files_of(install("runtime")), agent = files_of(install("agent")),
              dev = files_of(install("dev")), python = files_of(install("python"));
  EXPECT_EQ(below(runtime, "bin/"), kAllPrograms);
  EXPECT_EQ(below(agent, "bin/"), Paths{"uav_agent"});
  EXPECT_EQ(below(dev, "bin/"), Paths{});
  EXPECT_EQ(below(runtime, "lib/"), Paths{"skein/libskein_other_clock.so"}) << "skein check-planner needs this library";
  EXPECT_EQ(below(agent, "lib/"), Paths{});
  Paths modules = below(files_of(source_path("python")), "skein/");
  std::erase_if(modules, [](const std::string& file) { return file.ends_with(".pyc"); });
  EXPECT_EQ(below(python, "lib/python3/dist-packages/skein/"), modules);
  EXPECT_EQ(below(python, "lib/skein/"), (Paths{"_skein_client.so", "libskein_python.so"}))
      << "planners in Python and users' own programs need these libraries";
  for (const Paths* programs : {&runtime, &agent}) {
    EXPECT_EQ(below(*programs, "share/skein/config/"), files_of(source_path("config")));
    Paths manuals;
    for (const std::string& program : below(*programs, "bin/")) manuals.insert(program + ".1.gz");
    EXPECT_EQ(below(*programs, "share/man/man1/"), manuals);
    EXPECT_EQ(below(*programs, "include/"), Paths{});
  }
  EXPECT_TRUE(runtime.contains("share/bash-completion/completions/skein"));
  EXPECT_TRUE(dev.contains("share/skein/ros2/skein_msgs/msg/Step.msg")) << "users of ROS 2 need this file";
  for (const std::string& file : files_of(source_path("idl"))) {
    EXPECT_EQ(dev.contains("share/skein/idl/" + file), file.ends_with(".idl"))
        << file << ": programs over DDS need the IDL files, and only these";
  }
  EXPECT_TRUE(dev.contains("include/skein/uav_agent/api/planner.hpp"));
  EXPECT_TRUE(dev.contains("lib/cmake/skein/skeinConfig.cmake"));
  EXPECT_EQ(runtime.contains("share/skein/web/report.js"), fs::exists(source_path("build/web/report.js")));
}

TEST_F(Packages, ManualPagesAreReadWithoutWarnings) {
  if (!has_program("man")) GTEST_SKIP() << "the program man is not installed";
  for (const fs::directory_entry& page : fs::directory_iterator(install("runtime") / "share/man/man1")) {
    const std::string name = page.path().stem().stem();
    const std::string show = "LC_ALL=C.UTF-8 man --warnings -l " + page.path().string();
    EXPECT_EQ(done({"/bin/sh", "-c", show + " 2>&1 >/dev/null"}), "") << name;
    EXPECT_NE(done({"/bin/sh", "-c", show}).find("NAME\n       " + name + " "), std::string::npos) << name;
  }
}

TEST_F(Packages, AUserWithoutWriteAccessCanFlyAnInstalledFleet) {
  const fs::path prefix = install("runtime"), home = folder() / "home";
  fs::create_directory(home);
  fs::permissions(folder(), fs::perms::others_exec | fs::perms::others_read, fs::perm_options::add);
  fs::permissions(home, fs::perms::all);
  const std::string without_root = ::geteuid() == 0 ? "setpriv --reuid=nobody --regid=nogroup --clear-groups "
                                                    : "chmod -R a-w " + prefix.string() + ";";
  // No variable may help the launcher to find its programs and its configuration.
  done({"/bin/sh", "-c",
        "cd " + home.string() + " && unset SKEIN_CONFIG_DIR SKEIN_BIN_DIR SKEIN_AGENT && export HOME=" + home.string() +
            " PATH=" + (prefix / "bin").string() + ":$PATH; " + without_root + "sh -c '! touch " +
            (prefix / "bin" / "new").string() + " && skein run towers --duration 20'"});
  if (::geteuid() != 0) done({"chmod", "-R", "u+w", prefix});
  const Json flown = Json::parse(text_of(home / "runs" / "towers-flock-0" / "result.json"));
  EXPECT_EQ(flown["status"], "completed");
  EXPECT_EQ(flown["digest"], run("built", {"towers", "--duration", "20"}).digest());
}

TEST_F(Packages, ThePythonPackageFliesInstalledPrograms) {
  const fs::path programs = install("runtime"), modules = install("python") / "lib/python3/dist-packages";
  const std::string flown =
      done(installed({"PYTHONPATH=" + modules.string(),
                      "PATH=" + (programs / "bin").string() + ":" + std::getenv("PATH"), python_program(), "-B", "-c",
                      "import skein; print(skein.find_launcher()); "
                      "print(skein.run('towers', planner='hover', one_process=True, duration=2).status)"}));
  EXPECT_EQ(flown, (programs / "bin" / "skein").string() + "\ncompleted\n");
}

/// All components in one folder, without a variable that helps Python to find the package.
TEST_F(Packages, APlannerInPythonFliesWithInstalledFiles) {
  const fs::path prefix = install("runtime");
  done({"cmake", "--install", build_path(), "--component", "python", "--prefix", prefix});
  std::ofstream(folder() / "up.py") << "from skein.planner import *\nimport skein\n"
                                       "class Up(Planner):\n    def plan(self, inputs):\n"
                                       "        print(skein.__file__)\n        return PlannerOutput(Hold())\n";
  done(installed({prefix / "bin" / "skein", "run", "towers", "--planner", "py:up.py", "--one-process", "--duration",
                  "2", "--no-report", "--out", "flown"}));
  const std::string said = text_of(folder() / "flown" / "uav_agent-jurong.log");
  EXPECT_NE(said.find((prefix / "lib/python3/dist-packages/skein").string()), std::string::npos) << said;
}

/// The same with a Python program that replaces a UAV's software.
TEST_F(Packages, AProgramInPythonFliesWithInstalledFiles) {
  const fs::path prefix = install("runtime");
  done({"cmake", "--install", build_path(), "--component", "python", "--prefix", prefix});
  std::ofstream(folder() / "up.py") << "from skein.client import Client\nimport skein\n"
                                       "with Client() as uav:\n    for step in uav:\n"
                                       "        uav.fly_to(step.state.p_WB + [0, 0, 1])\n"
                                       "print('flown by', skein.__file__)\n";
  const fs::path modules = prefix / "lib/python3/dist-packages";
  done(installed({"PYTHONPATH=" + modules.string(), prefix / "bin" / "skein", "run", "towers", "--planner",
                  "hover,jurong=exec:exec " + python_program() + " -B up.py", "--duration", "2", "--no-report", "--out",
                  "flown"}));
  const std::string said = text_of(folder() / "flown" / "uav_agent-jurong.log");
  EXPECT_NE(said.find("flown by " + (modules / "skein").string()), std::string::npos) << said;
}

TEST_F(Packages, InstalledSymbolsNameFunctionsAndTheirSource) {
  for (const char* tool : {"dpkg-deb", "dpkg-shlibdeps", "file", "gdb", "readelf"}) {
    if (!has_program(tool)) GTEST_SKIP() << "there is no " << tool << " here";
  }
  const fs::path root = folder() / "root", symbols = root / "usr/lib/debug";
  for (const char* name : {"skein_", "skein-dbgsym_", "skein-source_"}) {
    const fs::path package = package_that_begins_with(name);
    ASSERT_FALSE(package.empty()) << name;
    done({"dpkg-deb", "-x", package, root});
  }
  for (const std::string& program : kAllPrograms) {
    const std::string binary = root / "usr/bin" / program;
    EXPECT_EQ(done({"readelf", "--section-headers", "--wide", binary}).find(".debug_info"), std::string::npos)
        << program;
    const std::string id = done({"/bin/sh", "-c", "readelf -n " + binary + " | sed -n 's/.*Build ID: //p'"});
    EXPECT_TRUE(fs::exists(symbols / ".build-id" / id.substr(0, 2) / (id.substr(2, id.size() - 3) + ".debug")))
        << program;
  }
  const std::string said =
      done({"gdb", "-nx", "-batch", "-iex", "set debug-file-directory " + symbols.string(), "-ex",
            "source " + (root / "usr/share/skein/config/gdb/skein_printers.py").string(), "-ex",
            "info line skein::agent::PatrolPlanner::plan", "-ex", "list main", root / "usr/bin/uav_agent"});
  EXPECT_NE(said.find("PatrolPlanner4plan"), std::string::npos) << said;
  EXPECT_NE(said.find("int main("), std::string::npos) << "gdb does not show the source code: " << said;
}

TEST_F(Packages, DebianPackagesAreTheComponents) {
  for (const char* tool : {"dpkg-deb", "dpkg-shlibdeps", "file"}) {
    if (!has_program(tool)) GTEST_SKIP() << "there is no " << tool << " here";
  }
  const std::map<std::string, std::string> names = {{"runtime", "skein"},
                                                    {"agent", "skein-agent"},
                                                    {"dev", "skein-dev"},
                                                    {"source", "skein-source"},
                                                    {"python", "python3-skein"}};
  std::map<std::string, std::string> depends;
  for (const auto& [component, name] : names) {
    const fs::path package = package_that_begins_with(name + "_");
    ASSERT_FALSE(package.empty()) << name;
    const auto field = [&](const std::string& key) { return done({"dpkg-deb", "-f", package, key}); };
    EXPECT_EQ(field("Package"), name + "\n");
    for (const char* key : {"Version", "Maintainer", "Section", "Description", "Installed-Size"}) {
      EXPECT_GT(field(key).size(), 1u) << name << ' ' << key;
    }
    depends[component] = field("Depends");
    done({"dpkg-deb", "-x", package, folder() / name});
    EXPECT_EQ(files_of(folder() / name / "usr"), files_of(install(component))) << name;
    EXPECT_TRUE(fs::exists(folder() / name / "usr/share/doc" / name / "copyright"));
  }
  const auto needs = [&](const char* component, const char* what) {
    return depends[component].find(what) != std::string::npos;
  };
  for (const char* programs : {"runtime", "agent"}) {
    EXPECT_TRUE(needs(programs, "libfastrtps") && needs(programs, "libddsc") && needs(programs, "libpcl-common"));
    EXPECT_FALSE(needs(programs, "-dev") || needs(programs, "g++") || needs(programs, "libpcl-io"));
    EXPECT_FALSE(needs(programs, "python")) << "planners in Python need a package of their own";
  }
  EXPECT_TRUE(needs("runtime", "libembree3"));
  EXPECT_FALSE(needs("agent", "libembree3"));
  EXPECT_TRUE(needs("python", "skein (= ") && needs("python", "python3-numpy"));
  EXPECT_TRUE(needs("python", "| skein-agent (= ") && needs("python", "libpython3.11"));
  EXPECT_TRUE(needs("dev", "skein (= ") && needs("dev", "libeigen3-dev"));
}

TEST_F(Packages, WithoutTheScriptOfPagesNothingIsInstalledUnlessTheUserSaysSo) {
  fs::create_directories(folder() / "tree" / "web" / "src");
  const Arguments look = {command_file("cmake"), "-DSKEIN_ROOT=" + (folder() / "tree").string(), "-P",
                          source_path("cmake/SkeinWebBundle.cmake")};
  const auto expect = [&](const std::string& variable, int code, const std::string& text) {
    Arguments all = {"/bin/sh", "-c", "exec \"$@\" 2>&1", "sh", "/usr/bin/env", "PATH=/nowhere", variable};
    all.insert(all.end(), look.begin(), look.end());
    ChildProcess& process = start_program("look" + variable + std::to_string(code), all);
    EXPECT_EQ(process.wait().code, code) << process.out();
    EXPECT_NE(process.out().find(text), std::string::npos) << process.out();
  };
  expect("SKEIN_WITHOUT_WEB=", 1, "report.js");
  expect("SKEIN_WITHOUT_WEB=1", 0, "report.js");
  fs::create_directories(folder() / "tree" / "build" / "web");
  std::ofstream(folder() / "tree" / "build" / "web" / "report.js") << "// built";
  expect("SKEIN_WITHOUT_WEB=", 0, "");
}

}  // namespace
}  // namespace skein::test
