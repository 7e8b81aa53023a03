// Checks of a scenario's section `conditions` beyond those of single values: keys that have no effect.  Pure.
#pragma once

#include "core/config/config_node.hpp"
#include "core/config/config_reader.hpp"
#include "core/scenario/conditions.hpp"

namespace skein {

/// Whether a section of a file has a key that acts only if the section is on: one that is neither `preset` nor
/// `body_drag_area_m2`, which acts in gusts (a fault) without wind, too.
bool sets_condition(const ConfigNode& section);

/// Adds an error for each key of the file that has no effect because its section is off: the mean wind is 0, there are
/// no batteries, and so on. A section may be off if it has the key that would switch it on, so that users can vary this
/// key alone.
/// @param document  the scenario's file @param conditions  those of the file, without the option `--conditions`
void check_conditions(const ConfigDocument& document, const ConditionsConfig& conditions, double exchange_period_s,
                      ConfigErrors& errors);

}  // namespace skein
