// `skein doctor`: what of this machine is in a fleet's way, and how to mend it.
#pragma once

#include <filesystem>
#include <optional>

#include "core/scenario.hpp"
#include "doctor/finding.hpp"

namespace skein::doctor {

struct Visit {
  std::size_t uavs = 0;
  std::vector<std::string> domains{};  ///< their names, in their order
  NetworkConfig network{};
  std::optional<int> base{};  ///< --domain
  std::filesystem::path results = "runs";
};

/// Looks at all. Names of peers are asked for once. @throws nothing that a machine could be the reason of
Findings examine(const Visit& visit);

}  // namespace skein::doctor
