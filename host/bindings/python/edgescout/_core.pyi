"""Types of the module of C++. Shapes and units are in the docstrings of the module itself."""

import os
import pathlib
from typing import Callable, ClassVar, Dict, Iterator, List, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

__version__: str

Path = Union[str, "os.PathLike[str]"]
Image = npt.NDArray[np.uint8]
AnyImage = Union[Image, npt.NDArray[np.uint16], npt.NDArray[np.float32]]
Depth = Union[npt.NDArray[np.uint16], npt.NDArray[np.uint32], npt.NDArray[np.float32]]
Matrix = npt.NDArray[np.float64]

class InputError(ValueError): ...
class DeviceError(RuntimeError): ...
class LogicError(RuntimeError): ...
class Cancelled(RuntimeError): ...

class LensModel:
    BROWN_CONRADY: LensModel
    MODIFIED_BROWN_CONRADY: LensModel
    FISHEYE: LensModel
    THIN_PRISM_FISHEYE: LensModel
    FIELD_OF_VIEW: LensModel
    __members__: ClassVar[Dict[str, LensModel]]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __index__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class Camera:
    def __init__(
        self,
        width: int,
        height: int,
        K: npt.ArrayLike,
        distortion: npt.ArrayLike = ...,
        lens: LensModel = ...,
    ) -> None: ...
    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    @property
    def K(self) -> Matrix: ...
    @property
    def distortion(self) -> Matrix: ...
    @property
    def lens(self) -> LensModel: ...
    def undistorted(self) -> Camera: ...
    def scaled(self, factor: float) -> Camera: ...
    def with_size(self, width: int, height: int) -> Camera: ...

def load_camera(file: Path, name: str = ...) -> Camera: ...
def load_image(file: Path, options: Optional[ImageOptions] = ...) -> Image: ...
def to_grey(image: AnyImage, options: Optional[ImageOptions] = ...) -> Image: ...
def save_png(image: Image, file: Path) -> None: ...
def undistort(image: AnyImage, camera: Camera) -> Image: ...

