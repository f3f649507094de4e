"""Scenes: where they come from, edits, and that what is wrong is said in the words of the program."""

import pickle
import subprocess
import sys

import numpy as np
import pytest

import gyration
from conftest import BALL


def program(*arguments):
    """The program that the package brings along."""
    return subprocess.run([sys.executable, "-m", "gyration", *arguments], capture_output=True, text=True)


def test_a_scene_is_the_same_from_a_file_a_text_and_a_dictionary(tmp_path, ball):
    path = tmp_path / "ball.json"
    path.write_text(ball.text)
    assert gyration.Scene.from_file(path).resolved == ball.resolved
    assert gyration.Scene.from_text(ball.text, "ball.json").resolved == ball.resolved


def test_the_gallery_opens_by_name():
    assert "dice" in gyration.scenes()
    dice = gyration.Scene.gallery("dice")
    assert (dice.name, dice.bodies) == ("dice", ["die"])


def test_the_resolved_scene_is_itself_a_scene(ball):
    assert gyration.Scene.from_dict(ball.resolved).resolved == ball.resolved


def test_edits_give_another_scene_and_values_are_read_by_dotted_key(ball):
    edited = ball.edit({"body.ball.velocity": np.array([1.0, 0, 0]), "time.end": "200 ms"})
    assert edited["body.ball.velocity"] == [1, 0, 0]
    assert edited["body.0.velocity.0"] == 1
    assert edited["time.end"] == 0.2
    assert ball["body.ball.velocity"] == [0.3, 0, 0]
    assert edited.edit({"solver.rtol": 1e-7})["body.ball.velocity"] == [1, 0, 0]


def test_edits_hold_tables_texts_and_flags(ball):
    law = {"alpha": "1 kPa", "nu": 5, "d0": 0.002}
    edited = ball.edit({"contact.0.repulsion": law, "title": 'so "quoted"'})
    assert edited["contact.0.repulsion.alpha"] == 1000
    assert edited.title == 'so "quoted"'


def test_keys_of_a_scene_are_listed_and_asked_for(ball):
    keys = list(ball)
    assert "body.ball.density" in keys and "body.ball.density" in ball and "body.ball.colour" not in ball
    assert all(key in ball for key in keys)


def test_an_unknown_key_is_a_key_error_that_says_what_there_is(ball):
    with pytest.raises(KeyError, match="it has ball"):
        ball["body.bal.velocity"]
    crowd = ball.edit({"body.ball.copies": {"grid": {"count": [10, 10, 1], "spacing": [0.2, 0.2, 0]}}})
    with pytest.raises(KeyError, match="did you mean `ball-0.x`") as caught:
        gyration.Simulation(crowd)["ball-0.wx"]
    assert len(str(caught.value)) < 100


def test_check_says_what_the_program_says():
    assert gyration.Scene.gallery("dice").check() == program("check", "dice").stdout


def test_errors_are_those_of_the_program_all_at_once(tmp_path):
    path = tmp_path / "wrong.toml"
    path.write_text("[time]\nend = -1\n[[body]]\nname = 'a'\nmas = 1\nshape = { sphere = { radius = '5 cm' } }\n")
    with pytest.raises(gyration.SceneError) as caught:
        gyration.Scene.from_file(path)
    said = program("check", str(path)).stderr
    assert said.removeprefix("gyration: error: ").strip() == str(caught.value)
    places = [(found.line, found.key) for found in caught.value.diagnostics]
    assert (2, "time.end") in places and (5, "body.a.mas") in places
    assert all(found.help for found in caught.value.diagnostics)


def test_a_wrong_edit_is_placed_in_the_edit(ball):
    with pytest.raises(gyration.SceneError) as caught:
        ball.edit({"body.ball.velocity": [1, float("nan"), 0]})
    assert caught.value.diagnostics[0].file == "--set"
    with pytest.raises(gyration.ArgumentError, match="no meaning"):
        ball.edit({"title": object()})


def test_a_missing_file_is_a_file_error():
    with pytest.raises(gyration.FileError, match="nowhere.toml"):
        gyration.Scene.from_file("nowhere.toml")
    with pytest.raises(gyration.Error, match="dice"):
        gyration.Scene.gallery("dize")


def test_scenes_travel_to_other_processes(ball):
    edited = ball.edit({"time.end": 0.1})
    again = pickle.loads(pickle.dumps(edited))
    assert again == edited and hash(again) == hash(edited) and again != ball
    assert again.resolved == edited.resolved and again.name == edited.name


def test_the_program_comes_along():
    listed = program("scenes")
    assert listed.returncode == 0 and "dice" in listed.stdout
    assert program("nonsense").returncode == 2


