#include "bus/program_bus.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/types.hpp"
#include "process/host/open_files.hpp"
#include "tests/support/limited_files.hpp"

namespace skein::bus {
namespace {

constexpr std::size_t kDomains = 7;

/// The bus of a program that joins all domains of a fleet of five.
std::unique_ptr<Bus> made_bus(const std::string& dds, bool check_only = false) {
  Scenario scenario;
  scenario.fleet.resize(kDomains - 2);
  ProgramOptions options;
  options.dds = dds;
  options.check_only = check_only;
  return make_bus(options, scenario, kDomains);
}

TEST(ProgramBus, RaisesTheLimitOfOpenFilesToWhatItNeeds) {
  for (const std::string& dds : dds_vendors()) {
    const LimitedOpenFiles low(40);
    made_bus(dds);
    EXPECT_EQ(open_files_limit(), ample_open_files(kDomains)) << dds;
  }
}

TEST(ProgramBus, ALimitThatIsTooLowIsRefusedBeforeAVendorEndsTheProgram) {
  const auto said = [](const std::string& dds, bool check_only) {
    return done_with_open_files(40, [&] {
      made_bus(dds, check_only);
      return std::string("accepted");
    });
  };
  for (const std::string& dds : dds_vendors()) {
    const std::string refusal = said(dds, false);
    EXPECT_EQ(refusal.find("a process may have 40 open files (ulimit -n), and this program, which joins 7 DDS domains"),
              0U)
        << refusal;
    EXPECT_NE(refusal.find("`ulimit -n " + std::to_string(ample_open_files(kDomains)) + "`"), std::string::npos)
        << refusal;
    EXPECT_EQ(said(dds, true), "accepted") << "a program that only checks options may fly on another host";
  }
  EXPECT_EQ(said("inproc", false), "accepted") << "the bus inside a process needs no sockets";
}

}  // namespace
}  // namespace skein::bus
