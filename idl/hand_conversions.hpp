// Converts the commands for UAVs that a viewer flies by hand, from and to messages.   Pure; safe from any thread.
#pragma once

#include <optional>

#include "core/messages/hand_command.hpp"
#include "idl/type_names.hpp"

namespace skein {

/// @param tick  of the step from which on it is wanted.
msg::HandCommand to_hand_command(Tick tick, const HandCommand& command);
/// nullopt where a number is not finite.
std::optional<HandCommand> from_hand_command(const msg::HandCommand& message);

}  // namespace skein
