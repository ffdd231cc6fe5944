// Messages with wrong bytes, as DDS would hand them over, and messages that are well formed and
// make no sense. EDGESCOUT_FUZZ_MESSAGES sets how many.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "dds/ddsi/ddsi_serdata.h"
#include "host/bridge/ros2/dds/dds_node.h"
#include "host/core/random.h"
#include "kernels/error.h"
#include "tests/bridge/dds/dds_peer.h"
#include "tests/bridge/small_world.h"

namespace edgescout::ros2::test {

namespace {

struct NoResults : Outbox {
  bool wants_markers() const override { return true; }
  bool wants_overlay() const override { return true; }
  void send(const msg::Detection3DArray&) override {}
  void send(const msg::MarkerArray&) override {}
  void send(const msg::Image&) override {}
  void send(const msg::TFMessage&) override {}
};

// A bridge that reads every message and has no models: detection itself is not the subject.
struct FuzzedBridge {
  NoResults results;
  Bridge bridge{[](const Camera&, const IsCancelled&) -> std::vector<TemplateSet> {
                  throw InputError("models", "files", "none", "some");
                },
                *small_world().backend, options(), results};
  int answers = 0;

  static BridgeOptions options() {
    BridgeOptions options;
    options.tf_seconds = 0;
    options.request_seconds = 0;
    return options;
  }
  void take(const msg::Image& m) { bridge.take(ImageMessage(m)); }
  void take(const msg::CompressedImage& m) { bridge.take(ImageMessage(m)); }
  void take(const msg::CameraInfo& m) { bridge.take(m); }
  void take(const msg::TFMessage& m) { bridge.take(m, answers % 2 == 0); }
  void take(const msg::GetPoseEstimatesRequest& m) {
    bridge.request(m, [this](const msg::GetPoseEstimatesResult&) { ++answers; });
  }
  void take(const msg::DetectRequest& m) {
    bridge.request(m, [this](const msg::DetectResult&) { ++answers; });
  }
  void take(const msg::ScoutGiveRequest& m) {
    bridge.request(m, [this](const msg::ScoutGiveResult&) { ++answers; });
  }
};

using Bytes = std::vector<char>;

// Wrong bytes, wrong lengths, another encoding, or a few of these.
void mutate(Bytes& bytes, Random& random) {
  const auto below = [&](std::size_t end) { return std::size_t(random.uniform(0, double(end))); };
  for (std::size_t changes = 1 + below(4); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = below(bytes.size());
    switch (below(5)) {
      case 0:
        bytes[at] = char(below(256));
        break;
      case 1:
        bytes.resize(at);
        break;
      case 2: {
        const auto length = std::uint32_t(std::pow(2, random.uniform(0, 32)));
        const std::size_t start = std::min(at / 4 * 4, bytes.size() < 4 ? 0 : bytes.size() - 4);
        if (bytes.size() >= 4) std::memcpy(&bytes[start], &length, 4);
        break;
      }
      case 3:
        bytes[std::min<std::size_t>(1, bytes.size() - 1)] = char(below(12));  // the encoding
        break;
      default:
        bytes.insert(bytes.begin() + std::ptrdiff_t(at), below(100), char(below(256)));
    }
  }
}

// A valid message of a type, and what Cyclone DDS makes of other bytes of it.
template <typename Plain, typename Wire>
class FuzzedType {
 public:
  FuzzedType(Peer& peer, const std::string& topic, const Plain& plain) {
    const Qos qos{.is_transient_local = true};
    const DdsReader reader = peer.subscribe<Wire>(topic, qos, [](const Wire&) {});
    const DdsWriter writer = peer.writer<Wire>(topic, qos);
    Peer::write<Wire>(writer, plain);
    dds_sample_info_t info;
    while (dds_takecdr(reader.entity(), &valid_, 1, &info, DDS_ANY_STATE) != 1)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    bytes_.resize(ddsi_serdata_size(valid_));
    ddsi_serdata_to_ser(valid_, 0, bytes_.size(), bytes_.data());
  }
  FuzzedType(const FuzzedType&) = delete;
  FuzzedType& operator=(const FuzzedType&) = delete;
  ~FuzzedType() { ddsi_serdata_unref(valid_); }

