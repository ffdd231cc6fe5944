// A camera and a reader of detections on Fast DDS, which shares no code with Cyclone DDS.
//   fastdds_peer detect IMAGE.pgm FX FY CX CY     prints "score x y z qx qy qz qw" of each
//   detection fastdds_peer mutate IMAGE.pgm COUNT SEED      sends messages with wrong bytes
// Domain: ROS_DOMAIN_ID. Only the loopback interface is used.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

namespace {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;
using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::SerializedPayload_t;

// A message as its bytes on the wire, with the four that name the encoding.
using Bytes = std::vector<char>;

class RawType : public dds::TopicDataType {
 public:
  explicit RawType(const char* name) {
    setName(name);
    m_typeSize = 4 * 1024 * 1024;
    m_isGetKeyDefined = false;
  }
  bool serialize(void* data, SerializedPayload_t* payload) override {
    const Bytes& bytes = *static_cast<Bytes*>(data);
    std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(payload->data));
    payload->length = static_cast<std::uint32_t>(bytes.size());
    payload->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(SerializedPayload_t* payload, void* data) override {
    const char* start = reinterpret_cast<char*>(payload->data);
    static_cast<Bytes*>(data)->assign(start, start + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size()); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, InstanceHandle_t*, bool) override { return false; }
};

// Appends fields in the order of the message's definition.
class Message {
 public:
  Message() : cdr_(buffer_, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR) { cdr_.serialize_encapsulation(); }
  template <typename Value>
  Message& add(const Value& value) {
    cdr_ << value;
    return *this;
  }
  Message& header(std::int32_t sec) {
    return add(sec).add(std::uint32_t(5)).add(std::string("camera"));
  }
  Bytes bytes() const {
    return {buffer_.getBuffer(), buffer_.getBuffer() + cdr_.getSerializedDataLength()};
  }

 private:
  mutable FastBuffer buffer_;
  Cdr cdr_;
};

struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> pixels;
};

Picture read_pgm(const char* file) {
  std::ifstream stream(file, std::ios::binary);
  std::string magic;
  std::uint32_t white = 0;
  Picture picture;
  stream >> magic >> picture.width >> picture.height >> white;
  stream.get();
  picture.pixels.assign(std::istreambuf_iterator<char>(stream), {});
  return picture;
}

Bytes image_of(const Picture& picture, std::int32_t sec) {
  Message message;
  message.header(sec).add(picture.height).add(picture.width).add(std::string("mono8"));
  return message.add(std::uint8_t(0)).add(picture.width).add(picture.pixels).bytes();
}

Bytes info_of(const Picture& picture, const std::array<double, 4>& intrinsics, std::int32_t sec) {
  const auto [fx, fy, cx, cy] = intrinsics;
  Message message;
  message.header(sec).add(picture.height).add(picture.width).add(std::string("plumb_bob"));
  message.add(std::vector<double>(5, 0.0));
  message.add(std::array<double, 9>{fx, 0, cx, 0, fy, cy, 0, 0, 1});
  message.add(std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  message.add(std::array<double, 12>{fx, 0, cx, 0, 0, fy, cy, 0, 0, 0, 1, 0});
  for (int i = 0; i < 6; ++i) message.add(std::uint32_t(0));  // binning, region
  return message.add(false).bytes();
}

// Prints the first hypothesis of each detection of a Detection3DArray.
std::string printed(const Bytes& bytes) {
  FastBuffer buffer(const_cast<char*>(bytes.data()), bytes.size());
  Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
  cdr.read_encapsulation();
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0, detections = 0;
  std::string frame, text;
  const auto read_header = [&] { cdr >> sec >> nanosec >> frame; };
  read_header();
  text = "stamp " + std::to_string(sec) + "." + std::to_string(nanosec) + " frame " + frame + "\n";
  cdr >> detections;
  for (std::uint32_t i = 0; i < detections; ++i) {
    std::uint32_t hypotheses = 0;
    read_header();
    cdr >> hypotheses;
    for (std::uint32_t h = 0; h < hypotheses; ++h) {
      std::string name;
      std::array<double, 8> numbers{};
      std::array<double, 36> covariance{};
      cdr >> name >> numbers >> covariance;
      char line[400];
      std::snprintf(line, sizeof line, "%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n",
                    numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5],
                    numbers[6], numbers[7], covariance[0]);
      if (h == 0) text += line;
    }
    std::array<double, 10> box{};
    std::string id;
    cdr >> box >> id;
  }
  return text;
}

