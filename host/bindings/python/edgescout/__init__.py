"""Finds textureless rigid objects in grey images from their CAD models.

Lengths are in metres, angles in rad. A pose is a 4x4 matrix named by its frames: `b_from_a` maps
points of frame a to frame b. Camera frames have z forward, x right, y down; pixel centres are at
integers.
"""

from ._core import (
    Alternative as Alternative,
    Backend as Backend,
    Camera as Camera,
    Detection as Detection,
    Detections as Detections,
    DetectOptions as DetectOptions,
    Device as Device,
    DeviceError as DeviceError,
    ImageOptions as ImageOptions,
    InputError as InputError,
    Instance as Instance,
    LensModel as LensModel,
    LogicError as LogicError,
    Mesh as Mesh,
    Proposal as Proposal,
    Scout as Scout,
    ScoutOptions as ScoutOptions,
    TemplateOptions as TemplateOptions,
    Templates as Templates,
    Track as Track,
    Tracker as Tracker,
    TrackOptions as TrackOptions,
    TrackState as TrackState,
    __version__ as __version__,
    detect as detect,
    detect_jointly as detect_jointly,
    devices as devices,
    hemisphere_views as hemisphere_views,
    load_camera as load_camera,
    load_image as load_image,
    load_mesh as load_mesh,
    look_at as look_at,
    overlay as overlay,
    register as register,
    register_jointly as register_jointly,
    save_png as save_png,
    to_grey as to_grey,
    undistort as undistort,
)