def test_modes_are_the_numbers_of_the_program(ball):
    import json

    told = json.loads(program("modes", "elastic-bounce", "--json").stdout)["bodies"][0]["rest_state"]
    found = gyration.modes("elastic-bounce")["ball"]
    np.testing.assert_array_equal(found["frequency_hz"], [mode["frequency_hz"] for mode in told["modes"]])
    np.testing.assert_array_equal(found["shape"]["gradient"][0], told["modes"][0]["shape"]["gradient"])
    assert found["position"].shape == (3,)


def test_the_resistance_of_a_sphere_is_that_of_stokes():
    data = dict(BALL, fluid={"viscosity": 2.0})
    found = gyration.resistance(data, "ball")
    radius = 0.05
    np.testing.assert_allclose(np.diag(found["matrix"])[:3], 6 * np.pi * 2.0 * radius, rtol=1e-12)
    with pytest.raises(gyration.ArgumentError, match="no body"):
        gyration.resistance(data, "die")
    vibrating = gyration.resistance(dict(BALL, fluid={"viscosity": 2.0, "density": 900.0}), "ball", frequency=10.0)
    assert isinstance(vibrating["translation"], complex)


def test_sensitivities_of_a_free_fall_are_those_of_its_closed_form(ball):
    flight = ball.edit({"contact.0.repulsion.alpha": 1e-12, "time.end": 0.2})
    keys = ["body.ball.position.2", "body.ball.velocity.0", "world.gravity.2", "solver.rtol"]
    found = gyration.sensitivities(flight, keys, ["ball.x", "ball.z"])
    exact = [[0, 0.2, 0], [1, 0, 0.5 * 0.2**2]]
    np.testing.assert_allclose(found["derivatives"][:, :3], exact, atol=1e-8)
    assert found["reasons"][keys[0]] is None
    # How precisely a run is computed is no number of the motion.
    assert np.isnan(found["derivatives"][:, 3]).all() and found["reasons"]["solver.rtol"]
    samples = gyration.sensitivities(flight, keys[:3], ["ball.z"], at="samples")
    assert samples["derivatives"].shape == (len(samples["time"]), 1, 3)
    np.testing.assert_allclose(samples["derivatives"][:, 0, 2], 0.5 * samples["time"] ** 2, atol=1e-8)
    with pytest.raises(gyration.ArgumentError, match="ball.q"):
        gyration.sensitivities(flight, keys, ["ball.q"])


def test_a_scene_is_made_of_whatever_stands_for_one(tmp_path):
    dice = gyration.Scene("dice")
    assert dice.text == gyration.Scene.gallery("dice").text
    (tmp_path / "mine.toml").write_text(dice.text)
    assert gyration.Scene(tmp_path / "mine.toml").resolved == dice.resolved
    assert gyration.Scene(gyration.Scene(dice.resolved)).resolved == dice.resolved
    with pytest.raises(gyration.ArgumentError, match="3 is no scene\n  fix: "):
        gyration.Scene(3)


def test_messages_speak_of_arguments(tmp_path):
    scene = gyration.Scene("dice")
    with pytest.raises(gyration.SceneError, match=r"^edit:1:10: body.die.mas"):
        scene.edit({"body.die.mas": 1.0})
    scene.run(tmp_path / "die.gyr")
    with pytest.raises(gyration.Error, match="force=True"):
        scene.edit({"body.die.velocity": [1, 0, 0]}).run(tmp_path / "die.gyr", resume=True)
    with pytest.raises(gyration.ArgumentError, match="`resume` and `force` at once"):
        scene.run(tmp_path / "die.gyr", resume=True, force=True)
    with pytest.raises(gyration.ArgumentError, match=r"^body.0.position.2: NaN is not a finite number"):
        gyration.Scene.from_dict({"body": [{"position": [0, 0, np.nan]}]})
    with pytest.raises(gyration.ArgumentError, match="`dt` is -1"):
        gyration.Batch("dice", 2).advance_by(-1)
    with pytest.raises(gyration.ArgumentError, match="type Scene has no meaning here\n  fix: name the scene by its path"):
        gyration.study({"scene": scene, "keep": {"z": {"last": "die.z"}}})


def test_one_name_is_as_good_as_a_list_of_one():
    scene = gyration.Scene("bounce-flat")
    recording = scene.run()
    name = next(column for column in recording.columns if column.endswith(".z"))
    assert gyration.run_many([scene], keep=name)[name].shape == (1,)
    assert recording.plot(["height", "energy"]).svg == recording.plot("height", "energy").svg
    body = name.split(".")[0]
    found = gyration.sensitivities(scene, "world.gravity.2", f"{body}.z")
    assert found["derivatives"].shape == (1, 1)
