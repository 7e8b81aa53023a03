// The two documents of DDS Security: governance says how a fleet's domains are protected, permissions say what one
// program may do in which of them. Pure text; see docs/security.md.
#pragma once

#include <string>
#include <vector>

#include "run/fleet_plan.hpp"

namespace skein::cli {

/// What one program may do. Within its domains it may read and publish all topics except those named here.
struct Rights {
  int first_domain = 0, last_domain = 0;
  std::vector<std::string> not_published;  ///< topic names on the wire
  std::vector<std::string> not_read = {};  ///< it may not publish these either
};

/// The rights of a program of the fleet. sim_server may do everything. comm_router must not publish topics of
/// sim_server, agents or the station; the station must not publish those of sim_server or comm_router. An agent joins
/// only its own domain, and publishes only its own topics. Agents, also at the ground station, cannot read
/// topics::kScoreEval, which has the points' indices in the scene.
Rights rights_of(const FleetPlan& plan, const std::string& program, int base_domain);

/// XML of the permissions of a certificate's owner. @param subject  subject of the certificate (RFC 2253)
std::string permissions(const std::string& subject, const Rights& rights);

/// XML of the governance of these domains: only participants with a certificate of the fleet's own authority can join;
/// all that they send is encrypted, discovery included.
std::string governance(int first_domain, int last_domain);

}  // namespace skein::cli
