/* edgescout for C and for languages that call C: finds textureless rigid objects in grey images
   from their CAD models. C11; C++ may include it too. docs/c.md has a first program.

   Units     metres, radians, seconds, pixels.
   Frames    b_from_a maps points of frame a to frame b. A camera looks along +z, x is right, y is
             down; pixel centres are at integers.
   Poses     double[16]: a 4x4 matrix, row by row; the last row is 0 0 0 1.
   Errors    A function returns EDGESCOUT_OK or another status and then does nothing else: what it
             would have made is NULL. edgescout_last_error() says why in one line.
   Handles   Pointers to types that are never defined: names of what the library keeps. A name that
             is null, freed, invented, of another kind or of another library is an error, not a
             crash. edgescout_free() frees each kind. An object that others still use (templates in
             a scout, a mesh in a call of another thread) lives on until they end.
   Structs   Begin with struct_size, which the caller sets to sizeof, also where the library fills
             the rest: `edgescout_limit limit = {.struct_size = sizeof limit};`. A field that is 0
             or NULL has its default, and `reserved` is 0. So structs may grow: a newer library
             takes the fields of an older struct, an older library refuses newer fields that are not
             0.
   Strings   UTF-8. Those that a struct returns belong to the handle that was asked, and last as
             long as it does, if nothing else is said.
   Threads   All functions may be called from any thread. Handles that never change (mesh, camera,
             templates, picture, detections) and cancellers may be used by several threads at once.
             An options, a backend, a scout or a tracker is used by one call at a time: a second
             one, from another thread or from a callback, returns EDGESCOUT_BUSY. Each function says
             whom it keeps busy, where it does. A call may take a second or more; edgescout_limit
             ends it.
   Callbacks run on the thread that called, inside the call. They must return: no longjmp. No
             pthread_cancel of a thread in a call either.
   Maths     M. Imperoli, A. Pretto, arXiv:1603.07022, with the changes that docs/architecture.md
             lists. The scout is its Algorithm 2. */
#ifndef EDGESCOUT_H
#define EDGESCOUT_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define EDGESCOUT_API
#else
#define EDGESCOUT_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Versions and errors ---- */

/* Of this header. Another number: functions or the meaning of fields have changed. */
#define EDGESCOUT_ABI 0

typedef int32_t edgescout_status;
enum {
  EDGESCOUT_OK = 0,
  EDGESCOUT_NULL = 1,          /* an argument that must be there is NULL */
  EDGESCOUT_BAD_HANDLE = 2,    /* freed, or never made by this library */
  EDGESCOUT_WRONG_KIND = 3,    /* a handle of another kind */
  EDGESCOUT_BUSY = 4,          /* another call uses the handle */
  EDGESCOUT_WRONG_VERSION = 5, /* an ABI or a struct_size that this library does not know */
  EDGESCOUT_BAD_INPUT = 6,     /* a file, image, option or number cannot be used */
  EDGESCOUT_DEVICE = 7,        /* a call of the Vulkan device failed: make a new backend */
  EDGESCOUT_CANCELLED = 8,     /* the limit was over, and there is no part of a result */
  EDGESCOUT_OUT_OF_MEMORY = 9,
  EDGESCOUT_INTERNAL = 10 /* a fault of the library */
};

EDGESCOUT_API const char* edgescout_version(void); /* "0.2.0" */
EDGESCOUT_API int32_t edgescout_abi(void);         /* EDGESCOUT_ABI of the library */
/* EDGESCOUT_WRONG_VERSION where `abi`, the program's EDGESCOUT_ABI, is not that of the library. */
EDGESCOUT_API edgescout_status edgescout_require_abi(int32_t abi);

/* Of the last call on this thread that failed; "" before. Valid until the next one that fails. */
EDGESCOUT_API const char* edgescout_last_error(void);
EDGESCOUT_API const char* edgescout_status_name(edgescout_status status); /* "bad handle" */

/* Messages of the library, such as warnings of a mesh. Without a sink they are dropped. */
enum { EDGESCOUT_DEBUG = 0, EDGESCOUT_INFO = 1, EDGESCOUT_WARNING = 2, EDGESCOUT_ERROR = 3 };
typedef void (*edgescout_log_sink)(int32_t level, const char* message, void* user);
/* For the whole process; NULL: none. Threads may log at once. A message that is on its way on
   another thread may still reach the sink before. */
EDGESCOUT_API edgescout_status edgescout_set_log_sink(edgescout_log_sink sink, void* user);

/* ---- Handles ---- */

