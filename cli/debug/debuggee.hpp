// --debug: which programs of a fleet the user looks into, and with what. Nothing here knows how a program is started:
// put_under_tool() turns what is to be started into the tool with the program's command line behind it.   Threads: any.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/host/program_host.hpp"

namespace skein::cli {

struct Debuggee {
  enum class How {
    by_hand,    ///< the user starts it himself, with a command that is printed
    gdb,        ///< in this terminal
    inside,     ///< gdb in this terminal, in the container of a program that waits for it
    pdb,        ///< Python's debugger, which the program itself starts, in this terminal
    gdbserver,  ///< at `port` of this host
    wait,       ///< it stands before its first step until a debugger is attached, or SIGCONT
    command     ///< any tool, with the program's command line behind its own
  };
  std::string member;   ///< as the user calls it: "jurong", "gcs", "sim_server"
  std::string program;  ///< "uav_agent-jurong", "sim_server"
  How how = How::by_hand;
  int port = 0;
  std::vector<std::string> tool;  ///< words of gdb, gdbserver or the command
  bool here = false;              ///< the tool has the launcher's terminal

  /// Whether it is started by the launcher below a tool.
  bool has_tool() const { return !tool.empty(); }
};

/// Takes values of --debug apart: UAV[=gdb|pdb|gdbserver:PORT|wait|CMD].
/// @param program_of  of a name as the user gives it; throws InputError for one that the fleet does not have
/// @throws InputError for what is wrong, and for a tool that is not installed, with the package that has it
std::vector<Debuggee> parse_debug(const std::vector<std::string>& values,
                                  const std::function<std::string(const std::string&)>& program_of);

/// The program is started by its tool, or is told to wait; nothing happens to one that is started by hand.
void put_under_tool(ProgramSpec& program, const Debuggee& debuggee);

/// What to type to look into a process, or to talk to its gdbserver.
std::string attach_command(pid_t pid);
std::string connect_command(const Debuggee& debuggee, const std::string& binary);

/// The file of a tool. @param why  of the message: "--debug jurong=valgrind"
/// @throws InputError when it is neither a file nor in PATH, with the package that has it.
std::string tool_file(const std::string& tool, const std::string& why);

/// A port of `gdbserver:PORT`; nullopt: something else. @throws InputError for a port that is none
std::optional<int> gdbserver_port(const std::string& value);

/// gdb, taught our types and Eigen's where the file for that is there.
std::vector<std::string> gdb_words(const std::vector<std::string>& more);

}  // namespace skein::cli
