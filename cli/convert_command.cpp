#include "cli/convert_command.hpp"

#include <CLI/CLI.hpp>

#include "cli/fault_tests/conversion.hpp"
#include "cli/fault_tests/fault_test.hpp"
#include "process/files/atomic_file.hpp"
#include "process/program.hpp"

namespace skein::cli {
namespace {

void convert_file(const std::filesystem::path& file, bool in_place, const Console& console) {
  const ConfigDocument document = read_config_document(file);
  const std::string text = converted(document);
  if (!in_place) {
    console.out << text << std::flush;
    return;
  }
  if (text != document.text) write_file_atomically(file, text);
  console.out << file.string() << ": " << (text == document.text ? "nothing to convert" : "converted") << std::endl;
}

}  // namespace

void add_convert(CLI::App& app, ConvertOptions& convert) {
  CLI::App* command = app.add_subcommand("convert", "Convert fault tests of earlier versions for this version");
  command->add_option("FILE", convert.files, "Fault test, or a folder of them")->required();
  command->add_flag("--in-place", convert.in_place, "Rewrite the files (default: print their new text)");
  command->footer(
      "Examples:\n"
      "  skein convert my_tests/outage.yaml\n"
      "  skein convert --in-place my_tests\n\n"
      "Keys of `expect` that became properties are converted (docs/how-to-test-faults.md).");
}

int convert_files(const ConvertOptions& options, const Console& console) {
  for (const std::filesystem::path& path : options.files) {
    for (const std::filesystem::path& file : fault_test_files(path)) convert_file(file, options.in_place, console);
  }
  return kExitDone;
}

}  // namespace skein::cli