typedef struct edgescout_canceller edgescout_canceller;
typedef struct edgescout_options edgescout_options;
typedef struct edgescout_backend edgescout_backend;
typedef struct edgescout_camera edgescout_camera;
typedef struct edgescout_picture edgescout_picture;
typedef struct edgescout_mesh edgescout_mesh;
typedef struct edgescout_templates edgescout_templates;
typedef struct edgescout_detections edgescout_detections;
typedef struct edgescout_scout edgescout_scout;
typedef struct edgescout_tracker edgescout_tracker;

/* Frees a handle of any kind; NULL is nothing to do. EDGESCOUT_BUSY: a call uses the options,
   backend, scout or tracker; it stays. */
EDGESCOUT_API edgescout_status edgescout_free(const void* handle);
/* Of all kinds, in the process. A program that frees what it makes sees it constant. */
EDGESCOUT_API size_t edgescout_handle_count(void);

/* ---- Limits of long calls ---- */

/* Cancels calls from another thread. Not from a signal handler: let `cancelled` read a flag. */
EDGESCOUT_API edgescout_status edgescout_canceller_create(edgescout_canceller** out);
/* Calls with it end soon; it stays cancelled. */
EDGESCOUT_API edgescout_status edgescout_cancel(edgescout_canceller* canceller);
/* Makes it of use again for later calls. */
EDGESCOUT_API edgescout_status edgescout_canceller_reset(edgescout_canceller* canceller);

/* Whichever comes first. Calls end soon after, not at once (docs/c.md). */
typedef struct edgescout_limit {
  size_t struct_size;
  double max_seconds;                   /* from the begin of the call; 0: none */
  const edgescout_canceller* canceller; /* or NULL */
  int32_t (*cancelled)(void* user);     /* or NULL. Asked many times a second; not 0: cancel */
  void* user;
} edgescout_limit;

/* ---- Options ---- */

enum {
  EDGESCOUT_IMAGE_OPTIONS = 0,    /* how stored values become 8-bit grey */
  EDGESCOUT_TEMPLATE_OPTIONS = 1, /* viewpoints and distances of an object's templates */
  EDGESCOUT_DETECT_OPTIONS = 2,
  EDGESCOUT_REGISTER_OPTIONS = 3,
  EDGESCOUT_SCOUT_OPTIONS = 4,
  EDGESCOUT_TRACK_OPTIONS = 5,
  EDGESCOUT_DEPTH_OPTIONS = 6 /* unit and range of stored distances, noise of the sensor */
};

enum {
  EDGESCOUT_INTEGER = 0, /* "3" */
  EDGESCOUT_NUMBER = 1,  /* "0.25" */
  EDGESCOUT_RANGE = 2,   /* "0.3 0.5", or "0.3" for both ends */
  EDGESCOUT_NUMBERS = 3, /* `count` numbers "1 2 3", or none: "" */
  EDGESCOUT_FLAG = 4,    /* "true" or "false" */
  EDGESCOUT_CHOICE = 5   /* one of `words` */
};

/* Strings but `value` last as long as the options; `value` until it is set again. */
typedef struct edgescout_option {
  size_t struct_size;
  const char* name; /* as on the command line: "min-probability" */
  const char* group;
  const char* help;          /* one sentence, with the unit and what a special value means */
  int32_t type;              /* EDGESCOUT_INTEGER, .. */
  int32_t is_expert;         /* not what a first user needs */
  int32_t count;             /* of EDGESCOUT_NUMBERS */
  int32_t word_count;        /* of EDGESCOUT_CHOICE */
  double low, high;          /* bounds, inclusive */
  const char* default_value; /* as text */
  const char* value;         /* as text */
  const char* const* words;  /* `word_count` of them */
} edgescout_option;

/* Options of a kind with their defaults. Calls copy what they use: later changes concern later
   calls. Each of these functions, and a call that begins, keeps the options busy for a moment. */
EDGESCOUT_API edgescout_status edgescout_options_create(int32_t kind, edgescout_options** out);
/* Options of their own, with the same values. */
EDGESCOUT_API edgescout_status edgescout_options_copy(const edgescout_options* options,
                                                      edgescout_options** out);
/* Names have dashes or underscores. BAD_INPUT: no such name, a text of another type, out of
   bounds; the option keeps its value. */
EDGESCOUT_API edgescout_status edgescout_options_set(edgescout_options* options, const char* name,
                                                     const char* value);
/* BAD_INPUT: no such name. */
EDGESCOUT_API edgescout_status edgescout_options_get(const edgescout_options* options,
                                                     const char* name, edgescout_option* out);
EDGESCOUT_API edgescout_status edgescout_options_count(const edgescout_options* options,
                                                       size_t* out);
