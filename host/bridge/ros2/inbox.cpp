#include "host/bridge/ros2/inbox.h"

#include <algorithm>
#include <iterator>

namespace edgescout::ros2 {

namespace {

Clock::time_point from_now(double seconds) {
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

bool Inbox::put(ImageMessage message) {
  bool drops = false;
  {
    const std::scoped_lock lock(mutex_);
    drops = newest_.has_value();
    newest_ = {std::move(message), Clock::now(), ++images_, 1};
  }
  changed_.notify_all();
  return drops;
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
    request.after = images_;
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
  if (newest_) return false;
  newest_ = std::move(image);
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

bool Inbox::is_image_ready() const {
  if (!newest_ || newest_->not_before_info > calibrations_) return false;
  return always_ || std::ranges::any_of(requests_, [&](const ImageRequest& request) {
           return request.after < newest_->number;
         });
}

bool Inbox::has_expired() const {
  return std::ranges::any_of(
      requests_, [](const ImageRequest& request) { return request.deadline <= Clock::now(); });
}

Clock::time_point Inbox::next_deadline(Clock::time_point latest) const {
  for (const ImageRequest& request : requests_) latest = std::min(latest, request.deadline);
  return latest;
}

Inbox::Work Inbox::next(double seconds) {
  const Clock::time_point end = from_now(seconds);
  std::unique_lock lock(mutex_);
  while (!stopped_ && jobs_.empty() && !is_image_ready() && !has_expired() && Clock::now() < end)
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
  } else if (is_image_ready()) {
    work.image = std::move(newest_);
    newest_.reset();
    take(work.for_image,
         [&](const ImageRequest& request) { return request.after < work.image->number; });
  }
  take(work.expired, [](const ImageRequest& request) { return request.deadline <= Clock::now(); });
  return work;
}

}  // namespace edgescout::ros2
