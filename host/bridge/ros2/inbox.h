// Holds what waits for work: the newest image, and requests.
//
// Where depth images are wanted, images wait for theirs: of those that have one, or have waited for
// long enough, the newest is worked on. Depth images come later than their image, so that several
// images wait at once; the last eight are kept.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "host/bridge/ros2/depth_matches.h"
#include "host/bridge/ros2/image_message.h"
#include "host/register/measured_depth.h"

namespace edgescout::ros2 {

using Clock = std::chrono::steady_clock;

struct ArrivedImage {
  ImageMessage message;
  Clock::time_point time;
  std::uint64_t number = 0;           // in the order of arrival
  std::uint64_t not_before_info = 0;  // worked on once so many calibrations have arrived
  DepthMessage depth;                 // that belongs to it; null: none
};

// An image as it is worked on.
struct TakenImage {
  msg::Header header;
  Image image;
  Camera camera;
  std::shared_ptr<const MeasuredDepth> depth;  // null: none
};

// A request that the next image answers.
struct ImageRequest {
  std::function<void(const TakenImage&)> on_image;
  std::function<void(const std::string&)> on_failure;  // why there is none
  Clock::time_point deadline;
  std::uint64_t after = 0;  // number of the last image that had arrived before it
};

// One thread works, others put things in.
class Inbox {
 public:
  // `always`: images are wanted without a request as well. `depth`: images wait for depth images.
  explicit Inbox(bool always, const std::optional<DepthWait>& depth = {})
      : always_(always), depth_wait_(depth), depths_(depth ? depth->tolerance_s : 0) {}

  // The newest image wins. Returns how many are dropped for it.
  std::size_t put(ImageMessage message);
  void put(DepthMessage depth);
  // False: so many requests wait already that no further one is taken.
  bool put(std::function<void()> job);
  bool put(ImageRequest request, double wait_seconds);
  // A calibration is there; images can be worked on from now on.
  void put_calibration();
  // Puts an image back until the next calibration. False: a newer one is there.
  bool put_back(ArrivedImage image);
  void stop();

  struct Work {
    std::function<void()> job;
    std::optional<ArrivedImage> image;
    std::vector<ImageRequest> for_image;  // of the image
    std::vector<ImageRequest> expired;
    std::size_t dropped = 0;  // images that are older than this one
    bool is_any() const { return job || image || !expired.empty(); }
  };
  // Waits so long for work. Requests of the image leave the inbox with it.
  Work next(double seconds);
  // Requests whose image was of no use wait for the next one.
  void put_back(std::vector<ImageRequest> requests);

  std::uint64_t calibrations() const;
  bool is_stopped() const;

 private:
  static constexpr std::size_t most_waiting = 64;

  using Images = std::deque<ArrivedImage>;  // the newest last

  std::size_t most_images() const { return depth_wait_ ? DepthMatches::most_kept : 1; }
  void give_depth(const DepthMessage& depth);
  bool is_wanted(const ArrivedImage& image) const;
  bool has_depth_or_waits_no_more(const ArrivedImage& image) const;
  Clock::time_point depth_deadline(const ArrivedImage& image) const;
  Images::iterator ready_image();  // end(): none
  bool has_expired() const;
  Clock::time_point next_deadline(Clock::time_point latest) const;
  void take_image(const Images::iterator& image, Work& work);

  bool always_;
  std::optional<DepthWait> depth_wait_;
  DepthMatches depths_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Images waiting_;
  std::deque<std::function<void()>> jobs_;
  std::vector<ImageRequest> requests_;
  std::uint64_t arrived_ = 0, calibrations_ = 0;
  bool stopped_ = false;
};

}  // namespace edgescout::ros2
