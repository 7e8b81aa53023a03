// Runs Docker by its command line: checks the engine, and holds the containers and networks of one fleet.
// Threads: one, which must live as long as the containers.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace skein::cli {

/// @throws InputError, with a remedy, when no engine answers, there is no docker-compose, or an image is missing.
void check_engine(const std::vector<std::string>& images);

/// @param member  the member that --debug names. @throws InputError when the image has no gdb
void check_gdb(const std::string& image, const std::string& member);

/// Holds the containers of a compose file, from up() on, under a unique project name. The destructor removes them.
class ComposeProject {
 public:
  /// @param file  for docker-compose. @param log  receives docker-compose's output. @param err  receives messages for
  ///   the user; must outlive this.
  /// @throws InputError when there is no docker-compose
  ComposeProject(std::filesystem::path file, std::string name, std::filesystem::path log, std::ostream& err);
  /// Ends and removes the containers, their networks and volumes. If that fails, prints the command for it.
  ~ComposeProject();
  ComposeProject(const ComposeProject&) = delete;
  ComposeProject& operator=(const ComposeProject&) = delete;

  /// Creates networks and containers, and starts the containers. @throws std::runtime_error with the reason.
  void up();
  /// Container ids, by service.
  std::map<std::string, std::string> containers() const;
  /// When each container was last started, by its id; empty if the engine does not say it.
  static std::map<std::string, std::string> starts(const std::map<std::string, std::string>& containers);
  /// For each container that was started again since `starts`, appends its later output to its log: the follower of
  /// the container has ended by then. @param folder  of the logs. @param foreign  services whose stdout belongs to the
  /// log, too
  static void add_later_logs(const std::map<std::string, std::string>& containers,
                             const std::map<std::string, std::string>& starts, const std::filesystem::path& folder,
                             const std::set<std::string>& foreign);

 private:
  /// The command line of a docker-compose command for this project.
  std::string command(const std::string& what) const;

  const std::string program_;
  const std::filesystem::path file_;
  const std::string name_;
  const std::filesystem::path log_;
  std::ostream& err_;
};

}  // namespace skein::cli
