// Converts the commands for UAVs that a viewer flies by hand to messages and back.   Pure; safe from any thread.
#pragma once

#include <optional>

#include "core/messages/hand_command.hpp"
#include "idl/type_names.hpp"

namespace skein {

/// @param tick  of the step from which on the command applies.
msg::HandCommand to_hand_command(Tick tick, const HandCommand& command);
/// nullopt if a number is not finite.
std::optional<HandCommand> from_hand_command(const msg::HandCommand& message);

}  // namespace skein
