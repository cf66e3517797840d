"""Materials and light. The colors are our own choice, and all textures are computed."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

SHELL, DARK, RUBBER, LAMP, STEEL, JOINT, CAP = (
    "shell", "dark", "rubber", "lamp", "steel", "joint", "cap",
)  # fmt: skip
TILES, CONCRETE, GRIP, STRIPES, WALL, BOARD, WOOD, MARK, WARNING = (
    "tiles", "concrete", "grip", "stripes", "wall", "board", "wood", "mark", "warning",
)  # fmt: skip
BLOCK, VEST, BAND, TROUSERS, SKIN, HELMET, CARDBOARD, INK = (
    "block", "vest", "band", "trousers", "skin", "helmet", "cardboard", "ink",
)  # fmt: skip
BRASS, GLASS, RIM, AMBER, ROSE = "brass", "glass", "rim", "amber", "rose"
FORBIDDEN, ALLOWED, SPACE_EDGE, FORBIDDEN_EDGE, ALLOWED_EDGE = (
    "forbidden", "allowed", "space_edge", "forbidden_edge", "allowed_edge",
)  # fmt: skip

_PLAIN = {
    SHELL: (0.93, 0.94, 0.95),
    DARK: (0.16, 0.18, 0.21),
    RUBBER: (0.10, 0.10, 0.11),
    LAMP: (0.25, 0.75, 0.95),
    STEEL: (0.62, 0.65, 0.69),
    JOINT: (0.80, 0.82, 0.84),
    CAP: (0.33, 0.56, 0.75),
    WALL: (0.90, 0.89, 0.85),
    BOARD: (0.42, 0.50, 0.56),
    MARK: (0.95, 0.77, 0.18),
    WARNING: (0.82, 0.27, 0.20),
    BLOCK: (0.16, 0.36, 0.85),
    VEST: (0.98, 0.52, 0.10),
    BAND: (0.93, 0.95, 0.88),
    TROUSERS: (0.20, 0.26, 0.40),
    SKIN: (0.87, 0.68, 0.55),
    HELMET: (0.97, 0.83, 0.20),
    CARDBOARD: (0.72, 0.55, 0.36),
    INK: (0.20, 0.24, 0.52),
    BRASS: (0.85, 0.66, 0.30),
}
_CLEAR = {  # and how much of the light they hold back
    GLASS: (0.72, 0.88, 0.94, 0.22),
    RIM: (0.80, 0.94, 0.98, 0.75),
    AMBER: (0.95, 0.62, 0.15, 0.80),
    ROSE: (0.85, 0.25, 0.45, 0.80),
    SPACE_EDGE: (0.35, 0.50, 0.75, 0.35),
    FORBIDDEN: (0.90, 0.18, 0.12, 0.11),
    FORBIDDEN_EDGE: (0.90, 0.18, 0.12, 0.70),
    ALLOWED: (0.15, 0.70, 0.30, 0.22),
    ALLOWED_EDGE: (0.10, 0.62, 0.25, 0.80),
}
_SHINY = (SHELL, LAMP, STEEL, JOINT, CAP, HELMET, BRASS, GLASS, RIM)
_GLOWING = {LAMP: 0.6}
_SIZE = 256
_EXTENT = 6.0  # m around a place that light throws shadows of
_ROLE = int(mujoco.mjtTextureRole.mjTEXROLE_RGB)
_ROLES = int(mujoco.mjtTextureRole.mjNTEXROLE)
Pixels = NDArray[np.uint8]


def add_materials(spec: Any) -> None:
    """Add all materials, by their names."""
    solid = {name: (*color, 1.0) for name, color in _PLAIN.items()}
    for name, color in (solid | _CLEAR).items():
        material = spec.add_material(name=name, rgba=color)
        material.specular = 0.5 if name in _SHINY else 0.1
        material.shininess = 0.6 if name in _SHINY else 0.1
        material.emission = _GLOWING.get(name, 0.0)
    generator = np.random.default_rng(1)
    _add_textured(spec, TILES, _tiles(generator), repeat=1.0)
    _add_textured(spec, CONCRETE, _speckled((150, 153, 156), 7, generator), repeat=1.0)
    _add_textured(spec, GRIP, _ribbed(generator), repeat=3.0)
    _add_textured(spec, STRIPES, _striped(), repeat=16.0)
    _add_textured(spec, WOOD, _grained(generator), repeat=2.0)


def add_light(spec: Any, towards: tuple[float, float, float]) -> None:
    """Add daylight from above and aside, with shadows, under a pale sky."""
    for light in list(spec.lights):
        spec.delete(light)
    spec.worldbody.add_light(
        type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
        pos=[0, 0, 8],
        dir=towards,
        diffuse=[0.62, 0.61, 0.58],
        ambient=[0.0, 0.0, 0.0],
        specular=[0.25, 0.25, 0.25],
        castshadow=True,
    )
    head = spec.visual.headlight
    head.ambient, head.diffuse, head.specular = [0.34] * 3, [0.22] * 3, [0.0] * 3
    quality = spec.visual.quality
    quality.shadowsize, quality.offsamples = 2048, 4
    quality.numslices, quality.numstacks, quality.numquads = 20, 10, 1
    spec.stat.extent = _EXTENT
    spec.visual.map.shadowclip = 1.0
    spec.visual.map.zfar = 12.0
    spec.add_texture(
        name="sky",
        type=mujoco.mjtTexture.mjTEXTURE_SKYBOX,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT,
        rgb1=[0.72, 0.80, 0.88],
        rgb2=[0.93, 0.94, 0.95],
        width=256,
        height=256,
    )


def _add_textured(spec: Any, name: str, pixels: Pixels, repeat: float) -> None:
    """Add a material whose texture is repeated so often in a meter."""
    texture = spec.add_texture(
        name=name,
        type=mujoco.mjtTexture.mjTEXTURE_2D,
        width=pixels.shape[1],
        height=pixels.shape[0],
        nchannel=3,
    )
    texture.data = pixels.tobytes()
    material = spec.add_material(name=name, texuniform=True, texrepeat=[repeat, repeat])
    material.textures = [name if role == _ROLE else "" for role in range(_ROLES)]
    material.specular, material.shininess = 0.1, 0.1


def _speckled(color: tuple[int, int, int], spread: float, generator: np.random.Generator) -> Pixels:
    noise = generator.normal(0.0, spread, (_SIZE, _SIZE, 1))
    return np.clip(np.asarray(color) + noise, 0, 255).astype(np.uint8)


def _tiles(generator: np.random.Generator) -> Pixels:
    """Four tiles with joints between them, each a little lighter or darker."""
    pixels = _speckled((196, 198, 200), 3, generator).astype(np.int16)
    half = _SIZE // 2
    for row in (0, half):
        for column in (0, half):
            pixels[row : row + half, column : column + half] += generator.integers(-7, 8)
            pixels[row : row + 2, column : column + half] -= 40
            pixels[row : row + half, column : column + 2] -= 40
    return np.clip(pixels, 0, 255).astype(np.uint8)


def _ribbed(generator: np.random.Generator) -> Pixels:
    """Sheet metal with ribs on which wheels grip."""
    pixels = _speckled((120, 126, 132), 5, generator).astype(np.int16)
    rows, columns = np.indices((_SIZE, _SIZE))
    for turn, parity in ((1, 0), (-1, 1)):
        along = (rows + turn * columns) % 64
        cell = ((rows // 64 + columns // 64) % 2) == parity
        pixels[cell & (along > 26) & (along < 38)] += 45
    return np.clip(pixels, 0, 255).astype(np.uint8)


def _striped() -> Pixels:
    """Yellow and black, aslant."""
    rows, columns = np.indices((_SIZE, _SIZE))
    is_black = (rows + columns) % 128 < 64
    return np.where(is_black[..., None], (28, 28, 30), (245, 196, 40)).astype(np.uint8)


def _grained(generator: np.random.Generator) -> Pixels:
    """Wood: lines with the length of the board."""
    lines = np.convolve(generator.normal(0.0, 22.0, _SIZE + 8), np.ones(5) / 5, "same")[:_SIZE]
    noise = generator.normal(0.0, 2.5, (_SIZE, _SIZE, 1))
    wood = np.array((196, 158, 112)) + lines[:, None, None] + noise
    return np.clip(wood, 0, 255).astype(np.uint8)
