/* Pixels of every format, with strides, become the same grey image; others are refused. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/bindings/c/scene.h"

enum { WIDTH = 40, HEIGHT = 30, AREA = WIDTH * HEIGHT };

static uint8_t grey[AREA];

static void make_grey(void) {
  for (int i = 0; i < AREA; ++i) grey[i] = (uint8_t)((i * 37 + i / WIDTH * 11) % 256);
}

static edgescout_image image_of(const void* pixels, int32_t format) {
  return (edgescout_image){.struct_size = sizeof(edgescout_image),
                           .pixels = pixels,
                           .width = WIDTH,
                           .height = HEIGHT,
                           .format = format};
}

/* The same pixels in a block of their own that begins and ends with them, at an address as odd as
   theirs: one byte too far is found by what watches memory. */
static edgescout_image alone(edgescout_image image, void** block) {
  static const int pixel_bytes[] = {1, 2, 4, 3, 3, 4, 4, 1, 1, 1, 1, 2, 2, 2, 2, 6, 6, 8, 8, 2, 2};
  const int64_t row = (int64_t)image.width * pixel_bytes[image.format];
  const int64_t stride = image.row_stride_bytes ? image.row_stride_bytes : row;
  const int64_t below = stride * (image.height - 1); /* of the first row */
  const size_t odd = (uintptr_t)image.pixels & 1;
  uint8_t* const bytes = malloc(odd + (size_t)(row + (below < 0 ? -below : below)));
  *block = bytes;
  uint8_t* const first = bytes + odd + (below < 0 ? -below : 0);
  for (int64_t y = 0; y < image.height; ++y)
    memcpy(first + y * stride, (const uint8_t*)image.pixels + y * stride, (size_t)row);
  image.pixels = first;
  return image;
}

static int largest_difference(const edgescout_image* image, const uint8_t* expected) {
  void* block = NULL;
  const edgescout_image given = alone(*image, &block);
  edgescout_picture* picture = NULL;
  OK(es_picture_grey(&given, &picture));
  free(block); /* read during the call alone */
  edgescout_image out = {.struct_size = sizeof out};
  OK(es_picture_get(picture, &out));
  CHECK(out.width == image->width && out.height == image->height);
  CHECK(out.format == EDGESCOUT_MONO8 && out.row_stride_bytes == out.width);
  int largest = 0;
  for (int i = 0; i < AREA; ++i)
    if (abs(((const uint8_t*)out.pixels)[i] - expected[i]) > largest)
      largest = abs(((const uint8_t*)out.pixels)[i] - expected[i]);
  OK(es_free(picture));
  return largest;
}

/* All colours equal: the grey value. One colour alone: its weight. */
static void expect_colours(void) {
  const struct {
    int32_t format;
    int channels, red, blue;
  } formats[] = {{EDGESCOUT_BGR8, 3, 2, 0},
                 {EDGESCOUT_RGB8, 3, 0, 2},
                 {EDGESCOUT_BGRA8, 4, 2, 0},
                 {EDGESCOUT_RGBA8, 4, 0, 2}};
  static uint8_t pixels[4 * AREA];
  static uint8_t red[AREA], blue[AREA];
  for (int i = 0; i < AREA; ++i) {
    red[i] = (uint8_t)(0.299 * grey[i] + 0.5);
    blue[i] = (uint8_t)(0.114 * grey[i] + 0.5);
  }
  for (size_t f = 0; f < sizeof formats / sizeof *formats; ++f) {
    const int channels = formats[f].channels;
    const edgescout_image image = image_of(pixels, formats[f].format);
    for (int i = 0; i < AREA * channels; ++i)
      pixels[i] = i % channels == 3 ? 77 : grey[i / channels];
    CHECK(largest_difference(&image, grey) == 0);
    memset(pixels, 0, sizeof pixels);
    for (int i = 0; i < AREA; ++i) pixels[i * channels + formats[f].red] = grey[i];
    CHECK(largest_difference(&image, red) <= 1);
    memset(pixels, 0, sizeof pixels);
    for (int i = 0; i < AREA; ++i) pixels[i * channels + formats[f].blue] = grey[i];
    CHECK(largest_difference(&image, blue) <= 1);
  }
}