/* BAD_INPUT: `index` is not below the count. */
EDGESCOUT_API edgescout_status edgescout_options_at(const edgescout_options* options, size_t index,
                                                    edgescout_option* out);

/* ---- Backends: where the work is done ---- */

/* device: "auto" (a graphics card, else the processor), "cpu", "cpu-reference", "vulkan" or
   "vulkan:INDEX". threads: of "cpu", 0 for one a core; 0 with other devices. Detection, building,
   drawing and a scout's calls keep their backend busy. Threads that work at once have one each. */
EDGESCOUT_API edgescout_status edgescout_backend_create(const char* device, int32_t threads,
                                                        edgescout_backend** out);
/* "cpu", "vulkan:0 llvmpipe (LLVM 15.0.6, 256 bits)". Never busy. */
EDGESCOUT_API edgescout_status edgescout_backend_name(const edgescout_backend* backend,
                                                      const char** out);

typedef struct edgescout_device {
  size_t struct_size;
  int32_t is_hardware; /* 0: a software device such as lavapipe */
  int32_t reserved;
  uint64_t memory_bytes;
  char name[256];
  char driver[256];
} edgescout_device;

/* Vulkan devices of this machine; each call looks again. */
EDGESCOUT_API edgescout_status edgescout_device_count(size_t* out);
/* index: as in "vulkan:INDEX". */
EDGESCOUT_API edgescout_status edgescout_device_at(size_t index, edgescout_device* out);

/* ---- Cameras ---- */

enum {
  EDGESCOUT_BROWN_CONRADY = 0,          /* OpenCV's: k1 k2 p1 p2 k3 .. k6 s1 .. s4 tau_x tau_y */
  EDGESCOUT_MODIFIED_BROWN_CONRADY = 1, /* RealSense's: k1 k2 p1 p2 k3 */
  EDGESCOUT_FISHEYE = 2,                /* Kannala-Brandt: k1 .. k6 p1 p2 s1 .. s4 */
  EDGESCOUT_THIN_PRISM_FISHEYE = 3,     /* COLMAP's: k1 k2 p1 p2 k3 k4 s1 s2 */
  EDGESCOUT_FIELD_OF_VIEW = 4           /* the angle omega, rad */
};

/* u = fx x + skew y + cx, v = fy y + cy of the distorted direction (x, y, 1). */
typedef struct edgescout_camera_model {
  size_t struct_size;
  int32_t width, height; /* px. 0 and 0 of a file without a size: those of the image */
  double fx, fy, cx, cy, skew;
  int32_t lens; /* EDGESCOUT_BROWN_CONRADY, .. */
  int32_t reserved;
  double distortion[14];    /* in the order of the lens; all 0: none */
  double field_of_view_rad; /* horizontal, to which images are undistorted; 0: fx .. cy stay */
} edgescout_camera_model;

/* BAD_INPUT: a size, focal length or coefficient that no camera has. */
EDGESCOUT_API edgescout_status edgescout_camera_create(const edgescout_camera_model* model,
                                                       edgescout_camera** out);
/* A calibration file of ROS, OpenCV, Kalibr, BOP and some fifteen others (docs/cameras.md).
   name: which of several; NULL or "": the only one. */
EDGESCOUT_API edgescout_status edgescout_camera_load(const char* file, const char* name,
                                                     edgescout_camera** out);
/* As it was made, with its lens. */
EDGESCOUT_API edgescout_status edgescout_camera_get(const edgescout_camera* camera,
                                                    edgescout_camera_model* out);

/* ---- Images ---- */

/* Bytes of a pixel in the order of the name; those of 16 bit and float as the machine orders them.
   Bayer patterns are named by the first two pixels of the first two rows. */
enum {
  EDGESCOUT_MONO8 = 0,
  EDGESCOUT_MONO16 = 1,
  EDGESCOUT_FLOAT32 = 2,
  EDGESCOUT_BGR8 = 3,
  EDGESCOUT_RGB8 = 4,
  EDGESCOUT_BGRA8 = 5,
  EDGESCOUT_RGBA8 = 6,
  EDGESCOUT_BAYER_RGGB8 = 7,
  EDGESCOUT_BAYER_BGGR8 = 8,
  EDGESCOUT_BAYER_GRBG8 = 9,
  EDGESCOUT_BAYER_GBRG8 = 10,
  EDGESCOUT_BAYER_RGGB16 = 11,
  EDGESCOUT_BAYER_BGGR16 = 12,
  EDGESCOUT_BAYER_GRBG16 = 13,
  EDGESCOUT_BAYER_GBRG16 = 14,
  EDGESCOUT_BGR16 = 15,
  EDGESCOUT_RGB16 = 16,
  EDGESCOUT_BGRA16 = 17,
  EDGESCOUT_RGBA16 = 18,
  EDGESCOUT_YUYV8 = 19, /* of video formats, Y is used */
  EDGESCOUT_UYVY8 = 20,
  EDGESCOUT_MONO32 = 21 /* whole numbers; of depth images alone */
};

