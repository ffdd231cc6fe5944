"""Finds textureless rigid objects in grey images from their CAD models.

Lengths are in metres, angles in rad. A pose is a 4x4 matrix named by its frames: `b_from_a` maps
points of frame a to frame b. Camera frames have z forward, x right, y down; pixel centres are at
integers.
"""

from ._core import (
    Alternative,
    Backend,
    Camera,
    Cancelled,
    Detection,
    Detections,
    DetectOptions,
    Device,
    DeviceError,
    InputError,
    Instance,
    LensModel,
    LogicError,
    Mesh,
    Proposal,
    Scout,
    ScoutOptions,
    TemplateOptions,
    Templates,
    __version__,
    detect,
    detect_jointly,
    devices,
    hemisphere_views,
    load_camera,
    load_image,
    load_mesh,
    look_at,
    overlay,
    register,
    register_jointly,
    save_png,
    undistort,
)

__all__ = [name for name in dir() if not name.startswith("_")]
