#include "host/bridge/ros2/inbox.h"

#include <algorithm>
#include <iterator>

#include "host/bridge/ros2/frames.h"

namespace edgescout::ros2 {

namespace {

Clock::time_point from_now(double seconds) {
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

bool has_stamp(const msg::Header& header) { return nanoseconds(header.stamp) != 0; }

}  // namespace

std::size_t Inbox::put(ImageMessage message) {
  std::size_t dropped = 0;
  {
    const std::scoped_lock lock(mutex_);
    const msg::Header& header = header_of(message);
    DepthMessage depth = has_stamp(header) ? depths_.of(header) : nullptr;
    waiting_.push_back({std::move(message), Clock::now(), ++arrived_, 1, std::move(depth)});
    // The first one must be able to end its wait for depth, however fast others come.
    for (; waiting_.size() > most_images(); ++dropped)
      waiting_.erase(waiting_.begin() + (most_images() > 1));
  }
  changed_.notify_all();
  return dropped;
}

void Inbox::put(DepthMessage depth) {
  {
    const std::scoped_lock lock(mutex_);
    give_depth(depth);
    depths_.add(std::move(depth));
  }
  changed_.notify_all();
}

// To the images that wait, unless they have one nearer in time: a worker may be busy for longer
// than depth images are kept.
void Inbox::give_depth(const DepthMessage& depth) {
  for (ArrivedImage& image : waiting_) {
    const msg::Header& header = header_of(image.message);
    const std::optional<double> apart_s = depths_.apart_s(*depth, header);
    if (apart_s && has_stamp(header) &&
        (!image.depth || *apart_s <= *depths_.apart_s(*image.depth, header)))
      image.depth = depth;
  }
}

bool Inbox::put(std::function<void()> job) {
  {
    const std::scoped_lock lock(mutex_);
    if (jobs_.size() >= most_waiting) return false;
    jobs_.push_back(std::move(job));
  }
  changed_.notify_all();
  return true;
}

bool Inbox::put(ImageRequest request, double wait_seconds) {
  {
    const std::scoped_lock lock(mutex_);
    if (requests_.size() >= most_waiting) return false;
    request.deadline = from_now(wait_seconds);
    request.after = arrived_;
    requests_.push_back(std::move(request));
  }
  changed_.notify_all();
  return true;
}

void Inbox::put_calibration() {
  {
    const std::scoped_lock lock(mutex_);
    ++calibrations_;
  }
  changed_.notify_all();
}

bool Inbox::put_back(ArrivedImage image) {
  const std::scoped_lock lock(mutex_);
  if (!waiting_.empty()) return false;
  waiting_.push_back(std::move(image));
  return true;
}

void Inbox::put_back(std::vector<ImageRequest> requests) {
  const std::scoped_lock lock(mutex_);
  std::ranges::move(requests, std::back_inserter(requests_));
}

void Inbox::stop() {
  {
    const std::scoped_lock lock(mutex_);
    stopped_ = true;
  }
  changed_.notify_all();
}

bool Inbox::is_stopped() const {
  const std::scoped_lock lock(mutex_);
  return stopped_;
}

std::uint64_t Inbox::calibrations() const {
  const std::scoped_lock lock(mutex_);
  return calibrations_;
}

bool Inbox::is_wanted(const ArrivedImage& image) const {
  if (image.not_before_info > calibrations_) return false;
  return always_ || std::ranges::any_of(requests_, [&](const ImageRequest& request) {
           return request.after < image.number;
         });
}

Clock::time_point Inbox::depth_deadline(const ArrivedImage& image) const {
  return image.time + std::chrono::duration_cast<Clock::duration>(
                          std::chrono::duration<double>(depth_wait_->seconds));
}

// No depth image belongs to an image without a stamp.
bool Inbox::has_depth_or_waits_no_more(const ArrivedImage& image) const {
  return !depth_wait_ || image.depth || !has_stamp(header_of(image.message)) ||
         depth_deadline(image) <= Clock::now();
}

Inbox::Images::iterator Inbox::ready_image() {
  const auto found = std::find_if(waiting_.rbegin(), waiting_.rend(), [&](const auto& image) {
    return is_wanted(image) && has_depth_or_waits_no_more(image);
  });
  return found == waiting_.rend() ? waiting_.end() : std::prev(found.base());
}

// The image goes, and so do the older ones.
void Inbox::take_image(const Images::iterator& image, Work& work) {
  work.dropped = std::size_t(image - waiting_.begin());
  work.image = std::move(*image);
  waiting_.erase(waiting_.begin(), image + 1);
}

bool Inbox::has_expired() const {
  return std::ranges::any_of(
      requests_, [](const ImageRequest& request) { return request.deadline <= Clock::now(); });
}

Clock::time_point Inbox::next_deadline(Clock::time_point latest) const {
  for (const ImageRequest& request : requests_) latest = std::min(latest, request.deadline);
  if (!depth_wait_) return latest;
  for (const ArrivedImage& image : waiting_)
    if (is_wanted(image)) latest = std::min(latest, depth_deadline(image));
  return latest;
}

Inbox::Work Inbox::next(double seconds) {
  const Clock::time_point end = from_now(seconds);
  std::unique_lock lock(mutex_);
  while (!stopped_ && jobs_.empty() && ready_image() == waiting_.end() && !has_expired() &&
         Clock::now() < end)
    changed_.wait_until(lock, next_deadline(end));
  Work work;
  if (stopped_) return work;
  const auto take = [&](std::vector<ImageRequest>& to, const auto& fits) {
    const auto rest = std::stable_partition(requests_.begin(), requests_.end(), std::not_fn(fits));
    std::move(rest, requests_.end(), std::back_inserter(to));
    requests_.erase(rest, requests_.end());
  };
  if (!jobs_.empty()) {
    work.job = std::move(jobs_.front());
    jobs_.pop_front();
  } else if (const auto image = ready_image(); image != waiting_.end()) {
    take_image(image, work);
    take(work.for_image,
         [&](const ImageRequest& request) { return request.after < work.image->number; });
  }
  take(work.expired, [](const ImageRequest& request) { return request.deadline <= Clock::now(); });
  return work;
}

}  // namespace edgescout::ros2