/* Pixels of the caller, read during the call alone. Detection works on 8-bit grey: colour is
   weighed by Rec. 601, 16 bit and float are scaled (docs/images.md). */
typedef struct edgescout_image {
  size_t struct_size;
  const void* pixels; /* the first pixel of the upper row; at any address */
  int32_t width, height;
  int64_t row_stride_bytes; /* may be negative; 0: rows follow one another */
  int32_t format;           /* EDGESCOUT_MONO8, .. */
  int32_t reserved;
  /* EDGESCOUT_IMAGE_OPTIONS, of a depth image EDGESCOUT_DEPTH_OPTIONS; NULL: the defaults */
  const edgescout_options* options;
} edgescout_image;

/* An image that the library owns. */
/* options: EDGESCOUT_IMAGE_OPTIONS or NULL. Reads as `edgescout detect` does: mono8. */
EDGESCOUT_API edgescout_status edgescout_picture_load(const char* file,
                                                      const edgescout_options* options,
                                                      edgescout_picture** out);
/* The 8-bit grey image that detection makes of pixels. */
EDGESCOUT_API edgescout_status edgescout_picture_grey(const edgescout_image* image,
                                                      edgescout_picture** out);
/* The same without the lens: of the pinhole camera. */
EDGESCOUT_API edgescout_status edgescout_picture_undistorted(const edgescout_image* image,
                                                             const edgescout_camera* camera,
                                                             edgescout_picture** out);
/* mono8 or rgb8, without padding. The pixels last as long as the picture. */
EDGESCOUT_API edgescout_status edgescout_picture_get(const edgescout_picture* picture,
                                                     edgescout_image* out);
/* Atomically. */
EDGESCOUT_API edgescout_status edgescout_picture_save_png(const edgescout_picture* picture,
                                                          const char* file);

/* ---- Meshes and templates ---- */

typedef struct edgescout_mesh_info {
  size_t struct_size;
  const char* name;
  size_t vertex_count, triangle_count;
  double diameter_m; /* largest distance between two vertices */
  double box_min_m[3], box_max_m[3];
} edgescout_mesh_info;

/* STL, PLY, OBJ, OFF, glTF, 3MF, COLLADA, CAO (docs/meshes.md). unit: "mm", "cm", "m" or "in", what
   one unit of the file is; NULL: the file says. Defects are repaired. */
EDGESCOUT_API edgescout_status edgescout_mesh_load(const char* file, const char* unit,
                                                   edgescout_mesh** out);
typedef struct edgescout_mesh_arrays {
  size_t struct_size;
  const char* name;         /* NULL: "mesh" */
  const double* vertices_m; /* x y z of each */
  size_t vertex_count;
  const int32_t* triangles; /* three indices of each, counter-clockwise seen from outside */
  size_t triangle_count;
} edgescout_mesh_arrays;
/* Copies the arrays. BAD_INPUT: an index of no vertex, a number that is none, no area. Defects are
   repaired. */
EDGESCOUT_API edgescout_status edgescout_mesh_create(const edgescout_mesh_arrays* arrays,
                                                     edgescout_mesh** out);
/* The name lasts as long as the mesh. */
EDGESCOUT_API edgescout_status edgescout_mesh_get(const edgescout_mesh* mesh,
                                                  edgescout_mesh_info* out);
/* Copies all of it: 3 numbers a vertex, 3 a triangle. Either may be NULL. */
EDGESCOUT_API edgescout_status edgescout_mesh_copy(const edgescout_mesh* mesh, double* vertices_m,
                                                   int32_t* triangles);

typedef struct edgescout_part {
  size_t struct_size;
  const edgescout_mesh* mesh;
  edgescout_backend* backend;       /* busy meanwhile; later calls may use another one */
  const edgescout_options* options; /* EDGESCOUT_TEMPLATE_OPTIONS; NULL: the defaults */
  /* Without distances in the options: all at which the object fills a twentieth to all of this
     camera's image. NULL: the options have them. */
  const edgescout_camera* camera;
  int32_t object_id; /* the caller's number of the part */
  int32_t reserved;
  /* What maps the object onto itself: words such as "z2" (a half turn about z), "z" (a surface of
     revolution), "x4 z4"; or poses. NULL, NULL: nothing. */
  const char* symmetry;
  const double* symmetry_poses; /* 16 numbers each */
  size_t symmetry_pose_count;
  /* Where templates that were built before are kept, for all programs of this version. "": the
     user's cache folder; NULL: nowhere. */
  const char* cache_folder;
  const edgescout_limit* limit; /* or NULL */
} edgescout_part;

