#include "bus/fastdds/own_host.hpp"

#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastrtps/utils/IPLocator.h>

#include <utility>

#include "bus/own_host.hpp"

namespace skein::bus::fastdds {

namespace {

using namespace eprosima::fastdds::rtps;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::LocatorsIterator;

constexpr std::size_t kIpv4At = 12;  // in a locator's 16 bytes

/// Leaves everything but addresses to the transport below, its channels too: nothing passes through here.
class OwnHostTransport : public ChainingTransport {
 public:
  using ChainingTransport::ChainingTransport;

  TransportDescriptorInterface* get_configuration() override { return low_level_transport_->get_configuration(); }

  bool transform_remote_locator(const Locator& remote, Locator& result) const override {
    if (!IsLocatorSupported(remote)) return false;
    result = remote;
    if (IPLocator::isMulticast(remote)) return true;
    if (!is_own_address(std::span<const std::uint8_t, 4>(remote.address + kIpv4At, 4))) return false;
    IPLocator::setIPv4(result, 127, 0, 0, 1);
    return true;
  }

  bool OpenOutputChannel(SendResourceList& resources, const Locator& locator) override {
    return low_level_transport_->OpenOutputChannel(resources, locator);
  }
  bool OpenInputChannel(const Locator& locator, TransportReceiverInterface* receiver, std::uint32_t size) override {
    return low_level_transport_->OpenInputChannel(locator, receiver, size);
  }

 private:
  bool send(eprosima::fastrtps::rtps::SenderResource*, const eprosima::fastrtps::rtps::octet*, std::uint32_t,
            LocatorsIterator*, LocatorsIterator*, const std::chrono::steady_clock::time_point&) override {
    return false;  // only asked of channels that were opened here
  }
  void receive(TransportReceiverInterface*, const eprosima::fastrtps::rtps::octet*, std::uint32_t, const Locator&,
               const Locator&) override {}
};

struct OwnHostDescriptor : ChainingTransportDescriptor {
  using ChainingTransportDescriptor::ChainingTransportDescriptor;
  TransportInterface* create_transport() const override { return new OwnHostTransport(*this); }
};

}  // namespace

std::shared_ptr<TransportDescriptorInterface> own_host_transport(std::shared_ptr<TransportDescriptorInterface> udp) {
  return std::make_shared<OwnHostDescriptor>(std::move(udp));
}

}  // namespace skein::bus::fastdds
