// Damaged configuration is either refused with InputError or read: no crash, no other exception. The damage is drawn
// with a fixed seed, so that a failure is repeatable.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/math/random_stream.hpp"
#include "core/scenario/scenario_keys.hpp"
#include "tests/support/places.hpp"
#include "tests/support/text_files.hpp"

namespace skein {
namespace {

namespace fs = std::filesystem;

std::size_t below(RandomStream& random, std::size_t limit) { return limit == 0 ? 0 : random.bits() % limit; }

/// Damages a text once: changes a byte, truncates it, repeats or moves a piece, or inserts a piece of YAML's syntax.
void damage(RandomStream& random, std::string& text) {
  static const std::vector<std::string> pieces = {":",         "\n",    "- ",    "[",    "]",  "{",     "}",  "\"",
                                                  "'",         "&a ",   "*a",    "!!x ", "? ", "| ",    "> ", "#",
                                                  "%YAML 9\n", "---\n", "...\n", "\t",   "  ", "1e999", "-",  ".nan",
                                                  "~",         "\xff",  "<<: ",  "@",    "`",  "\\",    ","};
  const std::size_t at = below(random, text.size());
  const std::size_t length = below(random, 40);
  switch (below(random, 6)) {
    case 0:
      if (!text.empty()) text[at] = static_cast<char>(random.bits());
      break;
    case 1:
      text.resize(at);
      break;
    case 2:
      text.erase(at, length);
      break;
    case 3:
      text.insert(below(random, text.size()), text.substr(at, length));
      break;
    default:
      text.insert(at, pieces[below(random, pieces.size())]);
  }
}

/// Calls `load`, which may throw only InputError.
void expect_harmless(const std::string& text, const auto& load) {
  try {
    load(parse_config_document(text, "damaged"));
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("damaged")) << error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what() << "\nfrom:\n" << text;
  }
}

void fuzz(const fs::path& file, const auto& load) {
  constexpr int kRounds = 1500;
  const std::string original = read_text(file);
  ASSERT_FALSE(original.empty());
  for (int round = 0; round < kRounds; ++round) {
    RandomStream random(1, "config_fuzz", file.filename().string(), static_cast<std::uint64_t>(round));
    std::string text = original;
    const std::size_t damages = 1 + below(random, 4);
    for (std::size_t i = 0; i < damages; ++i) damage(random, text);
    expect_harmless(text, load);
  }
}

TEST(ConfigFuzz, ADamagedScenarioIsReadOrRefused) {
  for (const char* name : {"towers.yaml", "mbs.yaml"}) {
    fuzz(source_path("config/scenarios") + "/" + name,
         [](const ConfigDocument& document) { read_config<ScenarioFile>(document); });
  }
}

TEST(ConfigFuzz, ADamagedVehicleIsReadOrRefused) {
  fuzz(source_path("config/vehicles/explorer.yaml"),
       [](const ConfigDocument& document) { read_config<VehicleConfig>(document); });
}

/// The whole loader with its cross-checks. It reads a file, which is slow, so there are only a few rounds.
TEST(ConfigFuzz, ADamagedScenarioFileIsReadOrRefusedByTheWholeLoader) {
  const fs::path copy = fs::path(::testing::TempDir()) / "skein_config_fuzz.yaml";
  const std::string original = read_text(source_path("config/scenarios/mbs.yaml"));
  LoadOptions options;
  options.config_dir = source_path("config");
  options.needs_scene_files = false;
  for (std::uint64_t round = 0; round < 200; ++round) {
    RandomStream random(1, "config_fuzz", "file", round);
    std::string text = original;
    damage(random, text);
    std::ofstream(copy) << text;
    try {
      load_scenario(copy.string(), options);
    } catch (const InputError&) {
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what() << "\nfrom:\n" << text;
    }
  }
  fs::remove(copy);
}

TEST(ConfigFuzz, APrintedDocumentReadsBackTheSame) {
  const std::string original = read_text(source_path("config/vehicles/photographer.yaml"));
  for (std::uint64_t round = 0; round < 1000; ++round) {
    RandomStream random(2, "config_fuzz", "print", round);
    std::string text = original;
    damage(random, text);
    ConfigDocument document;
    try {
      document = parse_config_document(text, "damaged");
    } catch (const InputError&) {
      continue;
    }
    const std::string printed = to_yaml(document.root);
    ASSERT_EQ(to_yaml(parse_config_document(printed, "printed").root), printed) << "from:\n" << text;
  }
}

}  // namespace
}  // namespace skein