typedef struct edgescout_templates_info {
  size_t struct_size;
  int32_t object_id;
  int32_t reserved;
  const char* name; /* of the mesh */
  double diameter_m;
  double distance_min_m, distance_max_m; /* from the camera to the object's centre */
  size_t symmetry_count;                 /* with the identity */
} edgescout_templates_info;

/* Some seconds, once a part. CANCELLED: the limit was over. */
EDGESCOUT_API edgescout_status edgescout_templates_build(const edgescout_part* part,
                                                         edgescout_templates** out);
/* Templates of several parts in one handle, in order: a copy. Detection looks for all of them. */
EDGESCOUT_API edgescout_status edgescout_templates_join(const edgescout_templates* const* parts,
                                                        size_t part_count,
                                                        edgescout_templates** out);
/* A file of this or of `edgescout model build`, with one part. */
EDGESCOUT_API edgescout_status edgescout_templates_load(const char* file,
                                                        edgescout_templates** out);
/* BAD_INPUT: templates of several parts; save each. */
EDGESCOUT_API edgescout_status edgescout_templates_save(const edgescout_templates* templates,
                                                        const char* file);
EDGESCOUT_API edgescout_status edgescout_templates_count(const edgescout_templates* templates,
                                                         size_t* out);
/* BAD_INPUT: `index` is not below the count. The name lasts as long as the templates. */
EDGESCOUT_API edgescout_status edgescout_templates_at(const edgescout_templates* templates,
                                                      size_t index, edgescout_templates_info* out);

/* ---- Detection and registration ---- */

/* One image, and where it was taken. */
typedef struct edgescout_view {
  size_t struct_size;
  const edgescout_image* image;
  const edgescout_camera* camera;  /* of the image's size, or without a size */
  const double* camera_from_world; /* 16 numbers; NULL: the world is the camera frame */
  /* What a depth sensor measured at the time of the image, or NULL: MONO16 or MONO32 (mm) or
     FLOAT32 (m), distances along the camera's axis. 0, NaN and what lies outside the range of its
     options are missing (docs/depth.md). */
  const edgescout_image* depth;
  /* The camera that took it, where that is not the camera of the image, lens included: of the depth
     image's size, or without a size. NULL: the same camera; then the sizes must be equal. */
  const edgescout_camera* depth_camera;
  /* 16 numbers: maps points of the depth camera's frame to the camera's. NULL: the same frame. */
  const double* camera_from_depth;
} edgescout_view;

typedef struct edgescout_request {
  size_t struct_size;
  const edgescout_view* views; /* all of one struct_size */
  size_t view_count;
  const edgescout_templates* templates;
  edgescout_backend* backend;       /* busy meanwhile */
  const edgescout_options* options; /* of the call's kind; NULL: the defaults */
  const edgescout_limit* limit;     /* or NULL. Over: what was found comes back, not complete */
} edgescout_request;

/* In one view, most probable first. Poses are camera_from_object: the world of the results is the
   camera frame. options: EDGESCOUT_DETECT_OPTIONS. Busy meanwhile: the backend of the request. */
EDGESCOUT_API edgescout_status edgescout_detect(const edgescout_request* request,
                                                edgescout_detections** out);
/* In all views of one static scene at once; each has its camera_from_world. Poses are
   world_from_object. options: EDGESCOUT_DETECT_OPTIONS. Busy meanwhile: the backend of the
   request. */
EDGESCOUT_API edgescout_status edgescout_detect_jointly(const edgescout_request* request,
                                                        edgescout_detections** out);

/* Poses that are known to some 0.3 rad and a tenth of the object's size. */
typedef struct edgescout_starts {
  size_t struct_size;
  const double* world_from_object; /* 16 numbers each; camera_from_object of a view without pose */
  const int32_t* objects;          /* of each, the index of its part in the templates; NULL: 0 */
  size_t count;
} edgescout_starts;
/* Refines them over all views. The results are in the order of the starts; one that no view shows
   has probability 0 and the convergence "out of sight". options: EDGESCOUT_REGISTER_OPTIONS. Busy
   meanwhile: the backend of the request. */
