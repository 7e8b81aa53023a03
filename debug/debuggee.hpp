// --debug: which programs of a fleet run under a debugger or another tool. This file does not start programs:
// put_under_tool() puts the tool's command line before that of the program.   Threads: any.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/program_host.hpp"

namespace skein::cli {

struct Debuggee {
  enum class How {
    by_hand,    ///< the user starts the program with a command that Skein prints
    gdb,        ///< gdb in this terminal
    inside,     ///< gdb in this terminal, but run in the program's container; the program waits until gdb attaches
    pdb,        ///< Python's debugger in this terminal; the program itself starts it
    gdbserver,  ///< gdbserver on `port` of this host
    wait,       ///< the program stops before its first step until a debugger attaches or SIGCONT arrives
    command     ///< any tool; the program's command line is appended to the tool's
  };
  std::string member;   ///< the name that the user gives: "jurong", "gcs", "sim_server"
  std::string program;  ///< the launcher's name for the member's program: "uav_agent-jurong", "sim_server"
  How how = How::by_hand;
  int port = 0;
  std::vector<std::string> tool;  ///< command line of gdb, gdbserver or the command; empty: none of these
  bool here = false;              ///< the tool, or pdb, has the launcher's terminal

  /// Whether the launcher starts a tool, which then starts the program.
  bool has_tool() const { return !tool.empty(); }
};

/// Parses values of --debug: NAME[=gdb|pdb|gdbserver:PORT|wait|CMD], where NAME is a UAV, gcs, sim_server, comm_router
/// or station.
/// @param program_of  returns the program for a NAME; throws InputError for an unknown one
/// @throws InputError for invalid values, and if a tool is not installed; the message then names the package
std::vector<Debuggee> parse_debug(const std::vector<std::string>& values,
                                  const std::function<std::string(const std::string&)>& program_of);

/// Changes `program` so that the tool starts it, that it waits for a debugger, or that it has the terminal for pdb.
/// Does nothing for `by_hand` and `inside`.
void put_under_tool(ProgramSpec& program, const Debuggee& debuggee);

/// The shell command that attaches gdb to a process.
std::string attach_command(pid_t pid);
/// The shell command that connects gdb to the gdbserver of a program.
std::string connect_command(const Debuggee& debuggee, const std::string& binary);

/// The path of a tool's executable. @param why  begins the error message: "--debug jurong=valgrind"
/// @throws InputError if the tool is neither a file nor in PATH; the message names the package to install.
std::string tool_file(const std::string& tool, const std::string& why);

/// The port in `gdbserver:PORT`; nullopt: `value` is something else. @throws InputError for an invalid or missing port
std::optional<int> gdbserver_port(const std::string& value);

/// gdb's command line, with `more` at its end. gdb loads the pretty-printers for Skein's and Eigen's types if their
/// file exists.
std::vector<std::string> gdb_words(const std::vector<std::string>& more);

}  // namespace skein::cli
