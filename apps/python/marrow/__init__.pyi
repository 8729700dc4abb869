import os
from typing import (
    Any, Callable, Dict, List, Literal, Optional, Sequence, Tuple, TypedDict, Union,
)

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Unpack  # type checkers have it; nothing imports a stub

__version__: str

Path = Union[str, "os.PathLike[str]"]
Progress = Callable[[str, float], Any]

class Error(RuntimeError):
    kind: str
    status: int

class Skeleton:
    def __init__(
        self,
        nodes: ArrayLike,
        radii: ArrayLike,
        edges: ArrayLike,
        section_radii: Optional[ArrayLike] = ...,
    ) -> None: ...
    @property
    def nodes(self) -> NDArray[np.float64]: ...
    @property
    def radii(self) -> NDArray[np.float64]: ...
    @property
    def section_radii(self) -> NDArray[np.float64]: ...
    @property
    def edges(self) -> NDArray[np.uint32]: ...
    @property
    def branches(self) -> List[NDArray[np.uint32]]: ...
    @property
    def degrees(self) -> NDArray[np.int32]: ...
    @property
    def components(self) -> int: ...
    @property
    def cycles(self) -> int: ...
    @property
    def leaves(self) -> int: ...
    @property
    def joints(self) -> int: ...
    @property
    def length(self) -> float: ...
    def map(
        self, vertices: ArrayLike, faces: Optional[ArrayLike] = ...
    ) -> Dict[str, NDArray[np.int64]]: ...
    def map_volume(
        self,
        values: NDArray[Any],
        iso: float = ...,
        spacing: Sequence[float] = ...,
        origin: Sequence[float] = ...,
    ) -> Dict[str, NDArray[np.int64]]: ...
    def save(self, path: Path) -> None: ...
    def to_networkx(self) -> Any: ...
    def largest_part(self) -> "Skeleton": ...
    def large_parts(self, share: float) -> "Skeleton": ...
    def __len__(self) -> int: ...
    def __eq__(self, other: object) -> bool: ...

class _Options(TypedDict, total=False):
    image: int
    grid: int
    closing: float
    smoothing: int
    silhouettes: Literal["scanline", "embree"]
    refine: Literal["surface", "hull", "none"]
    rules: Literal["marrow", "paper"]
    views: Union[int, ArrayLike]
    threads: int
    progress: Optional[Progress]

def extract(
    vertices: ArrayLike, faces: Optional[ArrayLike] = ..., **options: Unpack[_Options]
) -> Skeleton: ...
def extract_volume(
    values: NDArray[Any],
    iso: float = ...,
    spacing: Sequence[float] = ...,
    origin: Sequence[float] = ...,
    **options: Unpack[_Options],
) -> Skeleton: ...
def extract_file(path: Path, iso: float = ..., **options: Unpack[_Options]) -> Skeleton: ...
def load(path: Path) -> Skeleton: ...
def read_shape(path: Path) -> Tuple[NDArray[np.float64], NDArray[np.uint32]]: ...
