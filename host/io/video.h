// Internal to host: reads the frames of video files.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>

#include "host/core/types.h"
#include "host/io/image_options.h"

namespace edgescout {

// Whether a file's name has one of the endings of videos, in any case.
bool has_video_extension(const std::filesystem::path& file);

// Reads through the whole video: what a header says of its length is often wrong. Warns where the
// header promises more. InputError: the file is missing or no frame can be read.
int count_frames(const std::filesystem::path& video);

// Frames a second as the header says; 0: it does not. InputError as count_frames.
double stated_frame_rate(const std::filesystem::path& video);

// Reads frames forward, and from the start again where an earlier one is asked for: to leap to a
// frame is not exact in most formats. Holds one file open. May be used by several threads.
class VideoReader {
 public:
  VideoReader();
  ~VideoReader();
  // The frame as load_image gives images. The first one is 0. InputError naming it: the video ends
  // before, or it cannot be decoded.
  Image frame(const std::filesystem::path& video, int index, const ImageOptions& options);

 private:
  struct Open;
  std::mutex mutex_;
  std::unique_ptr<Open> open_;
};

// "parts.avi#000012", the name of a frame in messages and results.
std::filesystem::path name_of_frame(const std::filesystem::path& video, int index);

}  // namespace edgescout
