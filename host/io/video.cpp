#include "host/io/video.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <opencv2/videoio.hpp>
#include <set>

#include "host/core/log.h"
#include "host/io/files.h"
#include "host/io/from_mat.h"
#include "host/io/grey_levels.h"
#include "host/io/to_grey.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

// The backends that read files. Others take a name for a pattern of image names or an address.
cv::VideoCapture open_video(const fs::path& video) {
  open_file(video);  // its error says why a file cannot be read
  for (const int backend : {cv::CAP_FFMPEG, cv::CAP_OPENCV_MJPEG}) {
    cv::VideoCapture capture;
    try {
      if (!capture.open(fs::absolute(video).string(), backend)) continue;
    } catch (const cv::Exception&) {
      continue;
    }
    capture.set(cv::CAP_PROP_ORIENTATION_AUTO, 0);  // pixels are used as they are stored
    return capture;
  }
  throw InputError(video.string(), "video", "data that no video decoder accepts",
                   "a video that OpenCV reads");
}

void mention_turned(const cv::VideoCapture& capture, const fs::path& video) {
  static std::atomic_flag was_logged;
  const double turned_deg = capture.get(cv::CAP_PROP_ORIENTATION_META);
  if (turned_deg != 0 && std::isfinite(turned_deg) && !was_logged.test_and_set())
    log(LogLevel::Warning,
        video.string() + ": orientation: found " + std::to_string(int(turned_deg)) +
            " degrees, expected 0: the pixels are used as they are stored, and the calibration "
            "must be of these (not repeated for further videos)");
}

// A header may lack the number of frames, or hold one that was guessed from the length of the file.
int stated_frames(const cv::VideoCapture& capture) {
  const double stated = capture.get(cv::CAP_PROP_FRAME_COUNT);
  return stated > 0 && stated < 1e9 ? static_cast<int>(stated) : 0;
}

}  // namespace

bool has_video_extension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return char(std::tolower(c)); });
  static const std::set<std::string> known{".avi", ".mp4",  ".m4v",  ".mov", ".mkv", ".webm",
                                           ".mpg", ".mpeg", ".mjpg", ".wmv", ".flv", ".ts",
                                           ".3gp", ".ogv",  ".mts",  ".h264"};
  return known.contains(extension);
}

int count_frames(const fs::path& video) {
  cv::VideoCapture capture = open_video(video);
  mention_turned(capture, video);
  int count = 0;
  while (capture.grab()) ++count;
  const int stated = stated_frames(capture);
  if (count == 0)
    throw InputError(video.string(), "video", "no frame that can be read", "at least one");
  if (count < stated)
    log(LogLevel::Warning, video.string() + ": frames: found " + std::to_string(count) +
                               " that can be read, expected " + std::to_string(stated) +
                               " as the header says");
  return count;
}

double stated_frame_rate(const fs::path& video) {
  const double rate = open_video(video).get(cv::CAP_PROP_FPS);
  return rate > 0 && std::isfinite(rate) ? rate : 0;
}

struct VideoReader::Open {
  fs::path video;
  cv::VideoCapture capture;
  int next = 0;  // frame that grab() reads
};

VideoReader::VideoReader() = default;
VideoReader::~VideoReader() = default;

Image VideoReader::frame(const fs::path& video, int index, const ImageOptions& options) {
  const std::lock_guard lock(mutex_);
  if (!open_ || open_->video != video || open_->next > index)
    open_ = std::make_unique<Open>(Open{video, open_video(video)});
  const std::string source = name_of_frame(video, index).string();
  for (; open_->next <= index; ++open_->next)
    if (!open_->capture.grab())
      throw InputError(source, "frame", "an end after " + std::to_string(open_->next) + " frames",
                       "the frame");
  cv::Mat pixels;
  if (!open_->capture.retrieve(pixels) || pixels.empty())
    throw InputError(source, "frame", "data that cannot be decoded", "a frame");
  require_least_size(pixels, source);
  return from_mat(to_8_bit(to_grey(pixels, options.bayer, source), options, source));
}

fs::path name_of_frame(const fs::path& video, int index) {
  char number[16];
  std::snprintf(number, sizeof number, "#%06d", index);
  return video.string() + number;
}

}  // namespace edgescout
