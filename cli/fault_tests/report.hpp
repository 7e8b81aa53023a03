// The reports of fault tests: lines for people, JUnit XML for CI servers. Pure.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace skein::cli {

/// The outcome of one test.
struct FaultVerdict {
  std::string name;            ///< with the seed, where each is flown with several
  std::filesystem::path file;  ///< as the user named it
  bool flown = false;
  std::vector<std::string> broken;   ///< a sentence for each expectation or property that does not hold
  std::vector<std::string> held;     ///< and for each that does
  std::vector<std::string> vacuous;  ///< and for each property that the run says nothing of
  std::filesystem::path results;
  double wall_s = 0.0;  ///< of all its flights

  bool passed() const { return flown && broken.empty(); }
};

/// "PASS name", or "FAIL name" with what does not hold below. @param verbose  what holds, too
void print_verdict(std::ostream& out, const FaultVerdict& verdict, bool verbose);

/// One test suite with a case for each verdict, in their order; those that were not flown are skipped.
std::string junit_xml(const std::string& suite, const std::vector<FaultVerdict>& verdicts);

}  // namespace skein::cli
