#include "bus/fastdds/transports.hpp"

#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastrtps/utils/IPLocator.h>

#include <utility>

#include "bus/own_host.hpp"

namespace skein::bus::fastdds {

namespace {

using namespace eprosima::fastdds::rtps;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::LocatorsIterator;

constexpr std::size_t kIpv4At = 12;  // offset in a locator's 16 bytes

/// Forwards all calls to the lower transport, including the creation of channels: no data passes through this object.
class OpenTransport : public ChainingTransport {
 public:
  using ChainingTransport::ChainingTransport;

  TransportDescriptorInterface* get_configuration() override { return low_level_transport_->get_configuration(); }
  bool OpenOutputChannel(SendResourceList& resources, const Locator& locator) override {
    return low_level_transport_->OpenOutputChannel(resources, locator);
  }
  bool OpenInputChannel(const Locator& locator, TransportReceiverInterface* receiver, std::uint32_t size) override {
    return low_level_transport_->OpenInputChannel(locator, receiver, size);
  }

 private:
  bool send(eprosima::fastrtps::rtps::SenderResource*, const eprosima::fastrtps::rtps::octet*, std::uint32_t,
            LocatorsIterator*, LocatorsIterator*, const std::chrono::steady_clock::time_point&) override {
    return false;  // called only for channels that this object opened: none
  }
  void receive(TransportReceiverInterface*, const eprosima::fastrtps::rtps::octet*, std::uint32_t, const Locator&,
               const Locator&) override {}
};

/// Changes addresses (own_host_transport()); leaves all else to the lower transport.
class OwnHostTransport : public OpenTransport {
 public:
  using OpenTransport::OpenTransport;

  bool transform_remote_locator(const Locator& remote, Locator& result) const override {
    if (!IsLocatorSupported(remote)) return false;
    result = remote;
    if (IPLocator::isMulticast(remote)) return true;
    if (!is_own_address(std::span<const std::uint8_t, 4>(remote.address + kIpv4At, 4))) return false;
    IPLocator::setIPv4(result, 127, 0, 0, 1);
    return true;
  }
};

struct OwnHostDescriptor : ChainingTransportDescriptor {
  using ChainingTransportDescriptor::ChainingTransportDescriptor;
  TransportInterface* create_transport() const override { return new OwnHostTransport(*this); }
};

/// Limits the size of sent datagrams; the lower transport limits that of received ones.
struct PacketDescriptor : ChainingTransportDescriptor {
  PacketDescriptor(std::shared_ptr<TransportDescriptorInterface> udp, std::uint32_t largest)
      : ChainingTransportDescriptor(std::move(udp)), largest_(largest) {}
  TransportInterface* create_transport() const override { return new OpenTransport(*this); }
  std::uint32_t max_message_size() const override { return largest_; }

 private:
  const std::uint32_t largest_;
};

}  // namespace

std::shared_ptr<TransportDescriptorInterface> own_host_transport(std::shared_ptr<TransportDescriptorInterface> udp) {
  return std::make_shared<OwnHostDescriptor>(std::move(udp));
}

std::shared_ptr<TransportDescriptorInterface> packet_transport(std::shared_ptr<TransportDescriptorInterface> udp,
                                                               std::size_t largest) {
  return std::make_shared<PacketDescriptor>(std::move(udp), static_cast<std::uint32_t>(largest));
}

}  // namespace skein::bus::fastdds
