// `skein doctor`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace skein::cli {

struct DoctorOptions {
  bool net = false;  ///< test which hosts receive each other's messages, instead of this machine's settings
  std::string scenario = "towers";
  std::optional<std::filesystem::path> assets;
  std::string dds = "cyclonedds";  ///< a vendor or "mixed"
  std::optional<int> domain;
  std::optional<std::string> network;  ///< as in RunOptions
  std::filesystem::path out = "runs";  ///< folder in which results would be written
  bool json = false;
  std::optional<std::string> name;  ///< name of this host
  std::vector<std::string> only;    ///< domains to test; empty: all that reach other hosts
  std::optional<double> seconds;    ///< how long to send and listen [s]
};

/// Adds the command `doctor`, whose options CLI11 parses into the second argument.
void add_doctor(CLI::App& app, DoctorOptions& doctor);

/// `skein doctor`: runs the program skein_doctor, which prints settings of this machine or network that would hinder a
/// fleet. It gets the user's own environment, because it checks that too.
/// @returns its exit code: kExitDone, kExitCheckFailed, or kExitBadInput after it has printed what is wrong.
int consult_doctor(const DoctorOptions& options);

}  // namespace skein::cli