/* Padding, upwards rows, any address. */
static void expect_strides(void) {
  static uint8_t padded[HEIGHT * (WIDTH + 7) + 1];
  memset(padded, 0xff, sizeof padded);
  for (int y = 0; y < HEIGHT; ++y) memcpy(padded + 1 + y * (WIDTH + 7), grey + y * WIDTH, WIDTH);
  edgescout_image image = image_of(padded + 1, EDGESCOUT_MONO8);
  image.row_stride_bytes = WIDTH + 7;
  CHECK(largest_difference(&image, grey) == 0);
  for (int y = 0; y < HEIGHT; ++y)
    memcpy(padded + (HEIGHT - 1 - y) * WIDTH, grey + y * WIDTH, WIDTH);
  image.pixels = padded + (HEIGHT - 1) * WIDTH;
  image.row_stride_bytes = -WIDTH;
  CHECK(largest_difference(&image, grey) == 0);
}

static void expect_depths(edgescout_options* full) {
  static unsigned char bytes[1 + 4 * AREA];
  for (int i = 0; i < AREA; ++i) {
    const uint16_t deep = (uint16_t)(257 * grey[i]);
    memcpy(bytes + 1 + 2 * i, &deep, sizeof deep);
  }
  edgescout_image image = image_of(bytes + 1, EDGESCOUT_MONO16); /* at an odd address */
  image.options = full;
  CHECK(largest_difference(&image, grey) == 0);
  for (int i = 0; i < AREA; ++i) {
    const float real = (float)grey[i] / 255;
    memcpy(bytes + 1 + 4 * i, &real, sizeof real);
  }
  image.format = EDGESCOUT_FLOAT32;
  CHECK(largest_difference(&image, grey) == 0);
}

/* A mosaic whose colours all are the same grey level, which its interpolation keeps. */
static void expect_mosaics(edgescout_options* full) {
  static uint16_t deep[AREA];
  static uint8_t even[AREA];
  memset(even, 100, sizeof even);
  for (int i = 0; i < AREA; ++i) deep[i] = 257 * 100;
  for (int32_t format = EDGESCOUT_BAYER_RGGB8; format <= EDGESCOUT_BAYER_GBRG16; ++format) {
    edgescout_image image =
        image_of(format < EDGESCOUT_BAYER_RGGB16 ? (const void*)even : deep, format);
    image.options = full;
    CHECK(largest_difference(&image, even) <= (format < EDGESCOUT_BAYER_RGGB16)); /* rounding */
  }
  /* Only red is bright: red pixels are where the pattern says. */
  static uint8_t red[AREA];
  for (int i = 0; i < AREA; ++i) red[i] = (i % WIDTH % 2 == 0 && i / WIDTH % 2 == 0) ? 200 : 0;
  static uint8_t weight[AREA];
  memset(weight, (int)(0.299 * 200 + 0.5), sizeof weight);
  edgescout_image image = image_of(red, EDGESCOUT_BAYER_RGGB8);
  CHECK(largest_difference(&image, weight) <= 1);
  image.format = EDGESCOUT_BAYER_BGGR8; /* now it is blue */
  memset(weight, (int)(0.114 * 200 + 0.5), sizeof weight);
  CHECK(largest_difference(&image, weight) <= 1);
  /* The option does the same to mono8. */
  edgescout_options* pattern = NULL;
  OK(es_options_create(EDGESCOUT_IMAGE_OPTIONS, &pattern));
  OK(es_options_set(pattern, "bayer", "bggr"));
  image.format = EDGESCOUT_MONO8;
  image.options = pattern;
  CHECK(largest_difference(&image, weight) <= 1);
  image.format = EDGESCOUT_BAYER_BGGR8;
  edgescout_picture* picture = NULL;
  EXPECT(EDGESCOUT_BAD_INPUT, es_picture_grey(&image, &picture));
  SAYS("image: format: found colours of its own");
  OK(es_free(pattern));
}

