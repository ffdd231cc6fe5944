#include "host/cli/track_run.h"

#include <chrono>
#include <iostream>
#include <map>
#include <optional>
#include <tuple>

#include "host/cli/batch_results.h"
#include "host/cli/progress.h"
#include "host/cli/track_files.h"
#include "host/cli/view_results.h"
#include "host/core/log.h"
#include "host/core/stopwatch.h"
#include "host/io/image.h"
#include "host/track/track_overlay.h"

namespace edgescout {

namespace {

using Clock = std::chrono::steady_clock;

// What one camera saw of one scene, or one video; other images are one sequence.
std::vector<std::vector<const InputImage*>> sequences_of(std::span<const InputImage> images) {
  using Key = std::tuple<std::filesystem::path, std::filesystem::path, std::string>;
  std::map<Key, std::size_t> known;
  std::vector<std::vector<const InputImage*>> sequences;
  for (const InputImage& image : images) {
    const auto [place, is_new] =
        known.try_emplace({image.scene_folder, image.video, image.camera_name}, sequences.size());
    if (is_new) sequences.emplace_back();
    sequences[place->second].push_back(&image);
  }
  return sequences;
}

// Follows objects through one sequence after the other.
class SequenceRunner {
 public:
  SequenceRunner(std::span<const InputImage> images, std::span<const TemplateSet> sets,
                 std::span<const RegisterJob> starts, Backend& backend, const TrackRequest& request)
      : sets_(sets),
        models_(models_of(sets)),
        backend_(backend),
        request_(request),
        camera_(given_camera(request.calibration, images)),
        depth_(request.depth),
        files_(request.out, images, sets),
        progress_("track", images.size(), std::cerr, stderr_is_terminal()) {
    for (const RegisterJob& job : starts) starts_[job.views[0].name] = &job.starts;
  }

  void run(std::span<const InputImage* const> sequence) {
    std::optional<Tracker> tracker;
    states_.clear();
    ++summary.sequences;
    int frame = 0;
    for (const InputImage* input : sequence) {
      try {
        step(*input, frame, tracker);
        ++summary.frames;
      } catch (const InputError& error) {
        summary.failures.push_back(error.what());
        log(LogLevel::Warning, error.what());
      }
      ++frame;
      progress_.step();
    }
    summary.instances += int(states_.size());
  }

  void finish() { files_.finish(summary, backend_.name()); }

  TrackSummary summary;

 private:
  GivenCamera given() const { return {camera_, request_.calibration.file, request_.scale_camera}; }

  // A video's frames keep their times, whichever are chosen.
  double time_of(const InputImage& input, int frame) const {
    constexpr double usual_rate = 30;
    const double rate = request_.frame_rate > 0 ? request_.frame_rate
                        : input.frame_rate > 0  ? input.frame_rate
                                                : usual_rate;
    return (input.video.empty() ? frame : input.frame) / rate;
  }

  void step(const InputImage& input, int frame, std::optional<Tracker>& tracker) {
    const auto image = std::make_shared<const Image>(read_image(input));
    if (!tracker) {
      sequence_camera_ = camera_of(input, image->width, image->height, given());
      tracker.emplace(sets_, sequence_camera_, backend_, request_.tracking);
    }
    if (const auto starts = starts_.find(input.name); starts != starts_.end())
      for (const RegisterJob::Start& start : *starts->second)
        tracker->add(start.model, start.camera_from_object);
    const TrackFrame at{image, time_of(input, frame),
                        depth_.read(input, sequence_camera_, backend_.threads())};
    if (request_.search && frame % request_.search_every == 0)
      tracker->search(at, backend_, limit_from_now(request_.max_seconds));
    const auto begin = Clock::now();
    const std::vector<Track>& tracks =
        naming(input, [&]() -> decltype(auto) { return tracker->update(at); });
    summary.update_ms.push_back(1000 * seconds_since(begin));
    count(tracks);
    files_.add(input, at.time_s, tracks);
    if (request_.overlays) draw(input, *image, tracks);
  }

  void count(std::span<const Track> tracks) {
    for (const Track& track : tracks) {
      TrackState& before = states_.try_emplace(track.id, TrackState::Doubtful).first->second;
      summary.losses += track.state == TrackState::Lost && before != TrackState::Lost;
      before = track.state;
      ++(track.state == TrackState::Tracked    ? summary.tracked
         : track.state == TrackState::Doubtful ? summary.doubtful
                                               : summary.lost);
    }
  }

  void draw(const InputImage& input, const Image& image, std::span<const Track> tracks) {
    save_png(draw_tracks(image, sequence_camera_, tracks, models_, backend_),
             overlay_of(request_.out, input));
  }

  std::span<const TemplateSet> sets_;
  std::vector<EdgeModel> models_;
  Backend& backend_;
  const TrackRequest& request_;
  std::optional<Camera> camera_;
  Camera sequence_camera_;
  DepthReader depth_;
  TrackFiles files_;
  Progress progress_;
  std::map<std::string, const std::vector<RegisterJob::Start>*> starts_;  // by name of image
  std::map<int, TrackState> states_;  // of the sequence's instances, by id
};

}  // namespace

TrackSummary run_track(std::span<const InputImage> images, std::span<const TemplateSet> sets,
                       std::span<const RegisterJob> starts, Backend& backend,
                       const TrackRequest& request) {
  const auto begin = Clock::now();
  SequenceRunner runner(images, sets, starts, backend, request);
  for (const std::vector<const InputImage*>& sequence : sequences_of(images)) runner.run(sequence);
  if (runner.summary.frames == 0) throw InputError(runner.summary.failures.back());
  runner.summary.seconds = seconds_since(begin);
  runner.finish();
  return runner.summary;
}

}  // namespace edgescout
