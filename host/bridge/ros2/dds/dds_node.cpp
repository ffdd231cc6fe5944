#include "host/bridge/ros2/dds/dds_node.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <new>

#include "kernels/error.h"

namespace edgescout::ros2 {

namespace {

// Loopback has no multicast: participants are asked one by one.
constexpr char loopback_only[] =
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" "
    "multicast=\"false\"/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General>"
    "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32"
    "</MaxAutoParticipantIndex><Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery>"
    "</Domain></CycloneDDS>";

dds_entity_t valid(dds_entity_t entity, const std::string& what, const std::string& expected) {
  if (entity < 0) throw InputError("DDS", what, dds_strretcode(entity), expected);
  return entity;
}

std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> qos_of(const Qos& qos) {
  std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> made(dds_create_qos(), &dds_delete_qos);
  constexpr std::int64_t longest_block_ms = 100;
  dds_qset_reliability(made.get(),
                       qos.is_reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       DDS_MSECS(longest_block_ms));
  dds_qset_durability(made.get(), qos.is_transient_local ? DDS_DURABILITY_TRANSIENT_LOCAL
                                                         : DDS_DURABILITY_VOLATILE);
  dds_qset_history(made.get(), DDS_HISTORY_KEEP_LAST, qos.depth);
  dds_qset_writer_data_lifecycle(made.get(), false);
  return made;
}

}  // namespace

bool DdsWriter::has_readers() const {
  dds_publication_matched_status_t status{};
  return dds_get_publication_matched_status(entity_, &status) >= 0 && status.current_count > 0;
}

std::uint32_t DdsReader::writers() const {
  dds_subscription_matched_status_t status{};
  return dds_get_subscription_matched_status(entity_, &status) < 0 ? 0 : status.current_count;
}

std::uint64_t DdsReader::lost() const {
  dds_sample_lost_status_t status{};
  return dds_get_sample_lost_status(entity_, &status) < 0 ? 0 : status.total_count;
}

std::uint32_t DdsReader::incompatible_writers() const {
  dds_requested_incompatible_qos_status_t status{};
  return dds_get_requested_incompatible_qos_status(entity_, &status) < 0 ? 0 : status.total_count;
}

DdsNode::DdsNode(std::uint32_t domain, bool only_this_machine) {
  constexpr std::uint32_t highest_domain = 232;  // of the port numbers
  if (domain > highest_domain)
    throw InputError("DDS", "ROS_DOMAIN_ID", std::to_string(domain),
                     "0 to " + std::to_string(highest_domain));
  if (only_this_machine && !std::getenv("CYCLONEDDS_URI"))
    domain_ = valid(dds_create_domain(domain, loopback_only), "domain", "a domain on loopback");
  participant_ = valid(dds_create_participant(domain, nullptr, nullptr), "participant",
                       "one; see CYCLONEDDS_URI and the network's interfaces");
  waitset_ = valid(dds_create_waitset(participant_), "waitset", "one");
}

DdsNode::~DdsNode() {
  dds_delete(participant_);
  if (domain_ > 0) dds_delete(domain_);
}

dds_entity_t DdsNode::make_topic(const dds_topic_descriptor_t& type, const std::string& topic) {
  return valid(dds_create_topic(participant_, &type, topic.c_str(), nullptr, nullptr), topic,
               "a topic of the type " + std::string(type.m_typename));
}

dds_entity_t DdsNode::make_writer(const dds_topic_descriptor_t& type, const std::string& topic,
                                  const Qos& qos) {
  return valid(dds_create_writer(participant_, make_topic(type, topic), qos_of(qos).get(), nullptr),
               topic, "a writer");
}

DdsReader DdsNode::make_reader(const dds_topic_descriptor_t& type, const std::string& topic,
                               const Qos& qos, Handler handle) {
  const dds_entity_t reader =
      valid(dds_create_reader(participant_, make_topic(type, topic), qos_of(qos).get(), nullptr),
            topic, "a reader");
  dds_waitset_attach(waitset_, reader, dds_attach_t(subscriptions_.size()));
  subscriptions_.push_back({reader, std::move(handle)});
  dds_set_status_mask(reader, DDS_DATA_AVAILABLE_STATUS);
  return DdsReader(reader);
}

void DdsNode::handle_all(const Subscription& subscription) {
  constexpr std::size_t at_once = 16;
  while (true) {
    std::array<void*, at_once> samples{};
    std::array<dds_sample_info_t, at_once> infos{};
    const dds_return_t count =
        dds_take(subscription.reader, samples.data(), infos.data(), at_once, at_once);
    if (count <= 0) return;
    for (std::size_t i = 0; i < std::size_t(count); ++i) {
      try {
        if (infos[i].valid_data) subscription.handle(samples[i]);
      } catch (const std::bad_alloc&) {
        ++left_out_;
      }
    }
    dds_return_loan(subscription.reader, samples.data(), count);
  }
}

void DdsNode::spin(double seconds) {
  std::vector<dds_attach_t> ready(subscriptions_.size());
  const dds_return_t count =
      dds_waitset_wait(waitset_, ready.data(), ready.size(), dds_duration_t(seconds * 1e9));
  const std::size_t reported = count < 0 ? 0 : std::min(std::size_t(count), ready.size());
  for (std::size_t i = 0; i < reported; ++i) handle_all(subscriptions_[std::size_t(ready[i])]);
}

}  // namespace edgescout::ros2
