// What the sensor and the camera's own processing do. One function does each effect.
//
// Light is CV_32F; 1 is white. Grey levels are CV_64F from 0 to 255 until they are rounded.
#pragma once

#include <opencv2/core.hpp>

#include "host/core/random.h"
#include "host/core/types.h"

namespace edgescout {

// Adds noise to the light, such that the display curve makes `sigma_grey` of it at grey 128. Half
// of that variance is the same everywhere (read noise), half grows with the light (shot noise).
void add_sensor_noise(cv::Mat& light, double sigma_grey, double gamma, const Random& random);

// Clips the light and applies the display curve: grey = 255 light^(1 / gamma).
cv::Mat display_curve(const cv::Mat& light, double gamma);

// Adds the same noise at every grey level.
void add_grey_noise(cv::Mat& grey, double sigma_grey, const Random& random);

// Adds `amount` times the difference to a Gaussian blur (unsharp mask).
void sharpen(cv::Mat& grey, double amount, double radius_px);

Image round_to_image(const cv::Mat& grey);

// Compresses and decodes. Quality 1 to 100; 0: the image stays as it is.
Image through_jpeg(const Image& image, int quality);

}  // namespace edgescout
