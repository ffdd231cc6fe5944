// Everything that a first program needs: meshes, cameras, templates, detection, refinement.
//
// Public header. Active detection has a header of its own: host/active/scout.h.
#pragma once

#include "host/core/log.h"
#include "host/io/bop.h"
#include "host/io/camera_file.h"
#include "host/io/depth_file.h"
#include "host/io/depth_registration.h"
#include "host/io/image.h"
#include "host/io/mesh.h"
#include "host/io/poses.h"
#include "host/io/results.h"
#include "host/model/axis_symmetry.h"
#include "host/model/template_cache.h"
#include "host/model/template_set.h"
#include "host/overlay.h"
#include "host/pipeline.h"
#include "host/register_objects.h"
#include "kernels/backend.h"
