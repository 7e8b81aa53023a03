// The reports of a hunt with known outcomes: the page for people, and JUnit XML for CI servers.
#include "cli/hunt/report.hpp"

#include <gtest/gtest.h>

#include <pugixml.hpp>

#include "host/testing/fake_programs.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;
using Outcome = properties::Verdict::Outcome;

class HuntReports : public testing::Test {
 protected:
  HuntReports() {
    HuntOptions hunt;
    hunt.run.scenario = programs_.scenario().string();
    hunt.run.planner = "hover";
    hunt.run.duration_s = 120.0;
    hunt.run.command = "skein hunt <here> & there";
    hunt.dds = "cyclonedds";
    hunt.out = programs_.dir() / "hunt";
    hunt.junit = programs_.dir() / "hunt.xml";
    plan_.emplace(plan_hunt(hunt));
    fs::create_directories(plan_->out);
  }
  static std::optional<TrialOutcome> outcome(const std::string& property, Outcome what, double margin) {
    TrialOutcome one;
    one.findings = {{kCompletes, Outcome::holds, {}, 0.0, ""}, {property, what, margin, 3.0, "told"}};
    return one;
  }
  /// Writes the reports of a hunt, with or without the find of a case that broke `separation`.
  void write(bool with_find) {
    const std::vector<std::optional<TrialOutcome>> outcomes = {
        outcome("separation", Outcome::holds, 2.5), outcome("separation", Outcome::fails, -0.25),
        outcome("clearance", Outcome::holds, 1.5), outcome("separation", Outcome::fails, -9.0)};
    std::vector<Find> finds(with_find ? 1 : 0);
    for (Find& find : finds) {
      find.name = "separation-1";
      find.broke = find.property = "separation";
      find.index = 1;
      find.trial = {plan_->fleet.options, {{3.0, 4.0, Kill{}}}};
      find.told = "two came <too> near";
      find.flights = 12;
      find.capsule = plan_->out / "finds" / "separation-1.yaml";
      find.run = plan_->out / "finds" / "separation-1";
    }
    const std::map<std::string, std::size_t> failures{{"separation", 1}};
    write_hunt_report({*plan_, outcomes, 3, 7, finds, failures});  // the last case does not count
  }
  pugi::xml_node case_of(const std::string& property) {
    EXPECT_TRUE(xml_.load_file((programs_.dir() / "hunt.xml").c_str()));
    return xml_.child("testsuites").child("testsuite").find_child_by_attribute("name", property.c_str());
  }
  std::string page() const { return read_text(plan_->out / "report.html"); }

  const FakePrograms programs_;
  std::optional<HuntPlan> plan_;
  pugi::xml_document xml_;
};

TEST_F(HuntReports, JUnitHasACaseForEachPropertyWithItsNumbersAndCapsules) {
  write(true);
  const pugi::xml_node failed = case_of("separation");
  const std::string message = failed.child("failure").attribute("message").value();
  EXPECT_NE(message.find("finds/separation-1.yaml: two came <too> near"), std::string::npos) << message;
  EXPECT_NE(std::string(failed.child("system-out").text().get())
                .find("held in 1 runs, vacuous in 1, failed in 1; least margin -0.25 in case 1"),
            std::string::npos);
  EXPECT_FALSE(case_of("clearance").child("failure"));
  const pugi::xml_node suite = xml_.child("testsuites").child("testsuite");
  EXPECT_EQ(suite.attribute("tests").as_uint(), plan_->entries.size() + 1)
      << "one more test: whether runs came to their end";
  EXPECT_EQ(suite.attribute("failures").as_uint(), 1U);
}

// A hunt that was stopped before it examined a failure has no capsule of it. The property has failed all the same.
TEST_F(HuntReports, JUnitHasAFailureAlsoForAPropertyWithoutACapsule) {
  write(false);
  const std::string message = case_of("separation").child("failure").attribute("message").value();
  EXPECT_NE(message.find("failed in 1"), std::string::npos) << message;
}

TEST_F(HuntReports, ThePageHasFindsAndNumbersAndEscapesQuotedTexts) {
  write(true);
  const std::string html = page();
  for (const char* part : {"3 runs, 1 finds, 7 states of the fleet", "skein hunt &lt;here&gt; &amp; there",
                           "two came &lt;too&gt; near", "Found in case 1, minimised with 12 flights",
                           "<a href=\"finds/separation-1.yaml\">Capsule</a>", "custody_kept (vacuous)"}) {
    EXPECT_NE(html.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(html.find("<script"), std::string::npos);
  write(false);
  EXPECT_NE(page().find("<p>None.</p>"), std::string::npos);
}

}  // namespace
}  // namespace skein::cli
