# SPDX-License-Identifier: GPL-3.0-or-later
import enum
import os
from collections.abc import Callable, Iterable, ItemsView, Iterator, KeysView, Mapping, Sequence
from typing import Any, Literal, Optional, Union

import numpy
from numpy.typing import ArrayLike, NDArray

__version__: str
__all__ = ["Fit", "Registration", "Status", "Surface", "Symmetries", "Values", "Volume", "curvatures", "evaluate", "fit",
           "mesh", "read", "register", "symmetries", "view", "write"]

_Floats = NDArray[numpy.float64]
_Path = Union[str, os.PathLike[str]]
_Progress = Optional[Callable[[int, int, int], object]]
_Attributes = Union[str, Sequence[str]]
_Orientation = Literal["gradient", "against"]
_Kind = Literal["affine", "equiaffine", "similarity", "rigid"]
_Scale = Union[float, Literal["auto", "none"], None]
_Noise = Union[float, Literal["auto"], None]
_Function = Union[str, "Volume", "Fit", Callable[[_Floats, _Floats, _Floats], ArrayLike], ArrayLike]
_Registered = Union["Surface", _Path, tuple[ArrayLike, ArrayLike], tuple[ArrayLike, ArrayLike, ArrayLike], ArrayLike]

class Status(enum.IntEnum):
    REGULAR = 0
    PARABOLIC = 1
    SINGULAR = 2
    OUTSIDE = 3
    UNCONVERGED = 4

class Values:
    attributes: dict[str, _Floats]
    status: Optional[NDArray[numpy.uint8]]
    def __init__(self, attributes: dict[str, _Floats], status: Optional[NDArray[numpy.uint8]] = None) -> None: ...
    def keys(self) -> KeysView[str]: ...
    def items(self) -> ItemsView[str, _Floats]: ...
    def get(self, name: str, default: Any = None) -> Any: ...
    def __iter__(self) -> Iterator[str]: ...
    def __getitem__(self, name: str) -> _Floats: ...
    def __contains__(self, name: str) -> bool: ...

class Surface(Values):
    V: _Floats
    F: NDArray[numpy.int64]
    scale: Optional[float]
    comments: list[str]
    report: dict[str, Any]
    def __init__(self, V: _Floats, F: Optional[NDArray[numpy.int64]] = None, attributes: Optional[dict[str, _Floats]] = None,
                 status: Optional[NDArray[numpy.uint8]] = None, scale: Optional[float] = None,
                 comments: Iterable[str] = (), report: Optional[dict[str, Any]] = None) -> None: ...
    def save(self, path: _Path) -> None: ...
    def to_pyvista(self) -> Any: ...
    def to_trimesh(self) -> Any: ...

class Volume:
    values: NDArray[Any]
    spacing: _Floats
    origin: _Floats
    direction: _Floats
    def __init__(self, values: ArrayLike, spacing: ArrayLike = (1, 1, 1), origin: ArrayLike = (0, 0, 0),
                 direction: Optional[ArrayLike] = None) -> None: ...
    def save(self, path: _Path) -> None: ...

class Fit:
    def __init__(self, core: Any, arguments: dict[str, Any]) -> None: ...
    def __reduce__(self) -> tuple[Any, ...]: ...
    @property
    def scale(self) -> Optional[float]: ...
    def __call__(self, points: ArrayLike) -> _Floats: ...
    def evaluate(self, points: ArrayLike, **options: Any) -> Values: ...
    def mesh(self, **options: Any) -> Surface: ...

class Registration:
    report: dict[str, Any]
    summary: str
    found: bool
    matrix: Optional[_Floats]
    rms: Optional[float]
    inliers: Optional[tuple[float, float]]
    log10_false_alarms: Optional[float]
    def __init__(self, report: dict[str, Any], summary: str) -> None: ...
    def apply(self, points: ArrayLike) -> _Floats: ...
    def __bool__(self) -> bool: ...

class Symmetries:
    report: dict[str, Any]
    summary: str
    decided: bool
    order: Optional[int]
    matrices: Optional[_Floats]
    dimension: int
    def __init__(self, report: dict[str, Any], summary: str) -> None: ...

def mesh(f: _Function, *, level: float = 0, box: Optional[ArrayLike] = None, resolution: Optional[ArrayLike] = None,
         method: Literal["marching-cubes", "delaunay"] = "marching-cubes", spacing: Optional[ArrayLike] = None,
         origin: Optional[ArrayLike] = None, direction: Optional[ArrayLike] = None, attributes: _Attributes = "basic",
         smoothing: Union[float, Literal["auto"], None] = None, constants: Optional[Mapping[str, float]] = None,
         orientation: _Orientation = "gradient", angle: Optional[float] = None, radius: Optional[float] = None,
         distance: Optional[float] = None, threads: Optional[int] = None, progress: _Progress = None) -> Surface: ...
def curvatures(V: Union[ArrayLike, Surface], F: Optional[ArrayLike] = None, *, scale: _Scale = None, noise: _Noise = None,
               normals: Optional[ArrayLike] = None, degree: Union[int, Literal["auto"], None] = None, feature_angle: Optional[float] = None,
               attributes: _Attributes = "all", orientation: _Orientation = "gradient", threads: Optional[int] = None,
               progress: _Progress = None) -> Surface: ...
def fit(V: Union[ArrayLike, Surface], F: Optional[ArrayLike] = None, *, scale: _Scale = None, noise: _Noise = None,
        normals: Optional[ArrayLike] = None, degree: Union[int, Literal["auto"], None] = None, feature_angle: Optional[float] = None,
        threads: Optional[int] = None, progress: _Progress = None) -> Fit: ...
def evaluate(f: _Function, points: ArrayLike, *, constants: Optional[Mapping[str, float]] = None,
             box: Optional[ArrayLike] = None, resolution: Optional[ArrayLike] = None, spacing: Optional[ArrayLike] = None,
             origin: Optional[ArrayLike] = None, direction: Optional[ArrayLike] = None, attributes: _Attributes = "basic",
             smoothing: Union[float, Literal["auto"], None] = None, orientation: _Orientation = "gradient",
             threads: Optional[int] = None, progress: _Progress = None) -> Values: ...
def register(a: _Registered, b: _Registered, *, kind: _Kind = "affine", reflections: bool = True,
             tolerance: Optional[float] = None, min_overlap: Optional[float] = None, number_of_maps: Optional[int] = None,
             scale: _Scale = None, threads: Optional[int] = None, progress: _Progress = None) -> Registration: ...
def symmetries(a: _Registered, *, kind: _Kind = "affine", reflections: bool = True, tolerance: Optional[float] = None,
               scale: _Scale = None, threads: Optional[int] = None, progress: _Progress = None) -> Symmetries: ...
def read(path: _Path) -> Union[Surface, Volume]: ...
def write(path: _Path, data: Union[Surface, Volume, tuple[ArrayLike, ArrayLike]]) -> None: ...
def view(surface: Union[Surface, tuple[ArrayLike, ArrayLike]], path: Optional[_Path] = None, *, color: Optional[str] = None, up: Optional[Literal["x", "y", "z", "auto"]] = None,
         range: Optional[ArrayLike] = None, colors: Optional[Literal["linear", "logarithmic", "equalized", "auto"]] = None,
         size: Optional[ArrayLike] = None) -> None: ...
