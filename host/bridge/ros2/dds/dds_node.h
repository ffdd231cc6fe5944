// A participant of Cyclone DDS with topics as ROS 2 makes them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "host/bridge/ros2/dds/topics.h"

#include "dds/dds.h"

namespace edgescout::ros2 {

// The fields of rmw_qos_profile_t that differ between topics.
struct Qos {
  bool is_reliable = true;          // false: as sensor data, "best effort"
  bool is_transient_local = false;  // late readers get the last messages
  int depth = 10;
};

class DdsWriter {
 public:
  DdsWriter() = default;
  explicit DdsWriter(dds_entity_t entity) : entity_(entity) {}
  // `wire`: of the writer's type. False: nobody could take it in time, or no memory.
  bool write(const void* wire) const { return dds_write(entity_, wire) >= 0; }
  bool has_readers() const;

 private:
  dds_entity_t entity_ = 0;
};

class DdsReader {
 public:
  explicit DdsReader(dds_entity_t entity = 0) : entity_(entity) {}
  std::uint32_t writers() const;               // that send to it at present
  std::uint64_t lost() const;                  // messages that were sent and never came
  std::uint32_t incompatible_writers() const;  // whose QoS keeps them apart
  dds_entity_t entity() const { return entity_; }

 private:
  dds_entity_t entity_ = 0;
};

class DdsNode {
 public:
  // InputError: DDS does not start: a domain out of 0 to 232, or CYCLONEDDS_URI is wrong. With
  // `only_this_machine`, and without CYCLONEDDS_URI, nothing leaves the loopback interface.
  DdsNode(std::uint32_t domain, bool only_this_machine);
  ~DdsNode();
  DdsNode(const DdsNode&) = delete;
  DdsNode& operator=(const DdsNode&) = delete;

  // Names of DDS: "rt/image". InputError: a name that DDS refuses.
  template <typename Wire>
  DdsWriter writer(const std::string& topic, const Qos& qos) {
    return DdsWriter(make_writer(descriptor<Wire>(), topic, qos));
  }
  // `handle(const Wire&)` is called by spin().
  template <typename Wire, typename Handle>
  DdsReader subscribe(const std::string& topic, const Qos& qos, const Handle& handle) {
    return make_reader(descriptor<Wire>(), topic, qos,
                       [handle](const void* sample) { handle(*static_cast<const Wire*>(sample)); });
  }

  // Waits so long for messages and handles those that are there. A message for which there is no
  // memory is left out.
  void spin(double seconds);
  std::uint64_t left_out() const { return left_out_; }

 private:
  using Handler = std::function<void(const void*)>;
  struct Subscription {
    dds_entity_t reader = 0;
    Handler handle;
  };

  dds_entity_t make_topic(const dds_topic_descriptor_t& type, const std::string& topic);
  dds_entity_t make_writer(const dds_topic_descriptor_t& type, const std::string& topic,
                           const Qos& qos);
  DdsReader make_reader(const dds_topic_descriptor_t& type, const std::string& topic,
                        const Qos& qos, Handler handle);
  void handle_all(const Subscription& subscription);

  dds_entity_t domain_ = 0, participant_ = 0, waitset_ = 0;
  std::vector<Subscription> subscriptions_;  // the waitset knows them by their index
  std::uint64_t left_out_ = 0;
};

}  // namespace edgescout::ros2
