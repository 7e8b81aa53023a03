#include "sim_server/flight/vehicle_faults.hpp"

#include <algorithm>
#include <variant>

namespace skein::sim {
namespace {

/// Enters a fault of a vehicle into that vehicle's VehicleCondition, and ignores all other faults.
class Applier {
 public:
  /// @param begin  tick at which the fault began.
  Applier(const std::vector<std::string>& uavs, std::vector<VehicleCondition>& conditions, Tick begin)
      : uavs_(uavs), conditions_(conditions), begin_(begin) {}

  void operator()(const LidarFailure& fault) const { of(fault.uav).lidar_works = false; }
  void operator()(const CameraFailure& fault) const { of(fault.uav).camera_works = false; }
  void operator()(const MotorFailure& fault) const {
    of(fault.uav).rotor_shares.at(static_cast<std::size_t>(fault.rotor)) = fault.thrust;
  }
  void operator()(const CommandDelay& fault) const { of(fault.uav).command_delay = fault.exchanges; }
  void operator()(const OdometryFreeze& fault) const { of(fault.uav).odometry_frozen = true; }
  void operator()(const OdometryJump& fault) const { of(fault.uav).odometry_offset_m = fault.offset_m; }
  void operator()(const StuckGimbal& fault) const { of(fault.uav).gimbal_works = false; }
  void operator()(const Gust& fault) const { of(fault.uav).gust_W = fault.velocity_mps; }
  void operator()(const FixLoss& fault) const { of(fault.uav).fix_lost = true; }
  void operator()(const BatteryLoss& fault) const {
    of(fault.uav).most_charge = fault.charge;
    of(fault.uav).charge_lost = begin_;
  }
  template <class OtherFault>
  void operator()(const OtherFault&) const {}

 private:
  VehicleCondition& of(const std::string& uav) const {
    const auto found = std::find(uavs_.begin(), uavs_.end(), uav);
    return conditions_.at(static_cast<std::size_t>(found - uavs_.begin()));
  }

  const std::vector<std::string>& uavs_;
  std::vector<VehicleCondition>& conditions_;
  const Tick begin_;
};

}  // namespace

std::vector<VehicleCondition> vehicle_conditions(const FaultPlan& plan, const std::vector<std::string>& uavs,
                                                 Tick tick) {
  std::vector<VehicleCondition> conditions(uavs.size());
  for (const Fault& fault : plan.faults) {
    if (fault.active(tick)) std::visit(Applier(uavs, conditions, fault.begin()), fault.action);
  }
  return conditions;
}

}  // namespace skein::sim
