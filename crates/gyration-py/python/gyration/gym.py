"""Environments of Gymnasium over :class:`gyration.Batch`: bodies that learn to drive themselves.

    >>> crawlers = gyration.gym.Crawler(num_envs=64)
    >>> observations, infos = crawlers.reset(seed=0)
    >>> observations, rewards, terminations, truncations, infos = crawlers.step(crawlers.action_space.sample())

Needs Gymnasium (``pip install gyration[gym]``).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

try:
    from gymnasium.vector import VectorEnv
except ImportError:
    # Whoever makes an environment is told what to install.
    VectorEnv = object  # type: ignore

from gyration._errors import ArgumentError
from gyration._gyration import Batch, Scene

__all__ = ["CRAWLER", "Crawler"]

STIFFNESS = 20e3
"""Pa per unit of stretch: how strongly the block takes its own shape back."""


def _feedback(direction: list[float], gain: list[list[float]]) -> dict[str, Any]:
    """Q = gain (stretch - 1) along a direction."""
    return {"measure": {"stretch": direction}, "gain": gain, "bias": [[-entry for entry in row] for row in gain]}


CRAWLER: dict[str, Any] = {
    "title": "A block that may crawl",
    "time": {"end": 10.0, "sample": 0.02},
    "support": [{"name": "table", "plane": {"origin": [0, 0, 0], "normal": [0, 0, 1]}}],
    "contact": [
        {
            "support": "table",
            "repulsion": {"alpha": 2e3, "nu": 6, "d0": 5e-3},
            "damping": {"beta": 200.0, "nu": 6, "d0": 5e-3},
            "friction": {"beta": 3000.0, "nu": 6, "d0": 5e-3},
        }
    ],
    "body": [
        {
            "name": "block",
            "shape": {"box": {"size": [0.2, 0.1, 0.1]}},
            "density": 1000.0,
            "position": [0, 0, 0.0557],
            "contractile": {
                "material": {"mooney_rivlin": {"c1": 3e3, "c2": 1e3}},
                "viscosity": 40.0,
                "contraction_viscosity": 500.0,
                "isochoric": True,
                "spin": "symmetric",
                "drive": {"constant": {"value": [[0.0] * 3] * 3}},
                # The stretches of two diagonals differ by the shear.
                "feedback": [
                    _feedback([0, 0, 1], [[0, 0, 0], [0, 0, 0], [0, 0, -STIFFNESS]]),
                    _feedback([1, 0, 1], [[0, 0, -STIFFNESS], [0, 0, 0], [0, 0, 0]]),
                    _feedback([1, 0, -1], [[0, 0, STIFFNESS], [0, 0, 0], [0, 0, 0]]),
                ],
            },
        }
    ],
}
"""The scene of :class:`Crawler`, a dictionary of the keys of a scene file."""


class Crawler(VectorEnv):
    """Blocks that lie on tables and drive their stretch and shear: whoever comes farther along x has done better.

    An action is (stretch, shear) in [-1, 1], times ``strength`` [Pa] the drives Q_zz and Q_xz, held for ``dt`` [s]. An observation has
    13 numbers: the height of the centre over its start in block heights, P - I in the plane of the stroke (xx, xz, zx, zz), and G - I there;
    the velocity of the centre (x, z) in block heights a second, and Pdot there (xz, zz) [1/s]. A block height is twice that of the centre
    over z = 0 at the start. The reward is the way along x in the interval, in block heights. An episode is truncated after ``steps``
    intervals, and terminated where a block cannot go on (``reasons`` in the infos), or where an entry of P - I or G - I in the plane is
    beyond ``strain``: there it runs away from its shape.

    A reset begins with velocities drawn by its seed, up to ``noise`` [m/s]. With ``threads`` the members are shared out, on all cores
    without; results do not depend on it. ``ImportError`` says what to install.
    """

    def __init__(
        self,
        num_envs: int = 1,
        *,
        scene: Scene | dict[str, Any] | None = None,
        dt: float = 0.02,
        steps: int = 500,
        strength: float = 3e3,
        strain: float = 0.5,
        noise: float = 1e-3,
        threads: int | None = None,
    ) -> None:
        try:
            from gymnasium.spaces import Box
            from gymnasium.vector import AutoresetMode
            from gymnasium.vector.utils import batch_space
        except ImportError as missing:
            raise ImportError(f"{missing}\n  fix: pip install gyration[gym]") from missing
        if not (dt > 0 and steps > 0 and strain > 0):
            raise ArgumentError(
                f"{steps} steps of {dt} s, strains up to {strain}\n  fix: give `dt`, `steps` and `strain` above zero"
            )
        self.num_envs, self.render_mode = num_envs, None
        self.metadata = {"render_modes": [], "autoreset_mode": AutoresetMode.NEXT_STEP}
        self._batch = Batch(CRAWLER if scene is None else scene, num_envs, threads=threads)
        self._dt, self._steps, self._strength, self._strain, self._noise = dt, steps, strength, strain, noise
        self.single_observation_space = Box(-np.inf, np.inf, (13,), np.float64)
        self.single_action_space = Box(-1.0, 1.0, (2,), np.float64)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._start = self._batch.position[0, 0].copy()
        if not self._start[2] > 0:
            raise ArgumentError(
                f"the block starts at z = {self._start[2]} m, and ways are measured by its height over z = 0\n"
                "  fix: move the scene up"
            )
        self._made = np.zeros(num_envs, dtype=np.int64)
        self._over = np.zeros(num_envs, dtype=np.bool_)

    @property
    def batch(self) -> Batch:
        """The simulations."""
        return self._batch

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[npt.NDArray[np.float64], dict[str, Any]]:
        """Begins all anew, or those of the mask ``options["reset_mask"]``, (num_envs,); returns observations and infos."""
        if isinstance(seed, list):
            # One generator draws for all: what the seeds say together.
            seed = int(np.random.SeedSequence([0 if one is None else one for one in seed]).generate_state(1)[0])
        super().reset(seed=seed)
        mask = (options or {}).get("reset_mask")
        self._begin(np.ones(self.num_envs, dtype=np.bool_) if mask is None else np.asarray(mask, dtype=np.bool_))
        return self._observations(), {}

    def step(self, actions: Any) -> tuple[Any, ...]:
        """Holds the drives for an interval; a block whose episode was over begins anew instead, with the reward zero."""
        actions = np.clip(np.asarray(actions, dtype=np.float64), -1.0, 1.0)
        if actions.shape != self.action_space.shape:
            raise ArgumentError(f"actions of the shape {actions.shape}\n  fix: give {self.action_space.shape}")
        fresh = self._over.copy()
        self._begin(fresh)
        drives = np.zeros((self.num_envs, 3, 3))
        drives[:, 2, 2], drives[:, 0, 2] = self._strength * actions.T
        self._batch.set_drive(0, drives)
        before = self._batch.position[:, 0, 0].copy()
        # A block that begins anew waits where it is.
        arrived = self._batch.advance_by(np.where(fresh, 0.0, self._dt))
        self._made += ~fresh
        rewards = np.where(fresh, 0.0, (self._batch.position[:, 0, 0] - before) / self._height)
        observations = self._observations()
        terminations = ~arrived | (np.abs(observations[:, 1:9]) > self._strain).any(axis=1)
        truncations = ~terminations & (self._made >= self._steps)
        self._over = terminations | truncations
        infos = {"reasons": self._batch.reasons} if not arrived.all() else {}
        return observations, rewards, terminations, truncations, infos

    @property
    def _height(self) -> float:
        """Twice the height of the centre at the start [m]."""
        return 2.0 * float(self._start[2])

    def _begin(self, mask: npt.NDArray[np.bool_]) -> None:
        if not mask.any():
            return
        self._batch.reset(mask)
        velocity = self._batch.velocity[mask].copy()
        velocity[:, 0, :2] += self.np_random.uniform(-self._noise, self._noise, (len(velocity), 2))
        self._batch.set_state(mask, velocity=velocity)
        self._made[mask], self._over[mask] = 0, False

    def _observations(self) -> npt.NDArray[np.float64]:
        one, plane = self._batch, ([0, 0, 2, 2], [0, 2, 0, 2])
        height = (one.position[:, 0, 2:] - self._start[2]) / self._height
        strains = [(matrices[:, 0] - np.eye(3))[:, plane[0], plane[1]] for matrices in (one.P, one.G)]
        velocity, rate = one.velocity[:, 0, [0, 2]] / self._height, one.Pdot[:, 0, [0, 2], 2]
        return np.concatenate([height, *strains, velocity, rate], axis=1)
