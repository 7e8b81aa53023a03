// The two documents of DDS Security: governance says how a fleet's domains are protected, permissions say what one
// program may do in which of them. Pure text; see docs/security.md.
#pragma once

#include <string>
#include <vector>

#include "cli/run/fleet_plan.hpp"

namespace skein::cli {

/// What one program may do. Within its domains it may read and publish everything but the topics named here.
struct Rights {
  int first_domain = 0, last_domain = 0;
  std::vector<std::string> not_published;  ///< as on the wire
  std::vector<std::string> not_read = {};  ///< these it may not publish either
};

/// Of a program of the fleet: the server may do everything; the router must not speak for the server nor for agents,
/// nor the station for the server or the router; an agent is in its own domain and speaks for itself alone. One at the
/// ground station does not read what tells points by their index (topics::kScoreEval).
Rights rights_of(const FleetPlan& plan, const std::string& program, int base_domain);

/// XML of the permissions of a certificate's owner. @param subject  of its certificate (RFC 2253)
std::string permissions(const std::string& subject, const Rights& rights);

/// XML of the governance of these domains: only those whom the fleet's own authority vouches for take part; all that
/// they say is encrypted, discovery included.
std::string governance(int first_domain, int last_domain);

}  // namespace skein::cli
