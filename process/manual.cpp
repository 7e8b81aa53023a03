#include "process/manual.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

namespace skein {
namespace {

/// Escapes text for roff, so that hyphens, quotes and accents appear as they were typed.
std::string roff(const std::string& text) {
  std::string result;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && c == '.') result += "\\&";
    switch (c) {
      case '\\':
        result += "\\e";
        break;
      case '-':
        result += "\\-";
        break;
      case '\'':
        result += "\\(aq";
        break;
      case '`':
        result += "\\(ga";
        break;
      case '^':
        result += "\\(ha";
        break;
      case '~':
        result += "\\(ti";
        break;
      default:
        result += c;
    }
    line_begins = c == '\n';
  }
  return result;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }

/// "-v, --verbose", or a positional's name.
std::string option_name(const CLI::Option& option) {
  if (option.get_positional()) return bold(option.get_name(true));
  std::string names;
  for (const std::string& name : option.get_snames()) names += (names.empty() ? "" : ", ") + bold("-" + name);
  for (const std::string& name : option.get_lnames()) names += (names.empty() ? "" : ", ") + bold("--" + name);
  return names;
}

void write_options(std::ostream& page, const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // hidden
    page << ".TP\n"
         << option_name(*option) << roff(CLI::Formatter().make_option_opts(option)) << '\n'
         << roff(option->get_description()) << '\n';
  }
}

/// "skein run [OPTIONS] [SCENARIO]".
std::string usage(const CLI::App& app, const std::string& name, bool has_commands) {
  std::string line = bold(name) + " [OPTIONS]";
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) line += " " + roff(CLI::Formatter().make_option_usage(option));
  }
  return line + (has_commands ? " COMMAND" : "");
}

void write_footer(std::ostream& page, const CLI::App& app) {
  if (!app.get_footer().empty()) page << ".PP\n.nf\n" << roff(app.get_footer()) << "\n.fi\n";
}

}  // namespace

std::string manual_of(const CLI::App& app, const std::string& name) {
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  std::string about = app.get_description(), upper = name;
  if (const std::size_t colon = about.find(": "); colon != std::string::npos) about.erase(0, colon + 2);
  if (about.ends_with('.')) about.pop_back();
  std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });

  std::ostringstream page;
  page << ".TH " << roff(upper) << " 1 \"\" \"skein " SKEIN_VERSION "\" \"User Commands\"\n"
       << ".SH NAME\n"
       << roff(name) << " \\- " << roff(about) << "\n.SH SYNOPSIS\n"
       << usage(app, name, !commands.empty()) << "\n.SH OPTIONS\n";
  write_options(page, app);
  if (!commands.empty()) page << ".SH COMMANDS\n";
  for (const CLI::App* command : commands) {
    page << ".SS " << usage(*command, name + " " + command->get_name(), false) << '\n'
         << roff(command->get_description()) << ".\n";
    write_options(page, *command);
    write_footer(page, *command);
  }
  if (!app.get_footer().empty()) page << ".SH EXAMPLES\n";
  write_footer(page, app);
  return page.str();
}

}  // namespace skein
