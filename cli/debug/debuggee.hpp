// --debug: which programs of a fleet are debugged, and with which tool. This file does not start programs:
// put_under_tool() changes the command line to that of the tool, with the program's own behind it.   Threads: any.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/host/program_host.hpp"

namespace skein::cli {

struct Debuggee {
  enum class How {
    by_hand,    ///< the user starts the program, with a command that is printed
    gdb,        ///< gdb in this terminal
    inside,     ///< gdb in this terminal, inside the container of the program, which waits for it
    pdb,        ///< Python's debugger, which the program itself starts, in this terminal
    gdbserver,  ///< gdbserver at `port` of this host
    wait,       ///< the program stops before its first step until a debugger attaches, or SIGCONT arrives
    command     ///< any tool; the program's command line is appended to the tool's
  };
  std::string member;   ///< name as the user gives it: "jurong", "gcs", "sim_server"
  std::string program;  ///< the launcher's name for it: "uav_agent-jurong", "sim_server"
  How how = How::by_hand;
  int port = 0;
  std::vector<std::string> tool;  ///< command line of gdb, gdbserver or the command
  bool here = false;              ///< the tool has the launcher's terminal

  /// Whether the launcher starts a tool that starts the program.
  bool has_tool() const { return !tool.empty(); }
};

/// Parses values of --debug: UAV[=gdb|pdb|gdbserver:PORT|wait|CMD].
/// @param program_of  returns the program for a name that the user gives; throws InputError for an unknown name
/// @throws InputError for invalid values, and for a tool that is not installed, with the package to install
std::vector<Debuggee> parse_debug(const std::vector<std::string>& values,
                                  const std::function<std::string(const std::string&)>& program_of);

/// Changes `program` so that its tool starts it, or it waits for a debugger; `by_hand` and `inside` change nothing.
void put_under_tool(ProgramSpec& program, const Debuggee& debuggee);

/// The command that attaches gdb to a process, or connects gdb to the program's gdbserver.
std::string attach_command(pid_t pid);
std::string connect_command(const Debuggee& debuggee, const std::string& binary);

/// The file of a tool. @param why  begins the error message: "--debug jurong=valgrind"
/// @throws InputError when the tool is neither a file nor in PATH, with the package to install.
std::string tool_file(const std::string& tool, const std::string& why);

/// The port in `gdbserver:PORT`; nullopt: `value` is something else. @throws InputError for an invalid or missing port
std::optional<int> gdbserver_port(const std::string& value);

/// gdb's command line, with `more` at its end; loads the printers for Skein's and Eigen's types if they are installed.
std::vector<std::string> gdb_words(const std::vector<std::string>& more);

}  // namespace skein::cli