EDGESCOUT_API edgescout_status edgescout_register(const edgescout_request* request,
                                                  const edgescout_starts* starts,
                                                  edgescout_detections** out);

enum {
  EDGESCOUT_COMPLETE = 0,
  EDGESCOUT_DEADLINE_PASSED = 1, /* poses may be missing or not refined */
  EDGESCOUT_WAS_CANCELLED = 2    /* the same */
};

/* Results last as long as their handle, whatever becomes of what they were made from. */
typedef struct edgescout_detection {
  size_t struct_size;
  int32_t object; /* index of its part in the templates */
  int32_t object_id;
  const char* name; /* of the mesh */
  double world_from_object[16];
  /* 6x6, row by row, of world_from_object: translation (m) x y z, then rotation (rad) about the
     world's x y z through the object's origin, both applied from the left. Infinite where the edges
     do not hold the pose. docs/calibration.md says how well it fits the errors. */
  double covariance[36];
  double probability;      /* that the pose is right, [0, 1] */
  double psi;              /* mean cosine between image gradient and edge normals, [0, 1]: Eq. 10 of
                              arXiv:1603.07022 */
  double psi_z_score;      /* psi above chance, in standard errors */
  double cost_px;          /* mean distance of visible edge points to image edges, with direction */
  double matched_fraction; /* of the visible edge points: those with an image edge near */
  double unexplained_grey; /* share of the contrast that the surface does not explain, [0, 1] */
  const char* convergence; /* why the refinement stopped */
  size_t alternative_count;         /* other poses that explain the same edges */
  size_t supporting_image_count;    /* of a scout: images that alone make the pose probable */
  const int32_t* supporting_images; /* from 0 */
} edgescout_detection;

typedef struct edgescout_alternative {
  size_t struct_size;
  double world_from_object[16];
  double probability;
} edgescout_alternative;

typedef struct edgescout_stage {
  size_t struct_size;
  const char* name;
  double seconds;
} edgescout_stage;

typedef struct edgescout_summary {
  size_t struct_size;
  size_t detection_count;
  size_t stage_count;
  int32_t completion; /* EDGESCOUT_COMPLETE, .. */
  int32_t reserved;
} edgescout_summary;

/* How many there are, and whether the call was complete. */
EDGESCOUT_API edgescout_status edgescout_detections_get(const edgescout_detections* detections,
                                                        edgescout_summary* out);
/* BAD_INPUT: `index` is not below detection_count. */
EDGESCOUT_API edgescout_status edgescout_detections_at(const edgescout_detections* detections,
                                                       size_t index, edgescout_detection* out);
/* Most probable first. */
EDGESCOUT_API edgescout_status
edgescout_detections_alternative(const edgescout_detections* detections, size_t index,
                                 size_t alternative, edgescout_alternative* out);
/* Where the time went, in order. */
EDGESCOUT_API edgescout_status edgescout_detections_stage(const edgescout_detections* detections,
                                                          size_t stage, edgescout_stage* out);

/* The first view's image in grey with the edges and axes of the detections: rgb8. Green edges are
   in the image, orange ones are not. After edgescout_detect the view has no camera_from_world. The
   request's options are not used. */
EDGESCOUT_API edgescout_status edgescout_overlay(const edgescout_request* request,
                                                 const edgescout_detections* detections,
                                                 edgescout_picture** out);

/* ---- The scout: which view to take next ---- */

typedef struct edgescout_scout_plan {
  size_t struct_size;
  const edgescout_templates* templates;
  const edgescout_camera* camera;  /* takes every image; has a size */
  const double* camera_from_world; /* where the camera may be sent: 16 numbers each */
  size_t view_count;
  edgescout_backend* backend;       /* busy in each of the scout's long calls */
  const edgescout_options* options; /* EDGESCOUT_SCOUT_OPTIONS; NULL: the defaults */
  /* Whether the camera can be sent to a view, asked in propose; NULL: all can. */
  int32_t (*reachable)(int32_t view, void* user);
  void* user;
} edgescout_scout_plan;

/* BAD_INPUT: options out of bounds, no view, two views at one pose, a camera without a size. Busy
   meanwhile: the backend of the plan. */
EDGESCOUT_API edgescout_status edgescout_scout_create(const edgescout_scout_plan* plan,
                                                      edgescout_scout** out);

typedef struct edgescout_proposal {
  size_t struct_size;
  int32_t view; /* to take next, an index into the plan; -1: the end, see edgescout_scout_get */
  int32_t reserved;
  double camera_from_world[16]; /* of the view */
} edgescout_proposal;