  // Returns whether DDS would have handed it over.
  bool give_mutated(FuzzedBridge& fuzzed, Random& random) const {
    Bytes bytes = bytes_;
    mutate(bytes, random);
    if (bytes.size() < 4) return false;  // DDS looks at no less
    ddsrt_iovec_t part{bytes.data(), bytes.size()};
    ddsi_serdata* message =
        ddsi_serdata_from_ser_iov(valid_->type, SDK_DATA, 1, &part, bytes.size());
    if (!message) return false;
    Wire wire{};
    const bool is_read = ddsi_serdata_to_sample(message, &wire, nullptr, nullptr);
    if (is_read) fuzzed.take(plain_of<Plain>(wire));
    dds_sample_free(&wire, &descriptor<Wire>(), DDS_FREE_CONTENTS);
    ddsi_serdata_unref(message);
    return is_read;
  }

 private:
  ddsi_serdata* valid_ = nullptr;
  Bytes bytes_;
};

Image tiny_image() { return {24, 20, std::vector<std::uint8_t>(480, 99)}; }

msg::CameraInfo tiny_info() { return info_message({24, 20, 30, 30, 12, 10, {}}); }

TEST(Fuzz, WrongBytesEndNothing) {
  const char* stated = std::getenv("EDGESCOUT_FUZZ_MESSAGES");
  const long messages = stated ? std::atol(stated) : 6000;
  Peer peer;
  const std::string png = encode_png(tiny_image());
  const msg::CompressedImage compressed{
      header_at(1), "mono8; png compressed", {png.begin(), png.end()}};
  const FuzzedType<msg::Image, sensor_msgs_msg_dds__Image_> image(peer, "rt/a",
                                                                  image_message(tiny_image()));
  const FuzzedType<msg::CompressedImage, sensor_msgs_msg_dds__CompressedImage_> png_image(
      peer, "rt/b", compressed);
  const FuzzedType<msg::CameraInfo, sensor_msgs_msg_dds__CameraInfo_> info(peer, "rt/c",
                                                                           tiny_info());
  const FuzzedType<msg::TFMessage, tf2_msgs_msg_dds__TFMessage_> tf(
      peer, "rt/d", {{transform_message("world", "camera", {}, 1)}});
  const FuzzedType<msg::GetPoseEstimatesRequest, edgescout_msgs_srv_dds__GetPoseEstimates_Request_>
      estimates(peer, "rq/eRequest", {{1}, {{tiny_info(), {}, image_message(tiny_image())}}});
  const FuzzedType<msg::ScoutGiveRequest, edgescout_msgs_msg_dds__ScoutGiveRequest_> give(
      peer, "rt/f", {0, true, "no path"});
  const FuzzedType<msg::DetectRequest, edgescout_msgs_msg_dds__DetectRequest_> detect(peer, "rt/g",
                                                                                      {0.5});
  FuzzedBridge fuzzed;
  fuzzed.bridge.take(tiny_info());
  Random random(3);
  long handed_over = 0;
  for (long i = 0; i < messages; ++i) {
    bool is_read = false;
    switch (i % 7) {
      case 0:
        is_read = image.give_mutated(fuzzed, random);
        break;
      case 1:
        is_read = png_image.give_mutated(fuzzed, random);
        break;
      case 2:
        is_read = info.give_mutated(fuzzed, random);
        break;
      case 3:
        is_read = tf.give_mutated(fuzzed, random);
        break;
      case 4:
        is_read = estimates.give_mutated(fuzzed, random);
        break;
      case 5:
        is_read = detect.give_mutated(fuzzed, random);
        break;
      default:
        is_read = give.give_mutated(fuzzed, random);
    }
    handed_over += is_read;
    while (fuzzed.bridge.work(0)) continue;
  }
  // Both ways are taken, or nothing was tried.
  EXPECT_GT(handed_over, messages / 10);
  EXPECT_LT(handed_over, messages);
  EXPECT_GT(fuzzed.bridge.diagnostics().counted("images refused"), 0u);
  EXPECT_GT(fuzzed.answers, 0);
  if (stated)
    std::cout << messages << " messages, " << handed_over << " handed over, "
              << fuzzed.bridge.diagnostics().counted("images refused") << " images refused, "
              << fuzzed.answers << " requests answered\n";
  // A good image is worked on as before.
  fuzzed.bridge.take(tiny_info());
  fuzzed.bridge.take(ImageMessage(image_message(tiny_image())));
  fuzzed.bridge.work(0);
  EXPECT_EQ(fuzzed.bridge.diagnostics().problem_of("image"), "");
  EXPECT_EQ(fuzzed.bridge.diagnostics().problem_of("detection"),
            "models: files: found none, expected some");
}

}  // namespace

}  // namespace edgescout::ros2::test
