// Judges the facts about other software (doctor/software_facts.hpp) for a fleet.   Pure; safe from any thread.
#pragma once

#include "doctor/finding.hpp"
#include "doctor/software_facts.hpp"

namespace skein::doctor {

Finding judge_shared_memory(const SharedMemoryFacts& memory);
/// Two findings: variables that a fleet ignores, and DDS libraries.
Findings judge_variables(const VariableFacts& variables);
Finding judge_docker(const DockerFacts& docker);

}  // namespace skein::doctor