/* The same until an image or a failure is given. CANCELLED: nothing has changed. Busy meanwhile:
   the scout and the backend of its plan. */
EDGESCOUT_API edgescout_status edgescout_scout_propose(edgescout_scout* scout,
                                                       const edgescout_limit* limit,
                                                       edgescout_proposal* out);

/* What the last proposal expected of a view, nats. All 0 before the first image. */
typedef struct edgescout_expectation {
  size_t struct_size;
  int32_t is_open; /* 0: taken or failed, the rest is 0 */
  int32_t reserved;
  double information, discovery, motion_cost;
  double value; /* information + discovery - motion_cost */
} edgescout_expectation;
/* BAD_INPUT: no such view. BUSY: another call changes the scout. */
EDGESCOUT_API edgescout_status edgescout_scout_expectation(const edgescout_scout* scout,
                                                           int32_t view,
                                                           edgescout_expectation* out);

/* Adds the image of a view, which need not be the proposed one. CANCELLED, or any other failure:
   the scout is as it was. */
typedef struct edgescout_shot {
  size_t struct_size;
  int32_t view;
  int32_t reserved;
  const edgescout_image* image;
  const double* camera_from_world; /* as measured; NULL: as planned */
  const edgescout_limit* limit;    /* or NULL */
  /* As in edgescout_view. */
  const edgescout_image* depth;
  const edgescout_camera* depth_camera;
  const double* camera_from_depth;
} edgescout_shot;
/* Busy meanwhile: the scout and the backend of its plan. */
EDGESCOUT_API edgescout_status edgescout_scout_give(edgescout_scout* scout,
                                                    const edgescout_shot* shot);
/* The view failed and is not proposed again. reason: NULL or a text for the state. Busy meanwhile:
   the scout. */
EDGESCOUT_API edgescout_status edgescout_scout_unreachable(edgescout_scout* scout, int32_t view,
                                                           const char* reason);

enum {
  EDGESCOUT_GOES_ON = 0,
  EDGESCOUT_VIEW_BUDGET = 1,
  EDGESCOUT_NO_VIEW_LEFT = 2,
  EDGESCOUT_CERTAIN = 3,
  EDGESCOUT_LITTLE_TO_LEARN = 4,
  EDGESCOUT_LITTLE_LEARNED = 5,
  EDGESCOUT_TIME_LIMIT = 6
};

typedef struct edgescout_scout_state {
  size_t struct_size;
  int32_t end; /* EDGESCOUT_GOES_ON, .. */
  int32_t reserved;
  size_t image_count, failed_count, candidate_count, particle_count;
  double entropy_nats; /* of what is undecided */
  double seconds;      /* of computing */
} edgescout_scout_state;
/* BUSY: another call changes the scout. */
EDGESCOUT_API edgescout_status edgescout_scout_get(const edgescout_scout* scout,
                                                   edgescout_scout_state* out);

/* What the image of a step changed. */
typedef struct edgescout_scout_step {
  size_t struct_size;
  int32_t view;
  int32_t searches;
  double camera_from_world[16]; /* as given */
  double entropy_nats;          /* after it */
  size_t new_candidates, detection_count;
} edgescout_scout_step;
/* BAD_INPUT: `step` is not below image_count. BUSY: another call changes the scout. */
EDGESCOUT_API edgescout_status edgescout_scout_step_at(const edgescout_scout* scout, size_t step,
                                                       edgescout_scout_step* out);

/* What it reports now, most probable first; outlives the scout. */
EDGESCOUT_API edgescout_status edgescout_scout_detections(const edgescout_scout* scout,
                                                          edgescout_detections** out);

/* The whole state in a file, atomically. */
EDGESCOUT_API edgescout_status edgescout_scout_save(const edgescout_scout* scout, const char* file);
/* Goes on from a file of the same parts, camera and views. limit: or NULL. Busy meanwhile: the
   scout and the backend of its plan. */
EDGESCOUT_API edgescout_status edgescout_scout_resume(edgescout_scout* scout, const char* file,
                                                      const edgescout_limit* limit);

/* ---- The tracker: poses from image to image ---- */

enum {
  EDGESCOUT_TRACKED = 0,
  EDGESCOUT_DOUBTFUL = 1, /* too few edges agree: the best pose found, or the predicted one */
  EDGESCOUT_LOST = 2      /* doubtful for too long, or out of the image: the last pose */
};

