"""The vector environment over a batch, by Gymnasium's own rules."""

import numpy as np
import pytest

pytest.importorskip("gymnasium", reason="Gymnasium is not installed: pip install gyration[gym]")

import gymnasium

import gyration
from gyration.gym import Crawler


def rolled(threads, seed=3, intervals=8):
    crawlers = Crawler(3, steps=6, threads=threads)
    shown = [crawlers.reset(seed=seed)[0]]
    actions = np.random.default_rng(0).uniform(-1, 1, (intervals, 3, 2))
    for action in actions:
        shown.append(crawlers.step(action))
    return crawlers, shown


def test_an_environment_keeps_the_rules_of_gymnasium():
    crawlers, shown = rolled(1)
    assert isinstance(crawlers, gymnasium.vector.VectorEnv)
    assert crawlers.observation_space.contains(shown[0])
    for k, (observations, rewards, terminations, truncations, infos) in enumerate(shown[1:], start=1):
        assert crawlers.observation_space.contains(observations) and isinstance(infos, dict)
        assert rewards.shape == terminations.shape == truncations.shape == (3,)
        # Six intervals make an episode; the one after that begins anew, with no reward.
        assert truncations.all() == (k == 6) and not terminations.any()
        assert (rewards == 0).all() == (k == 7)


def test_the_same_seed_is_the_same_on_any_number_of_threads():
    (_, one), (_, two), (_, other) = rolled(1), rolled(2), rolled(1, seed=4)
    for left, right in zip(one[1:], two[1:]):
        for a, b in zip(left[:4], right[:4]):
            assert a.tobytes() == b.tobytes()
    assert one[-1][0].tobytes() != other[-1][0].tobytes()


def test_members_are_reset_by_a_mask():
    crawlers, shown = rolled(2, intervals=3)
    before = crawlers.batch.time.copy()
    observations, _ = crawlers.reset(options={"reset_mask": np.array([True, False, False])})
    assert list(crawlers.batch.time == 0) == [True, False, False] and (crawlers.batch.time[1:] == before[1:]).all()
    assert (observations[1:] == shown[-1][0][1:]).all() and not (observations[0] == shown[-1][0][0]).all()


def test_a_stroke_round_the_plane_crawls_and_one_back_crawls_back():
    # A cycle a second; the sense of the circle in the plane of shear and stretch is that of the way.
    crawlers = Crawler(2)
    crawlers.reset(seed=0)
    way = np.zeros(2)
    for k in range(100):
        phase = 2 * np.pi * 0.02 * k
        shear = np.array([np.sin(phase), -np.sin(phase)])
        _, rewards, *_ = crawlers.step(np.stack([np.full(2, np.cos(phase)), shear], axis=1))
        way += rewards
    assert way[0] * way[1] < 0 and abs(way[0] + way[1]) < 0.2 * abs(way[0] - way[1]) and abs(way).min() > 0.02


def test_what_makes_no_sense_is_refused():
    with pytest.raises(gyration.ArgumentError, match="fix: "):
        Crawler(2, dt=0.0)
    crawlers = Crawler(2)
    crawlers.reset(seed=[1, None])
    with pytest.raises(gyration.ArgumentError, match="fix: give"):
        crawlers.step(np.zeros(2))


def test_a_block_out_of_its_shape_ends_its_episode():
    # Drives at random for 20 s; without the limit one runs away to strains of thousands, which takes minutes.
    crawlers = Crawler(4, dt=0.05, strain=0.2)
    crawlers.reset(seed=0)
    actions = np.random.default_rng(0)
    ended = 0
    for _ in range(400):
        observations, _, terminations, _, _ = crawlers.step(actions.uniform(-1, 1, (4, 2)))
        assert (terminations == (abs(observations[:, 1:9]) > 0.2).any(axis=1)).all()
        ended += terminations.sum()
    assert ended > 0