class Peer : public dds::DataReaderListener {
 public:
  Peer() {
    const char* domain = std::getenv("ROS_DOMAIN_ID");
    dds::DomainParticipantQos qos;
    auto loopback = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    loopback->interfaceWhiteList = {"127.0.0.1"};
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(loopback);
    qos.wire_protocol().builtin.discovery_config.leaseDuration_announcementperiod =
        eprosima::fastrtps::Duration_t(0.2);  // no multicast on loopback
    participant_ = dds::DomainParticipantFactory::get_instance()->create_participant(
        domain ? static_cast<std::uint32_t>(std::atoi(domain)) : 0, qos);
    publisher_ = participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  }

  dds::DataWriter* writer(const char* name, const char* type, bool is_reliable) {
    dds::DataWriterQos qos = dds::DATAWRITER_QOS_DEFAULT;
    qos.reliability().kind =
        is_reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
    qos.publish_mode().kind = dds::ASYNCHRONOUS_PUBLISH_MODE;
    qos.endpoint().history_memory_policy =
        eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    return publisher_->create_datawriter(topic(name, type), qos);
  }
  void read(const char* name, const char* type) {
    dds::DataReaderQos qos = dds::DATAREADER_QOS_DEFAULT;
    qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
    qos.endpoint().history_memory_policy =
        eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    subscriber_->create_datareader(topic(name, type), qos, this);
  }

  void on_data_available(dds::DataReader* reader) override {
    Bytes bytes;
    dds::SampleInfo info;
    while (reader->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK) {
      const std::scoped_lock lock(mutex_);
      if (info.valid_data) received_.push_back(bytes);
    }
  }
  std::vector<Bytes> received() {
    const std::scoped_lock lock(mutex_);
    return received_;
  }

 private:
  dds::Topic* topic(const char* name, const char* type) {
    dds::TypeSupport support(new RawType(type));
    support.register_type(participant_);
    return participant_->create_topic(name, type, dds::TOPIC_QOS_DEFAULT);
  }

  dds::DomainParticipant* participant_ = nullptr;
  dds::Publisher* publisher_ = nullptr;
  dds::Subscriber* subscriber_ = nullptr;
  std::mutex mutex_;
  std::vector<Bytes> received_;
};

constexpr char image_type[] = "sensor_msgs::msg::dds_::Image_",
               info_type[] = "sensor_msgs::msg::dds_::CameraInfo_",
               tf_type[] = "tf2_msgs::msg::dds_::TFMessage_",
               detections_type[] = "vision_msgs::msg::dds_::Detection3DArray_",
               request_type[] = "edgescout_msgs::msg::dds_::DetectRequest_",
               result_type[] = "edgescout_msgs::msg::dds_::DetectResult_";

