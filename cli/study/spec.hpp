// Parses the values of --planners and of options that take seeds, and derives names of planners and scenes. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace skein::cli {

/// The planners of a list `A,B,...`, each as `skein run --planner` takes it. An item `KEY=VALUE` without a colon is
/// another parameter of the planner before it, which must already have one (`xxh:faithful=true,teams=2,star` is two
/// planners). The command of "exec:CMD" ends at the next comma.
/// @throws InputError for an empty item, or an item `KEY=VALUE` that does not follow a planner with parameters.
std::vector<std::string> split_planners(const std::string& list);

/// Seeds from a list: `3` is the seed 3, `3,5,8` are three seeds, `1-5` are five, `0,4-6` are four. All options that
/// take seeds use this syntax. @param option  the option's name, for messages.
/// @throws InputError for anything else, for a seed that is named twice, and for more than 1000 seeds.
std::vector<std::uint64_t> parse_seeds(const std::string& text, const std::string& option = "--seeds");

/// Names of planners in a study: as the user wrote them, but of the path of an agent (NAME@AGENT) only the last parts,
/// as many as distinguish it from the other agents: "kios@agent", or "kios@a/agent" and "star@b/agent".
std::vector<std::string> planner_labels(const std::vector<std::string>& planners);

/// Names of scenes in a study: the file's name without extension, or the whole text if two files have the same name.
std::vector<std::string> scene_titles(const std::vector<std::string>& scenarios);

/// A name for the folder of each text: its planner_label(), with "-2", "-3" and so on appended if it is taken.
std::vector<std::string> folder_names(const std::vector<std::string>& texts);

}  // namespace skein::cli
