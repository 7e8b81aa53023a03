// What the user wrote after --planners and --seeds, taken apart: of `skein compare` and `skein test`. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace skein::cli {

/// The planners of a list `A,B,...`, each as `skein run --planner` takes it. An item `KEY=VALUE` without a colon goes
/// on with the parameters of the planner before it, which therefore has some (`xxh:faithful=true,teams=2,star` is two
/// planners). "exec:CMD" ends at the next comma.
/// @throws InputError for an empty item, or one with '=' that continues nothing.
std::vector<std::string> split_planners(const std::string& list);

/// A list: `3` is the seed 3, `3,5,8` are three, `1-5` are five, `0,4-6` are four. The one meaning of every option that
/// takes seeds.
/// @throws InputError for anything else, a seed named twice, or more than 1000 of them.
/// @param option  that they were written behind, for messages.
std::vector<std::uint64_t> parse_seeds(const std::string& text, const std::string& option = "--seeds");

/// What a study calls its planners: as they are written, but of the path of each agent (NAME@AGENT) just the last
/// names, no more than tell it from the other agents ("kios@agent"; "kios@a/agent" and "star@b/agent").
std::vector<std::string> planner_labels(const std::vector<std::string>& planners);

/// What a study calls its scenes: by the name of the file, or as it is written where two have the same name.
std::vector<std::string> scene_titles(const std::vector<std::string>& scenarios);

/// A folder's name for each text (planner_label), with "-2", "-3"... after those that came before.
std::vector<std::string> folder_names(const std::vector<std::string>& texts);

}  // namespace skein::cli
