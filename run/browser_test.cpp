#include "run/browser.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "host/preflight.hpp"
#include "host/testing/fake_programs.hpp"
#include "tests/support/eventually.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class Browser : public testing::Test {
 protected:
  Browser() {
    for (const char* name : {"xdg-open", "mine", "other"}) write_script(programs() / name, "exit 0\n");
    ::setenv("PATH", programs().c_str(), 1);
  }
  ~Browser() override { ::setenv("PATH", path_.c_str(), 1); }

  const fs::path& programs() const { return scratch_.path(); }
  Words command(const std::map<std::string, std::string>& variables) const {
    return browser_command("/there/view.html", [&](const char* name) {
      const auto found = variables.find(name);
      return found == variables.end() ? nullptr : found->second.c_str();
    });
  }
  std::string at(const char* name) const { return programs() / name; }

 private:
  const ScratchDir scratch_;
  const std::string path_ = ::getenv("PATH");
};

TEST_F(Browser, IsTheUsersChoiceOrThatOfTheDesktop) {
  EXPECT_EQ(command({{"DISPLAY", ":0"}}), (Words{at("xdg-open"), "/there/view.html"}));
  EXPECT_EQ(command({{"WAYLAND_DISPLAY", "wayland-0"}}), (Words{at("xdg-open"), "/there/view.html"}));
  EXPECT_EQ(command({{"DISPLAY", ":0"}, {"BROWSER", "mine"}}), (Words{at("mine"), "/there/view.html"}));
  EXPECT_EQ(command({{"DISPLAY", ":0"}, {"BROWSER", "none:other --new %s -q:mine"}}),
            (Words{at("other"), "--new", "/there/view.html", "-q"}));
  EXPECT_EQ(command({{"DISPLAY", ":0"}, {"BROWSER", "none"}}), (Words{at("xdg-open"), "/there/view.html"}));
}

TEST_F(Browser, IsNoneWithoutALocalDisplay) {
  EXPECT_EQ(command({}), Words());
  EXPECT_EQ(command({{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}, {"BROWSER", "mine"}}), Words());
  EXPECT_EQ(command({{"DISPLAY", "localhost:10.0"}, {"SSH_CONNECTION", "192.0.2.1 1 192.0.2.2 22"}}), Words());
  fs::remove(at("xdg-open"));
  EXPECT_EQ(command({{"DISPLAY", ":0"}}), Words());
}

TEST_F(Browser, IsStartedInASessionOfItsOwnWithoutOutput) {
  const fs::path seen = programs() / "seen";
  const std::string part = programs() / "part";
  write_script(at("mine"), "echo said\necho wrong >&2\nread -r _ _ _ _ _ session _ </proc/$$/stat\necho $1 $session >" +
                               part + "\nexec /bin/mv " + part + " " + seen.string() + "\n");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  EXPECT_TRUE(start_browser(command({{"DISPLAY", ":0"}, {"BROWSER", "mine"}})));
  EXPECT_TRUE(eventually([&] { return fs::exists(seen); }));
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
  const std::string text = read_text(seen);
  EXPECT_TRUE(text.starts_with("/there/view.html ")) << text;
  EXPECT_NE(std::atoi(text.substr(text.find(' ')).c_str()), ::getsid(0)) << text;
}

}  // namespace
}  // namespace skein::cli