static void expect_refused(edgescout_image image, const char* message) {
  edgescout_picture* picture = NULL;
  EXPECT(EDGESCOUT_BAD_INPUT, es_picture_grey(&image, &picture));
  SAYS(message);
  CHECK(picture == NULL);
}

static void expect_refusals(void) {
  edgescout_image image = image_of(grey, -1);
  expect_refused(image, "image.format: found -1");
  image.format = 22;
  expect_refused(image, "image.format: found 22");
  image = image_of(grey, EDGESCOUT_MONO32);
  expect_refused(image, "image: format: found whole numbers of 32 bit, expected a picture");
  image = image_of(grey, EDGESCOUT_MONO8);
  image.width = -40;
  expect_refused(image, "pixels: found -40x30");
  image.width = 15;
  expect_refused(image, "image size: found 15x30, expected at least 16x16 px");
  image.width = image.height = 1 << 20;
  expect_refused(image, "image size: found 1048576x1048576");
  image = image_of(grey, EDGESCOUT_RGB8);
  image.row_stride_bytes = WIDTH;
  expect_refused(image, "row stride: found 40 bytes, expected at least the 120 of 40 pixels");
  image.row_stride_bytes = -WIDTH;
  expect_refused(image, "row stride: found -40 bytes");
  image.row_stride_bytes = INT64_MIN;
  expect_refused(image, "row stride: found ");
}

static void expect_the_cameras_size(void) {
  struct scene scene;
  open_scene(&scene);
  edgescout_image image = scene.image;
  image.height = 100;
  scene.view.image = &image;
  edgescout_detections* out = NULL;
  EXPECT(EDGESCOUT_BAD_INPUT, es_detect(&scene.request, &out));
  SAYS("200x100");
  SAYS("200x210");
  /* Without a lens the undistorted image is the image. */
  edgescout_picture* picture = NULL;
  edgescout_image same = {.struct_size = sizeof same}, whole = same;
  OK(es_picture_undistorted(&scene.image, scene.camera, &picture));
  OK(es_picture_get(picture, &same));
  for (int y = 0; y < same.height; ++y)
    CHECK(memcmp((const uint8_t*)same.pixels + y * same.row_stride_bytes,
                 (const uint8_t*)scene.image.pixels + y * scene.image.row_stride_bytes,
                 (size_t)same.width) == 0);
  OK(es_free(picture));
  OK(es_picture_get(scene.picture, &whole));
  /* A written picture is read again. */
  OK(es_picture_save_png(scene.picture, "c_interface_picture.png"));
  OK(es_picture_load("c_interface_picture.png", NULL, &picture));
  OK(es_picture_get(picture, &same));
  CHECK(memcmp(same.pixels, whole.pixels, 640 * 480) == 0);
  OK(es_free(picture));
  remove("c_interface_picture.png");
  EXPECT(EDGESCOUT_BAD_INPUT, es_picture_load("no_such.png", NULL, &picture));
  SAYS("no_such.png");
  EXPECT(EDGESCOUT_BAD_INPUT, es_picture_save_png(scene.picture, "/no/such/folder/a.png"));
  close_scene(&scene);
}

void test_images(void) {
  make_grey();
  edgescout_options* full = NULL;
  OK(es_options_create(EDGESCOUT_IMAGE_OPTIONS, &full));
  OK(es_options_set(full, "image-scaling", "full"));
  expect_colours();
  expect_strides();
  expect_depths(full);
  expect_mosaics(full);
  expect_refusals();
  expect_the_cameras_size();
  OK(es_free(full));
}
