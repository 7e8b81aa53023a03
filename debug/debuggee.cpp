#include "debug/debuggee.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "core/config/config_files.hpp"
#include "core/files/command_file.hpp"
#include "core/text/text.hpp"
#include "core/text/whole_number.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

using How = Debuggee::How;
using Words = std::vector<std::string>;

constexpr int kHighestPort = 65535;

/// The Debian package of a tool; most have the tool's name.
std::string package_of(const std::string& tool) {
  static const std::map<std::string, std::string> others = {{"perf", "linux-perf"}};
  const auto found = others.find(tool);
  return found == others.end() ? tool : found->second;
}

void set_variable(Words& environment, const std::string& name, const std::string& value) {
  std::erase_if(environment, [&](const std::string& entry) { return entry.starts_with(name + "="); });
  environment.push_back(name + "=" + value);
}

/// gdb passes the arguments to a shell, so the program writes to its log as always, and gdb to the terminal. gdb's exit
/// code is the program's, unless the user leaves gdb before the program has ended.
void put_under_gdb(ProgramSpec& program, const Words& tool) {
  const std::string arguments =
      shell_line(Words(program.argv.begin() + 1, program.argv.end())) + " >>" + shell_word(program.log) + " 2>&1";
  const std::string binary = program.argv[0];
  program.argv = tool;
  program.argv.insert(program.argv.end(), {"-ex", "set args " + arguments, binary});
  set_variable(program.env, "SHELL", "/bin/sh");
}

/// The terminal is for pdb and for what the planner prints; what the program logs goes to its log as always.
void put_under_pdb(ProgramSpec& program) {
  program.here = program.minded = true;
  const std::string redirected = "exec \"$@\" 2>>" + shell_word(program.log);
  program.argv.insert(program.argv.begin(), {"/bin/sh", "-c", redirected, "sh"});
}

}  // namespace

std::vector<Debuggee> parse_debug(const Words& values,
                                  const std::function<std::string(const std::string&)>& program_of) {
  std::vector<Debuggee> debuggees;
  std::set<std::string> seen;
  for (const std::string& value : values) {
    const std::size_t cut = value.find('=');
    Debuggee one;
    one.member = value.substr(0, cut);
    one.program = program_of(one.member);
    const std::string why = "--debug " + value, how = cut == std::string::npos ? "" : value.substr(cut + 1);
    if (!seen.insert(one.program).second) throw InputError(why + ": " + one.member + " is named twice");
    if (cut == std::string::npos) {
      const bool flies = one.program != one.member;  // an agent; only the launcher can start a server
      one.how = flies ? How::by_hand : How::wait;
    } else if (how == "gdb") {
      one.how = How::gdb;
      one.tool = gdb_words({"--return-child-result"});
    } else if (how == "pdb") {
      one.how = How::pdb;
    } else if (how == "wait") {
      one.how = How::wait;
    } else if (const auto port = gdbserver_port(how)) {
      one.how = How::gdbserver;
      one.port = *port;
      one.tool = {"gdbserver", "--no-startup-with-shell", "--once", "127.0.0.1:" + std::to_string(*port)};
    } else {
      one.how = How::command;
      one.tool = shell_words(how);
      if (one.tool.empty()) throw InputError(why + ": name a tool: gdb, gdbserver:PORT, wait or a command");
    }
    if (one.has_tool()) one.tool[0] = tool_file(one.tool[0], why);
    debuggees.push_back(one);
  }
  const auto wants_terminal = [](const Debuggee& one) { return one.how == How::gdb || one.how == How::pdb; };
  if (std::ranges::count_if(debuggees, wants_terminal) > 1) {
    throw InputError("--debug: one gdb or pdb can have this terminal; give the others gdbserver:PORT or wait");
  }
  auto first = std::ranges::find_if(debuggees, wants_terminal);
  if (first == debuggees.end()) first = std::ranges::find(debuggees, How::command, &Debuggee::how);
  if (first != debuggees.end()) first->here = true;
  return debuggees;
}

void put_under_tool(ProgramSpec& program, const Debuggee& debuggee) {
  if (debuggee.how == How::wait) program.argv.push_back("--wait-for-debugger");
  if (debuggee.how == How::pdb) put_under_pdb(program);
  if (!debuggee.has_tool()) return;
  program.minded = true;
  program.here = debuggee.here;
  if (debuggee.how == How::gdb) {
    put_under_gdb(program, debuggee.tool);
  } else {
    program.argv.insert(program.argv.begin(), debuggee.tool.begin(), debuggee.tool.end());
  }
}

Words gdb_words(const Words& more) {
  Words words = {"gdb", "-q"};
  const std::filesystem::path printers = default_config_dir() / "gdb" / "skein_printers.py";
  if (std::filesystem::exists(printers)) words.insert(words.end(), {"-x", std::filesystem::absolute(printers)});
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::string attach_command(pid_t pid) { return shell_line(gdb_words({"-p", std::to_string(pid)})); }

std::string connect_command(const Debuggee& debuggee, const std::string& binary) {
  return shell_line(gdb_words({"-ex", "target remote 127.0.0.1:" + std::to_string(debuggee.port), binary}));
}

std::string tool_file(const std::string& tool, const std::string& why) {
  const std::string file = command_file(tool);
  if (!file.empty()) return file;
  const std::string name = std::filesystem::path(tool).filename();
  throw InputError(why + ": there is no " + tool + " here; apt-get install " + package_of(name));
}

std::optional<int> gdbserver_port(const std::string& value) {
  const std::string prefix = "gdbserver";
  if (value != prefix && !value.starts_with(prefix + ":")) return std::nullopt;
  const std::string text = value == prefix ? "" : value.substr(prefix.size() + 1);
  const auto port = parse_whole<int>(text);
  if (!port || *port < 1 || *port > kHighestPort) {
    throw InputError("'" + value + "': must be gdbserver:PORT with a port within [1, 65535]");
  }
  return port;
}

}  // namespace skein::cli