// Sends images and asks for a detection until the result with the request's id is there.
int detect(const Picture& picture, const std::array<double, 4>& intrinsics) {
  Peer peer;
  dds::DataWriter* image = peer.writer("rt/image", image_type, false);
  dds::DataWriter* info = peer.writer("rt/camera_info", info_type, false);
  dds::DataWriter* request = peer.writer("rt/edgescout/detect/request", request_type, true);
  peer.read("rt/edgescout/detections", detections_type);
  Peer answers;
  answers.read("rt/edgescout/detect/result", result_type);
  Bytes ask = Message().add(std::string("request 7")).add(0.0).bytes();
  for (std::int32_t sec = 1; sec < 300; ++sec) {
    Bytes picture_bytes = image_of(picture, sec), info_bytes = info_of(picture, intrinsics, sec);
    info->write(&info_bytes);
    if (sec % 10 == 1 && answers.received().empty()) request->write(&ask);
    image->write(&picture_bytes);
    if (!peer.received().empty() && !answers.received().empty()) {
      std::fputs(printed(peer.received()[0]).c_str(), stdout);
      const Bytes answer = answers.received()[0];
      FastBuffer buffer(const_cast<char*>(answer.data()), answer.size());
      Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
      cdr.read_encapsulation();
      std::string id;
      bool success = false;
      cdr >> id >> success;
      std::printf("answer to %s: %s\n", id.c_str(), success ? "success" : "failure");
      std::fflush(stdout);
      std::_Exit(0);  // the library's threads need not end in order
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  std::fputs("no detections\n", stderr);
  return 1;
}

// Wrong bytes, wrong lengths, or another encoding.
void mutate(Bytes& bytes, std::mt19937& random) {
  const auto below = [&](std::size_t end) {
    return std::size_t(random() % std::max<std::size_t>(end, 1));
  };
  for (std::size_t changes = 1 + below(4); changes > 0; --changes) switch (below(5)) {
      case 0:
        if (!bytes.empty()) bytes[below(bytes.size())] = char(random());
        break;
      case 1:
        bytes.resize(below(bytes.size()));
        break;
      case 2:
        if (bytes.size() > 8) {
          const std::uint32_t length = random() >> below(32);
          const std::size_t at = 4 * below(std::min<std::size_t>(bytes.size(), 160) / 4);
          std::copy_n(reinterpret_cast<const char*>(&length), 4,
                      bytes.begin() + std::ptrdiff_t(std::min(at, bytes.size() - 4)));
        }
        break;
      case 3:
        if (bytes.size() > 1) bytes[1] = char(below(12));
        break;
      default:
        bytes.insert(bytes.begin() + std::ptrdiff_t(below(bytes.size())), below(100),
                     char(random()));
    }
}

int send_mutated(const Picture& picture, long count, unsigned seed) {
  Peer peer;
  dds::DataWriter* image = peer.writer("rt/image", image_type, false);
  dds::DataWriter* info = peer.writer("rt/camera_info", info_type, false);
  dds::DataWriter* tf = peer.writer("rt/tf", tf_type, true);
  dds::DataWriter* request = peer.writer("rt/edgescout/detect/request", request_type, true);
  Picture small = picture;  // many messages rather than large ones
  small.height = 20;
  small.pixels.resize(std::size_t(small.width) * small.height);
  Message transform;
  transform.add(std::uint32_t(1)).header(3).add(std::string("child"));
  transform.add(std::array<double, 7>{0, 0, 0, 0, 0, 0, 1});
  const std::pair<dds::DataWriter*, Bytes> kinds[] = {
      {image, image_of(small, 1)},
      {info, info_of(small, {400, 400, 100, 10}, 1)},
      {tf, transform.bytes()},
      {request, Message().add(std::string("id")).add(0.0).bytes()}};
  dds::PublicationMatchedStatus matched;
  for (int i = 0; i < 300 && matched.current_count == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    request->get_publication_matched_status(matched);
  }
  if (matched.current_count == 0) return 1;
  std::mt19937 random(seed);
  for (long i = 0; i < count; ++i) {
    const auto& [writer, valid] = kinds[random() % std::size(kinds)];
    Bytes bytes = valid;
    mutate(bytes, random);
    if (bytes.size() < 4) bytes.resize(4);
    writer->write(&bytes);
    if (i % 20 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  std::printf("%ld messages sent\n", count);
  std::fflush(stdout);
  std::_Exit(0);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string verb = argc > 2 ? argv[1] : "";
  if (verb == "detect" && argc == 7)
    return detect(read_pgm(argv[2]),
                  {std::atof(argv[3]), std::atof(argv[4]), std::atof(argv[5]), std::atof(argv[6])});
  if (verb == "mutate" && argc == 5)
    return send_mutated(read_pgm(argv[2]), std::atol(argv[3]), unsigned(std::atol(argv[4])));
  std::fprintf(stderr, "usage: %s detect IMAGE.pgm FX FY CX CY | mutate IMAGE.pgm COUNT SEED\n",
               argv[0]);
  return 2;
}
