// Docker, as its command line offers it: an engine that answers, and one fleet's containers and networks.
// Threads: one, which must live as long as the containers.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace skein::cli {

/// @throws InputError when no engine answers, when there is no docker-compose, or an image is missing; it says what
///   helps.
void check_engine(const std::vector<std::string>& images);

/// @param member  whose program --debug wants to look into. @throws InputError when the image has no gdb
void check_gdb(const std::string& image, const std::string& member);

/// While it lives, the containers of a file exist, under a project's name that nobody else has.
class ComposeProject {
 public:
  /// @param file  for docker-compose. @param log  file for what it says. @param err  for people; must outlive this.
  /// @throws InputError when there is no docker-compose
  ComposeProject(std::filesystem::path file, std::string name, std::filesystem::path log, std::ostream& err);
  /// Ends the containers and removes them, their networks and volumes; when it cannot, it says how to do that.
  ~ComposeProject();
  ComposeProject(const ComposeProject&) = delete;
  ComposeProject& operator=(const ComposeProject&) = delete;

  /// Makes networks and containers, and starts them. @throws std::runtime_error with the reason.
  void up();
  /// Containers by service.
  std::map<std::string, std::string> containers() const;

 private:
  /// A command of docker-compose on it.
  std::string command(const std::string& what) const;

  const std::string program_;
  const std::filesystem::path file_;
  const std::string name_;
  const std::filesystem::path log_;
  std::ostream& err_;
};

}  // namespace skein::cli