class Device:
    @property
    def index(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def driver(self) -> str: ...
    @property
    def is_hardware(self) -> bool: ...
    @property
    def memory_bytes(self) -> int: ...

def devices() -> List[Device]: ...

class Backend:
    def __init__(self, device: str = ..., *, threads: int = ...) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def is_hardware(self) -> bool: ...

# The classes of options are written by scripts/option_stubs.py.
class ImageOptions:
    bayer: str
    image_scaling: str
    image_range: Sequence[float]
    raw_size: Sequence[float]
    def __init__(
        self, *, bayer: str = ..., image_scaling: str = ..., image_range: Sequence[float] = ...,
        raw_size: Sequence[float] = ...
    ) -> None: ...
    def copy(self) -> ImageOptions: ...
    def help(self) -> Dict[str, str]: ...

class DepthOptions:
    depth_unit: float
    depth_range: Tuple[float, float]
    depth_noise: float
    depth_noise_floor: float
    def __init__(
        self, *, depth_unit: float = ..., depth_range: Tuple[float, float] = ...,
        depth_noise: float = ..., depth_noise_floor: float = ...
    ) -> None: ...
    def copy(self) -> DepthOptions: ...
    def help(self) -> Dict[str, str]: ...

class TemplateOptions:
    distance_min: float
    distance_max: float
    distance_ratio: float
    viewpoints: int
    in_plane_steps: int
    latitude_min: float
    latitude_max: float
    longitude_min: float
    longitude_max: float
    crease_angle: float
    raster_step: float
    def __init__(
        self, *, distance_min: float = ..., distance_max: float = ..., distance_ratio: float = ...,
        viewpoints: int = ..., in_plane_steps: int = ..., latitude_min: float = ...,
        latitude_max: float = ..., longitude_min: float = ..., longitude_max: float = ...,
        crease_angle: float = ..., raster_step: float = ...
    ) -> None: ...
    def copy(self) -> TemplateOptions: ...
    def help(self) -> Dict[str, str]: ...

class DetectOptions:
    edges: str
    edge_sigma: float
    edge_low: float
    edge_high: float
    edge_min_length: int
    faint_edges: bool
    bins: int
    lambda_: float
    smoothing_variance: float
    cap: float
    template_points: int
    anchor_step: int
    scan_hits: int
    coarse_poses: int
    medium_poses: int
    coarse_poses_joint: int
    medium_poses_joint: int
    support_views: int
    candidates: int
    enlarge_below: float
    min_probability: float
    region_x: float
    region_y: float
    region_width: float
    region_height: float
    restart_rotation: float
    max_detections: int
    penetration: float
    world_box: Sequence[float]
    world_plane: Sequence[float]
    plane_tolerance: float
    max_claimed: float
    def __init__(
        self, *, edges: str = ..., edge_sigma: float = ..., edge_low: float = ...,
        edge_high: float = ..., edge_min_length: int = ..., faint_edges: bool = ...,
        bins: int = ..., lambda_: float = ..., smoothing_variance: float = ..., cap: float = ...,
        template_points: int = ..., anchor_step: int = ..., scan_hits: int = ...,
        coarse_poses: int = ..., medium_poses: int = ..., coarse_poses_joint: int = ...,
        medium_poses_joint: int = ..., support_views: int = ..., candidates: int = ...,
        enlarge_below: float = ..., min_probability: float = ..., region_x: float = ...,
        region_y: float = ..., region_width: float = ..., region_height: float = ...,
        restart_rotation: float = ..., max_detections: int = ..., penetration: float = ...,
        world_box: Sequence[float] = ..., world_plane: Sequence[float] = ...,
        plane_tolerance: float = ..., max_claimed: float = ...
    ) -> None: ...
    def copy(self) -> DetectOptions: ...
    def help(self) -> Dict[str, str]: ...

class RegisterOptions:
    search_rotation: float
    search_kept: int
    solver: str
    edge_icp: bool
    edges: str
    edge_sigma: float
    edge_low: float
    edge_high: float
    edge_min_length: int
    faint_edges: bool
    bins: int
    lambda_: float
    smoothing_variance: float
    cap: float
    def __init__(
        self, *, search_rotation: float = ..., search_kept: int = ..., solver: str = ...,
        edge_icp: bool = ..., edges: str = ..., edge_sigma: float = ..., edge_low: float = ...,
        edge_high: float = ..., edge_min_length: int = ..., faint_edges: bool = ...,
        bins: int = ..., lambda_: float = ..., smoothing_variance: float = ..., cap: float = ...
    ) -> None: ...
    def copy(self) -> RegisterOptions: ...
    def help(self) -> Dict[str, str]: ...

class ScoutOptions:
    max_views: int
    min_entropy: float
    min_information: float
    min_gained: float
    max_seconds: float
    first_view: int
    strategy: str
    metre_cost: float
    radian_cost: float
    map_reduction: float
    chamfer_cap: float
    sigma: float
    combinations: int
    penetration: float
    particles: int
    max_candidates: int
    known_probability: float
    max_searches: int
    edges: str
    edge_sigma: float
    edge_low: float
    edge_high: float
    edge_min_length: int
    faint_edges: bool
    bins: int
    lambda_: float
    smoothing_variance: float
    cap: float
    template_points: int
    anchor_step: int
    scan_hits: int
    coarse_poses: int
    medium_poses: int
    coarse_poses_joint: int
    medium_poses_joint: int
    support_views: int
    candidates: int
    world_box: Sequence[float]
    world_plane: Sequence[float]
    plane_tolerance: float
    min_probability: float
    max_claimed: float
    def __init__(
        self, *, max_views: int = ..., min_entropy: float = ..., min_information: float = ...,
        min_gained: float = ..., max_seconds: float = ..., first_view: int = ...,
        strategy: str = ..., metre_cost: float = ..., radian_cost: float = ...,
        map_reduction: float = ..., chamfer_cap: float = ..., sigma: float = ...,
        combinations: int = ..., penetration: float = ..., particles: int = ...,
        max_candidates: int = ..., known_probability: float = ..., max_searches: int = ...,
        edges: str = ..., edge_sigma: float = ..., edge_low: float = ..., edge_high: float = ...,
        edge_min_length: int = ..., faint_edges: bool = ..., bins: int = ..., lambda_: float = ...,
        smoothing_variance: float = ..., cap: float = ..., template_points: int = ...,
        anchor_step: int = ..., scan_hits: int = ..., coarse_poses: int = ...,
        medium_poses: int = ..., coarse_poses_joint: int = ..., medium_poses_joint: int = ...,
        support_views: int = ..., candidates: int = ..., world_box: Sequence[float] = ...,
        world_plane: Sequence[float] = ..., plane_tolerance: float = ...,
        min_probability: float = ..., max_claimed: float = ...
    ) -> None: ...
    def copy(self) -> ScoutOptions: ...
    def help(self) -> Dict[str, str]: ...

class TrackOptions:
    instances: int
    track_points: int
    search_px: float
    far_search_px: float
    track_contrast: float
    tracked_above_chance: float
    lost_above_chance: float
    no_register: bool
    doubtful_frames: int
    edges: str
    edge_sigma: float
    edge_low: float
    edge_high: float
    edge_min_length: int
    faint_edges: bool
    bins: int
    lambda_: float
    smoothing_variance: float
    cap: float
    template_points: int
    anchor_step: int
    scan_hits: int
    coarse_poses: int
    medium_poses: int
    coarse_poses_joint: int
    medium_poses_joint: int
    support_views: int
    candidates: int
    enlarge_below: float
    min_probability: float
    region_x: float
    region_y: float
    region_width: float
    region_height: float
    restart_rotation: float
    max_detections: int
    penetration: float
    world_box: Sequence[float]
    world_plane: Sequence[float]
    plane_tolerance: float
    max_claimed: float
    def __init__(
        self, *, instances: int = ..., track_points: int = ..., search_px: float = ...,
        far_search_px: float = ..., track_contrast: float = ..., tracked_above_chance: float = ...,
        lost_above_chance: float = ..., no_register: bool = ..., doubtful_frames: int = ...,
        edges: str = ..., edge_sigma: float = ..., edge_low: float = ..., edge_high: float = ...,
        edge_min_length: int = ..., faint_edges: bool = ..., bins: int = ..., lambda_: float = ...,
        smoothing_variance: float = ..., cap: float = ..., template_points: int = ...,
        anchor_step: int = ..., scan_hits: int = ..., coarse_poses: int = ...,
        medium_poses: int = ..., coarse_poses_joint: int = ..., medium_poses_joint: int = ...,
        support_views: int = ..., candidates: int = ..., enlarge_below: float = ...,
        min_probability: float = ..., region_x: float = ..., region_y: float = ...,
        region_width: float = ..., region_height: float = ..., restart_rotation: float = ...,
        max_detections: int = ..., penetration: float = ..., world_box: Sequence[float] = ...,
        world_plane: Sequence[float] = ..., plane_tolerance: float = ..., max_claimed: float = ...
    ) -> None: ...
    def copy(self) -> TrackOptions: ...
    def help(self) -> Dict[str, str]: ...

class Mesh:
    def __init__(
        self, vertices_m: npt.ArrayLike, triangles: npt.ArrayLike, name: str = ...
    ) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def vertices_m(self) -> Matrix: ...
    @property
    def triangles(self) -> npt.NDArray[np.int32]: ...
    @property
    def diameter_m(self) -> float: ...

def load_mesh(file: Path, unit: str) -> Mesh: ...

class Templates:
    def __init__(
        self,
        mesh: Mesh,
        options: Optional[TemplateOptions] = ...,
        *,
        camera: Optional[Camera] = ...,
        symmetries: Union[None, str, npt.ArrayLike] = ...,
        object_id: int = ...,
        backend: Optional[Backend] = ...,
        cached: bool = ...,
    ) -> None: ...
    @staticmethod
    def without_views(
        mesh: Mesh,
        *,
        symmetries: Union[None, str, npt.ArrayLike] = ...,
        object_id: int = ...,
    ) -> Templates: ...
    @staticmethod
    def load(file: Path) -> Templates: ...
    def save(self, file: Path) -> None: ...
    @property
    def object_id(self) -> int: ...
    @property
    def mesh(self) -> Mesh: ...
    @property
    def symmetries(self) -> Matrix: ...
    @property
    def options(self) -> TemplateOptions: ...

class BopTruth:
    @property
    def object_id(self) -> int: ...
    @property
    def camera_from_object(self) -> Matrix: ...
    @property
    def visible_fraction(self) -> float: ...

class BopImage:
    @property
    def image_id(self) -> int: ...
    @property
    def file(self) -> pathlib.Path: ...
    @property
    def camera(self) -> Camera: ...
    @property
    def camera_from_world(self) -> Optional[Matrix]: ...

class BopScene:
    @property
    def scene_id(self) -> int: ...
    @property
    def camera_name(self) -> str: ...
    @property
    def images(self) -> List[BopImage]: ...
    def truth(self, image_id: int) -> List[BopTruth]: ...

class BopResult:
    def __init__(
        self,
        scene_id: int,
        image_id: int,
        object_id: int,
        score: float,
        camera_from_object: npt.ArrayLike,
        time_s: float = ...,
        camera_name: str = ...,
    ) -> None: ...
    @property
    def scene_id(self) -> int: ...
    @property
    def image_id(self) -> int: ...
    @property
    def object_id(self) -> int: ...
    @property
    def score(self) -> float: ...
    @property
    def camera_from_object(self) -> Matrix: ...
    @property
    def time_s(self) -> float: ...
    @property
    def camera_name(self) -> str: ...

def bop_cameras(folder: Path) -> List[str]: ...
def load_bop_scene(folder: Path, camera_name: str = ...) -> BopScene: ...
def load_bop_results(file: Path) -> List[BopResult]: ...
def save_bop_results(results: Sequence[BopResult], file: Path) -> None: ...

class Alternative:
    @property
    def world_from_object(self) -> Matrix: ...
    @property
    def probability(self) -> float: ...

class Detection:
    @property
    def object(self) -> int: ...
    @property
    def object_id(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def world_from_object(self) -> Matrix: ...
    @property
    def covariance(self) -> Matrix: ...
    @property
    def probability(self) -> float: ...
    @property
    def psi(self) -> float: ...
    @property
    def psi_z_score(self) -> float: ...
    @property
    def cost_px(self) -> float: ...
    @property
    def matched_fraction(self) -> float: ...
    @property
    def unexplained_grey(self) -> float: ...
    @property
    def convergence(self) -> str: ...
    @property
    def alternatives(self) -> List[Alternative]: ...

class Detections:
    def __len__(self) -> int: ...
    def __getitem__(self, index: int) -> Detection: ...
    def __iter__(self) -> Iterator[Detection]: ...
    @property
    def is_complete(self) -> bool: ...
    @property
    def seconds(self) -> Dict[str, float]: ...

_Templates = Union[Templates, Sequence[Templates]]

def detect(
    image: AnyImage,
    camera: Camera,
    templates: _Templates,
    options: Optional[DetectOptions] = ...,
    *,
    depth: Optional[Depth] = ...,
    depth_options: Optional[DepthOptions] = ...,
    backend: Optional[Backend] = ...,
    max_seconds: Optional[float] = ...,
) -> Detections: ...
def detect_jointly(
    images: Sequence[AnyImage],
    camera: Union[Camera, Sequence[Camera]],
    camera_from_world: npt.ArrayLike,
    templates: _Templates,
    options: Optional[DetectOptions] = ...,
    *,
    depth: Optional[Sequence[Optional[Depth]]] = ...,
    depth_options: Optional[DepthOptions] = ...,
    backend: Optional[Backend] = ...,
    max_seconds: Optional[float] = ...,
) -> Detections: ...
def register(
    image: AnyImage,
    camera: Camera,
    templates: _Templates,
    camera_from_object: npt.ArrayLike,
    objects: Optional[Sequence[int]] = ...,
    *,
    options: Optional[RegisterOptions] = ...,
    depth: Optional[Depth] = ...,
    depth_options: Optional[DepthOptions] = ...,
    backend: Optional[Backend] = ...,
    max_seconds: Optional[float] = ...,
) -> Detections: ...
def register_jointly(
    images: Sequence[AnyImage],
    camera: Union[Camera, Sequence[Camera]],
    camera_from_world: npt.ArrayLike,
    templates: _Templates,
    world_from_object: npt.ArrayLike,
    objects: Optional[Sequence[int]] = ...,
    *,
    options: Optional[RegisterOptions] = ...,
    depth: Optional[Sequence[Optional[Depth]]] = ...,
    depth_options: Optional[DepthOptions] = ...,
    backend: Optional[Backend] = ...,
    max_seconds: Optional[float] = ...,
) -> Detections: ...
def overlay(
    image: AnyImage,
    camera: Camera,
    detections: Union[Detections, Sequence[Detection]],
    templates: _Templates,
    *,
    camera_from_world: Optional[npt.ArrayLike] = ...,
    backend: Optional[Backend] = ...,
) -> Image: ...

class Proposal:
    @property
    def view(self) -> int: ...
    @property
    def camera_from_world(self) -> Matrix: ...
    @property
    def values_nats(self) -> Matrix: ...

class Instance(Detection):
    @property
    def supporting_images(self) -> List[int]: ...

class Scout:
    def __init__(
        self,
        templates: _Templates,
        camera: Camera,
        camera_from_world: npt.ArrayLike,
        options: Optional[ScoutOptions] = ...,
        *,
        reachable: Union[None, Callable[[int], bool], Sequence[int]] = ...,
        backend: Optional[Backend] = ...,
    ) -> None: ...
    def propose(self) -> Optional[Proposal]: ...
    def give(
        self,
        view: int,
        image: AnyImage,
        camera_from_world: Optional[npt.ArrayLike] = ...,
        *,
        depth: Optional[Depth] = ...,
        depth_options: Optional[DepthOptions] = ...,
    ) -> None: ...
    def unreachable(self, view: int, reason: str) -> None: ...
    @property
    def detections(self) -> List[Instance]: ...
    @property
    def entropy_nats(self) -> float: ...
    @property
    def images(self) -> int: ...
    @property
    def end(self) -> str: ...
    def save(self, file: Path) -> None: ...
    def resume(self, file: Path) -> None: ...

def hemisphere_views(
    center_m: Sequence[float],
    radius_m: float,
    count: int = ...,
    elevations_deg: Sequence[float] = ...,
) -> Matrix: ...
def look_at(eye_m: Sequence[float], target_m: Sequence[float]) -> Matrix: ...

class TrackState:
    TRACKED: TrackState
    DOUBTFUL: TrackState
    LOST: TrackState
    __members__: ClassVar[Dict[str, TrackState]]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __index__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class Track:
    @property
    def id(self) -> int: ...
    @property
    def object(self) -> int: ...
    @property
    def object_id(self) -> int: ...
    @property
    def state(self) -> TrackState: ...
    @property
    def camera_from_object(self) -> Matrix: ...
    @property
    def covariance(self) -> Matrix: ...
    @property
    def above_chance(self) -> float: ...

class Tracker:
    def __init__(
        self,
        templates: _Templates,
        camera: Camera,
        options: Optional[TrackOptions] = ...,
        *,
        backend: Optional[Backend] = ...,
    ) -> None: ...
    def add(self, camera_from_object: npt.ArrayLike, object: int = ...) -> int: ...
    def remove(self, id: int) -> None: ...
    def update(
        self,
        image: AnyImage,
        time_s: float,
        *,
        depth: Optional[Depth] = ...,
        depth_options: Optional[DepthOptions] = ...,
        max_seconds: Optional[float] = ...,
    ) -> List[Track]: ...
    def search(
        self,
        image: AnyImage,
        *,
        depth: Optional[Depth] = ...,
        depth_options: Optional[DepthOptions] = ...,
        backend: Optional[Backend] = ...,
        max_seconds: Optional[float] = ...,
    ) -> int: ...
    def overlay(self, image: AnyImage) -> Image: ...
    @property
    def tracks(self) -> List[Track]: ...