typedef struct edgescout_tracker_plan {
  size_t struct_size;
  const edgescout_templates* templates;
  const edgescout_camera* camera;   /* takes every image; has a size */
  edgescout_backend* backend;       /* busy in update; "cpu" is the fastest for one object */
  const edgescout_options* options; /* EDGESCOUT_TRACK_OPTIONS; NULL: the defaults */
} edgescout_tracker_plan;
/* BAD_INPUT: options out of bounds, a camera without a size. The backend is not busy. */
EDGESCOUT_API edgescout_status edgescout_tracker_create(const edgescout_tracker_plan* plan,
                                                        edgescout_tracker** out);

/* Follows an object, given by the index of its part in the templates, from a pose that is known to
   about 10 px in the next image. id: its number, which stays when it is lost and found again. Busy
   meanwhile: the tracker, but for searches. */
EDGESCOUT_API edgescout_status edgescout_tracker_add(edgescout_tracker* tracker, int32_t object,
                                                     const double camera_from_object[16],
                                                     int32_t* id);
/* Forgets it. BAD_INPUT: no such id. Busy meanwhile: the tracker, but for searches. */
EDGESCOUT_API edgescout_status edgescout_tracker_remove(edgescout_tracker* tracker, int32_t id);

typedef struct edgescout_frame {
  size_t struct_size;
  const edgescout_image* image;
  double time_s; /* when it was taken, on any clock; later than the last one */
  /* As in edgescout_view. */
  const edgescout_image* depth;
  const edgescout_camera* depth_camera;
  const double* camera_from_depth;
  /* Of edgescout_tracker_update, or NULL. Over: objects that are doubtful stay so, not registered.
     In edgescout_search it is NULL. */
  const edgescout_limit* limit;
} edgescout_frame;
/* All instances in the new image; edgescout_tracker_at has them. About a millisecond for an object
   that is tracked; for a doubtful one up to half a second on one core, in images of any size. The
   limit of the frame ends that, the option no-register leaves it out. Busy meanwhile: the tracker,
   but for searches, and the backend of its plan. */
EDGESCOUT_API edgescout_status edgescout_tracker_update(edgescout_tracker* tracker,
                                                        const edgescout_frame* frame);

typedef struct edgescout_search {
  size_t struct_size;
  edgescout_frame frame;        /* with its struct_size, without a limit */
  edgescout_backend* backend;   /* busy meanwhile; another than the plan's, if update goes on */
  const edgescout_limit* limit; /* or NULL */
} edgescout_search;
/* Looks for instances that are lost or not yet found; what it finds joins at the next update. It
   may run in another thread while update goes on: it keeps other searches busy, not the tracker.
   found: how many. */
EDGESCOUT_API edgescout_status edgescout_tracker_search(edgescout_tracker* tracker,
                                                        const edgescout_search* search,
                                                        size_t* found);

typedef struct edgescout_track {
  size_t struct_size;
  int32_t id;
  int32_t object;          /* index of its part in the templates */
  int32_t state;           /* EDGESCOUT_TRACKED, .. */
  int32_t doubtful_frames; /* in a row */
  double camera_from_object[16];
  double covariance[36]; /* as that of edgescout_detection, in the camera frame */
  double above_chance;   /* share of the edges found, above what chance gives, [0, 1] */
} edgescout_track;
/* As of the last update, in the order of their ids. BAD_INPUT: `index` is not below the count.
   BUSY: another call changes the tracker. */
EDGESCOUT_API edgescout_status edgescout_tracker_count(const edgescout_tracker* tracker,
                                                       size_t* out);
EDGESCOUT_API edgescout_status edgescout_tracker_at(const edgescout_tracker* tracker, size_t index,
                                                    edgescout_track* out);

/* ---- Poses of cameras ---- */

/* camera_from_world of a camera at `eye_m` that looks at `target_m`, the world's z up in its
   image. */
EDGESCOUT_API edgescout_status edgescout_look_at(const double eye_m[3], const double target_m[3],
                                                 double camera_from_world[16]);

/* Rings of cameras above a point, all looking at it. */
typedef struct edgescout_hemisphere {
  size_t struct_size;
  double center_m[3];
  double radius_m;
  int32_t count; /* of cameras, shared among the rings */
  int32_t elevation_count;
  const double* elevations_deg; /* of the rings; NULL: 35, 55 and 75 */
} edgescout_hemisphere;
/* 16 numbers each into `camera_from_world`, which has room for `capacity` poses; `count` is how
   many there are. NULL and 0 only count. BAD_INPUT: too little room. */
EDGESCOUT_API edgescout_status edgescout_hemisphere_views(const edgescout_hemisphere* hemisphere,
                                                          double* camera_from_world,
                                                          size_t capacity, size_t* count);

#ifdef __cplusplus
}
#endif

#endif
