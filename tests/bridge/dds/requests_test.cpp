// Every request of the program, asked over DDS as a service and as a pair of topics.
#include <gtest/gtest.h>

#include <map>

#include "host/active/views.h"
#include "tests/bridge/dds/camera_peer.h"

namespace edgescout::ros2::test {

namespace {

// A service's payload begins with its client and a number, as rmw_cyclonedds makes it; that of a
// topic with an id.
template <typename Wire>
constexpr bool is_of_service = requires(Wire wire) {
  wire.guid;
};

template <typename Request, typename Result, typename RequestWire, typename ResultWire>
class Client {
 public:
  Client(CameraPeer& peer, const std::string& name)
      : peer_(peer),
        writer_(peer.writer<RequestWire>(
            is_of_service<RequestWire> ? "rq" + name + "Request" : "rt" + name + "/request", {})),
        reader_(peer.subscribe<ResultWire>(
            is_of_service<ResultWire> ? "rr" + name + "Reply" : "rt" + name + "/result", {},
            [this](const ResultWire& wire) { take(wire); })) {}

  // Sends images until the answer is there; `times`: the same request, so many answers.
  Result ask(const Request& request = {}, std::size_t times = 1) {
    const auto is_met = [&] { return writer_.has_readers() && reader_.writers() > 0; };
    EXPECT_TRUE(peer_.spin_until(is_met));
    const std::string id = name_of(++asked_);
    RequestWire wire{};
    ToWire io;
    io(request, wire);
    if constexpr (is_of_service<RequestWire>)
      wire.guid = guid, wire.seq = asked_;
    else
      io(id, wire.id);
    for (std::size_t i = 0; i < times; ++i) writer_.write(&wire);
    EXPECT_TRUE(peer_.send_until([&] { return answers_[id].size() >= times; }))
        << peer_.diagnostics();
    EXPECT_EQ(answers_[id].size(), times);
    return answers_[id].empty() ? Result{} : answers_[id].back();
  }

 private:
  static constexpr std::uint64_t guid = 0xabcdef0123456789;
  static std::string name_of(std::int64_t number) { return "request " + std::to_string(number); }
  void take(const ResultWire& wire) {
    if constexpr (is_of_service<ResultWire>) {
      EXPECT_EQ(wire.guid, guid);
      answers_[name_of(wire.seq)].push_back(plain_of<Result>(wire));
    } else {
      answers_[wire.id].push_back(plain_of<Result>(wire));
    }
  }

  CameraPeer& peer_;
  DdsWriter writer_;
  DdsReader reader_;
  std::int64_t asked_ = 0;
  std::map<std::string, std::vector<Result>> answers_;
};

#define EDGESCOUT_CLIENT(name)                                                          \
  template <bool is_service>                                                            \
  using name##Client =                                                                  \
      Client<msg::name##Request, msg::name##Result,                                     \
             std::conditional_t<is_service, edgescout_msgs_srv_dds__##name##_Request_,  \
                                edgescout_msgs_msg_dds__##name##Request_>,              \
             std::conditional_t<is_service, edgescout_msgs_srv_dds__##name##_Response_, \
                                edgescout_msgs_msg_dds__##name##Result_>>;
EDGESCOUT_CLIENT(Detect)
EDGESCOUT_CLIENT(GetPoseEstimates)
EDGESCOUT_CLIENT(ScoutPropose)
EDGESCOUT_CLIENT(ScoutGive)
EDGESCOUT_CLIENT(ScoutState)
#undef EDGESCOUT_CLIENT

void detect_in_images(CameraPeer& peer) {
  DetectClient<true> detect(peer, "/edgescout/detect");
  const msg::DetectResult found = detect.ask();
  EXPECT_TRUE(found.success) << found.message;
  EXPECT_EQ(found.detections.header.frame_id, "world");
  EXPECT_FALSE(found.detections.detections.empty());

  GetPoseEstimatesClient<true> estimate(peer, "/edgescout/get_pose_estimates");
  const msg::GetPoseEstimatesResult poses = estimate.ask({{1}, {calibrated(0)}});
  ASSERT_TRUE(poses.success) << poses.message;
  ASSERT_FALSE(poses.pose_estimates.empty());
  EXPECT_EQ(poses.pose_estimates[0].obj_id, 1u);
  const Se3 truth = small_world().scene.placed[0].world_from_object;
  EXPECT_LT(distance_between_m(pose_of(poses.pose_estimates[0].pose, "pose"), truth), 0.02);
}

// With an image of the first view, or saying that the arm did not reach it.
template <bool is_service>
void scout(CameraPeer& peer, bool is_reached) {
  ScoutProposeClient<is_service> propose(peer, "/edgescout/scout_propose");
  ScoutGiveClient<is_service> give(peer, "/edgescout/scout_give");
  ScoutStateClient<is_service> state(peer, "/edgescout/scout_state");
  const msg::ScoutProposeResult first = propose.ask({.restart = true});
  ASSERT_TRUE(first.success) << first.message;
  EXPECT_FALSE(first.done);
  EXPECT_EQ(first.camera_pose.header.frame_id, "world");
  peer.view = std::size_t(first.view);
  const msg::ScoutGiveResult given = give.ask({first.view, !is_reached, "no path"});
  EXPECT_TRUE(given.success) << given.message;
  const msg::ScoutStateResult now = state.ask();
  EXPECT_TRUE(now.success) << now.message;
  EXPECT_EQ(now.images, is_reached ? 1 : 0);
  EXPECT_EQ(now.detections.header.frame_id, "world");
  EXPECT_TRUE(give.ask({1 - first.view, true, "no path"}).success);
  const msg::ScoutProposeResult last = propose.ask();
  EXPECT_TRUE(last.done);
  EXPECT_NE(last.end, "");
}

TEST(Requests, AreAnsweredAsServicesAndOnTopics) {
  const TemporaryFolder folder;
  const std::filesystem::path views = folder.path() / "views.json";
  save_views(std::array{small_world().camera_from_world(0), small_world().camera_from_world(1)},
             views);
  RunningProgram program(bracket({"--views", views, "--world-frame", "world", "--ros-args", "-p",
                                  "on_request:=true", "-p", "scout.max_views:=2"}));
  CameraPeer peer;
  ScoutStateClient<true> state(peer, "/edgescout/scout_state");
  EXPECT_EQ(state.ask().message, "scout: run: found none, expected a request scout_propose before");
  detect_in_images(peer);
  DetectClient<false> detect(peer, "/edgescout/detect");
  EXPECT_TRUE(detect.ask({.max_seconds = 1e-3}).success);
  EXPECT_TRUE(detect.ask({.max_seconds = 1e-3}, 2).success);  // an id that comes twice
  GetPoseEstimatesClient<false> estimate(peer, "/edgescout/get_pose_estimates");
  EXPECT_EQ(estimate.ask({{7}, {calibrated(0)}}).message,
            "request: object_ids: found 7, expected one of 1");
  scout<true>(peer, true);
  scout<false>(peer, false);
  EXPECT_EQ(program.stop(), 0) << program.log();
}

}  // namespace

}  // namespace edgescout::ros2::test
