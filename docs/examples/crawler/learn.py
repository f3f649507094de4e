"""A block learns to crawl, by the PPO of skrl on JAX: `pip install gyration[gym] "skrl[jax]"`, some five minutes on two cores."""

import time

import flax.linen as nn
import jax.numpy as jnp
import numpy as np
from gyration.gym import Crawler
from skrl import config
from skrl.agents.jax.ppo import PPO, PPO_CFG
from skrl.envs.wrappers.jax import wrap_env
from skrl.memories.jax import RandomMemory
from skrl.models.jax import DeterministicMixin, GaussianMixin, Model
from skrl.resources.preprocessors.jax import RunningStandardScaler
from skrl.trainers.jax import SequentialTrainer
from skrl.utils import set_seed

DT, BLOCKS, INTERVALS, ROUNDS = 0.05, 32, 640, 6
config.jax.backend = "jax"
set_seed(0)


def body(observations):
    return nn.tanh(nn.Dense(64)(nn.tanh(nn.Dense(64)(observations))))


class Policy(GaussianMixin, Model):
    def __init__(self, **spaces):
        Model.__init__(self, **spaces)
        GaussianMixin.__init__(self)

    @nn.compact
    def __call__(self, inputs, role):
        mean = nn.tanh(nn.Dense(self.num_actions)(body(inputs["observations"])))
        return mean, {"log_std": self.param("log_std", lambda _: -0.5 * jnp.ones(self.num_actions))}


class Value(DeterministicMixin, Model):
    def __init__(self, **spaces):
        Model.__init__(self, **spaces)
        DeterministicMixin.__init__(self)

    @nn.compact
    def __call__(self, inputs, role):
        return nn.Dense(1)(body(inputs["observations"])), {}


def way(act):
    """Block heights along x in 10 s, of eight blocks; those that run out of their shape begin anew."""
    crawlers = Crawler(8, dt=DT, steps=10**6)
    observations, _ = crawlers.reset(seed=9)
    total = np.zeros(8)
    for k in range(round(10 / DT)):
        observations, rewards, *_ = crawlers.step(act(observations, k))
        total += rewards
    return total


def stroke(k):
    phase = 2 * np.pi * 3 * DT * k
    return np.tile([np.cos(phase), -np.sin(phase)], (8, 1))


env = wrap_env(Crawler(BLOCKS, dt=DT, steps=200), wrapper="gymnasium")
spaces = {"observation_space": env.observation_space, "action_space": env.action_space, "device": env.device}
models = {"policy": Policy(**spaces), "value": Value(**spaces)}
for role, model in models.items():
    model.init_state_dict(role=role)
cfg = PPO_CFG(
    rollouts=64,
    mini_batches=8,
    discount_factor=0.98,
    time_limit_bootstrap=True,
    value_loss_scale=0.5,
    rewards_shaper=lambda rewards, *_, **__: 20 * rewards,
    observation_preprocessor=RunningStandardScaler,
    observation_preprocessor_kwargs={"size": env.observation_space},
    value_preprocessor=RunningStandardScaler,
    value_preprocessor_kwargs={"size": 1},
)
cfg.experiment.write_interval = cfg.experiment.checkpoint_interval = 0
agent = PPO(models=models, memory=RandomMemory(memory_size=64, num_envs=BLOCKS, device=env.device), cfg=cfg, **spaces)
agent.init()


def learned(observations, _):
    scaled = agent._observation_preprocessor(jnp.asarray(observations, dtype=jnp.float32))
    return np.asarray(models["policy"].act({"observations": scaled}, role="policy")[1]["mean_actions"])


random = np.random.default_rng(0)
print("random      ", way(lambda *_: random.uniform(-1, 1, (8, 2))).round(1))
print("3 Hz stroke ", way(lambda _, k: stroke(k)).round(1))
begun = time.time()
for turn in range(1, ROUNDS + 1):
    options = {"timesteps": INTERVALS, "headless": True, "disable_progressbar": True, "close_environment_at_exit": False}
    SequentialTrainer(env=env, agents=agent, cfg=options).train()
    print(f"{turn * INTERVALS * BLOCKS:>6} intervals, {time.time() - begun:>4.0f} s", way(learned).round(1))
