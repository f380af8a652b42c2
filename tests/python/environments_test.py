#!/usr/bin/env python3
"""Drives step by step are the drives of a campaign: a scripted policy gives the records of the same navigator run
plainly, alone, side by side, interleaved, on threads and after anything that was given up.

Usage: environments_test.py ROCKYARD PLUGINS [unittest's arguments]
"""

import gc
import os
import sys
import threading
import types
import weakref

import package
import rockyard as ry
from package import NOMINAL, PROJECT, QUICK, SEED, TOLERANCE, run
from rockyard import navigator as decided
from rockyard.environment import (ACTION, Environment, Environments, Kind, arrived, backward, forward, gave_up, gymnasium_environment,
                                  look, rest, turn)

import numpy as np

POINTS = PROJECT / "scenarios/gestalt/abundance_rocky_3_2.json"
MOST_POINTS = 20000
EVENTS = ("tick", "start", "look", "manoeuvre", "period", "near_goal", "end_of_plan", "pose_update", "correction", "goal", "hazard",
          "touch_behind", "stuck")
FELT = ("contact", "tilt", "articulation", "motor_current", "slip")


class Policy:
    """Looks, drives on where nothing is in the way, else turns; backs off from what it feels. It knows what is told on
    board, whoever tells it, and says what to do as the name of a function with its arguments."""

    def __init__(self):
        self.looks = self.turned = 0
        self.seen = []

    def decide(self, seen):
        self.seen.append(seen)
        dx_m, dy_m = (seen["goal"][i] - seen["pose"][i] for i in (0, 1))
        if np.hypot(dx_m, dy_m) < 0.3:
            return "arrived", ()
        if seen["felt"][0] and "hazard" in seen["events"]:
            return "backward", (0.2, 0.15)
        if not seen["looked"]:
            self.looks += 1
            if self.looks > 60:
                return "gave_up", ()
            if self.looks == 3:
                return "rest", (2.0,)
            return "look", (self.looks == 7,)
        bearing_rad = np.remainder(np.arctan2(dy_m, dx_m) - seen["pose"][2] + np.pi, 2 * np.pi) - np.pi
        if seen["blocked"] and self.turned < 6:
            self.turned += 1
            return "turn", (1 if self.looks % 3 else -1, 0.5)
        self.turned = 0
        return "forward", (float(np.clip(bearing_rad, -1, 1)), 0.45, 0.8)


def blocked(points):
    """Whether points lie high ahead; a look of the light stripe has hazards instead."""
    points = np.asarray(points, np.float32).reshape(-1, 3)
    return int(np.count_nonzero((points[:, 2] > 0.12) & (np.abs(points[:, 1]) < 0.3) & (points[:, 0] < 1.2))) > 3


class Scripted(ry.Navigator):
    """The policy as a navigator."""

    name, doc, reads = "scripted", "of a test", "hazards"
    parameters = [TOLERANCE]
    policies = []

    def traits(self):
        return {**super().traits(), "reads": self.reads, "cost": {"kind": "look", "time_s": 0.5}}

    def start(self, setup):
        self.policy = Policy()
        self.policies.append(self.policy)

    def decide(self, seen):
        at, stance = seen.estimate, seen.attitude
        told = {"time_s": seen.time_s, "events": seen.events, "pose": (at.x_m, at.y_m, at.heading_rad, at.distance_m),
                "attitude": (stance.roll_rad, stance.pitch_rad, stance.z_m), "goal": (self.goal.x_m, self.goal.y_m),
                "looked": seen.look is not None, "felt": (1 + FELT.index(seen.hazard.kind) if seen.hazard else 0,
                                                          seen.touches_behind, seen.notices_stuck)}
        told["blocked"] = blocked(seen.cloud.points_R) if seen.cloud else bool(seen.report and any(seen.report.hazards))
        what, given = self.policy.decide(told)
        functions = {"forward": lambda bend, way_m, share: decided.drive(bend, way_m, 1, share),
                     "backward": lambda bend, way_m: decided.drive(bend, way_m, -1),
                     "look": lambda behind: decided.look("behind" if behind else "ahead")}
        return functions.get(what, getattr(decided, what, None))(*given)


class OnPoints(Scripted):
    name, reads = "on_points", "points"


ACTIONS = {"forward": forward, "backward": backward, "turn": turn, "look": look, "rest": rest, "arrived": arrived, "gave_up": gave_up}
SETTINGS = {NOMINAL: {}, POINTS: {"sensors.stereo.columns": 40, "sensors.stereo.rows": 32}}  # of a quick drive
KINDS = {NOMINAL: Scripted, POINTS: OnPoints}


def told_by(observation):
    """Returns an observation as the policy gets it."""
    points = observation["points"][:observation["point_count"]]
    return {"time_s": float(observation["time_s"]),
            "events": [name for bit, name in enumerate(EVENTS) if int(observation["events"]) >> bit & 1],
            "pose": tuple(observation["pose"]), "attitude": tuple(observation["attitude"]), "goal": tuple(observation["goal"][:2]),
            "looked": bool(observation["looked"]), "felt": tuple(observation["felt"]),
            "blocked": blocked(points) if len(observation["points"]) else bool(np.any(observation["hazards"] == 1))}


def action_of(policy, observation):
    what, given = policy.decide(told_by(observation))
    return ACTIONS[what](*given)


def environment(scenario=NOMINAL, kind=Environment, **more):
    points = MOST_POINTS if scenario == POINTS else 0
    return kind(scenario, set={**QUICK, **SETTINGS[scenario]}, points=points, look_time_s=0.5, **more)


class Drive:
    """A drive of the policy that goes on when it is asked to."""

    def __init__(self, env, index):
        self.env, self.policy, self.record, self.steps = env, Policy(), None, 0
        self.observation, _ = env.reset(seed=SEED, index=index)

    def step(self):
        self.observation, self.reward, terminated, truncated, info = self.env.step(action_of(self.policy, self.observation))
        self.steps += 1
        self.record = info.get("record")
        assert (terminated or truncated) == (self.record is not None)
        return self.record is None


def drive(env, index):
    made = Drive(env, index)
    while made.step():
        pass
    return made


class EnvironmentTest(package.PackageTest):
    TRIALS, SCENARIOS = 3, (NOMINAL,)

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.runs, cls.policies = {}, {}
        for scenario in cls.SCENARIOS:
            kind = KINDS[scenario]
            kind.policies = []
            cls.runs[scenario] = run(f"run_{kind.name}", cls.TRIALS, scenario, deciders=[kind], threads=1,
                                     set=SETTINGS[scenario])
            cls.policies[scenario] = kind.policies

    def record(self, scenario, index):
        trial = self.runs[scenario].trial(index)
        return {**trial.record, "detail": trial.detail}

    def assert_record(self, record, index, scenario=NOMINAL):
        np.testing.assert_equal(record, self.record(scenario, index))


class Same(EnvironmentTest):
    TRIALS, SCENARIOS = 20, (NOMINAL, POINTS)

    def test_a_policy_gives_the_records_of_its_navigator(self):
        for scenario in KINDS:
            env = environment(scenario)
            for index in range(self.TRIALS):
                made = drive(env, index)
                self.assert_record(made.record, index, scenario)
                seen = self.policies[scenario][index].seen
                self.assertEqual(len(made.policy.seen), len(seen))
                for ours, theirs in zip(made.policy.seen, seen):
                    self.assertEqual(ours, theirs)
                self.assertEqual(made.reward, float(made.record["outcome"] == "goal_reached"))
        self.assert_is_worth_it()

    def assert_is_worth_it(self):
        """What the policies met: other drives would prove less."""
        for scenario in KINDS:
            seen = [each for policy in self.policies[scenario] for each in policy.seen]
            self.assertGreater(sum(each["blocked"] for each in seen), 20)
            events = {name for each in seen for name in each["events"]}
            self.assertTrue({"start", "look", "manoeuvre", "period", "pose_update" if scenario == NOMINAL else "hazard"} <= events)
            self.assertGreater(len(self.runs[scenario].outcomes), 1)
            self.assertIn("goal_reached", self.runs[scenario].outcomes)

    def test_two_at_once_and_interleaved_do_not_meet(self):
        drives = [Drive(environment(), 0), Drive(environment(POINTS), 1), Drive(environment(), 2)]
        going = list(drives)
        while going:
            going = [each for each in going if each.step()]
        for index, (made, scenario) in enumerate(zip(drives, (NOMINAL, POINTS, NOMINAL))):
            self.assert_record(made.record, index, scenario)

    def side_by_side(self, count, threads, trials):
        many = environment(kind=Environments, count=count, threads=threads)
        many.reset(list(range(count)), SEED)
        policies, at, records, next_trial = [Policy() for _ in range(count)], list(range(count)), {}, count
        while many.driving.any():
            observations = many._seen
            actions = np.array([action_of(policies[lane], {name: rows[lane] for name, rows in observations.items()})
                                if many.driving[lane] else arrived() for lane in range(count)])
            _, ended = many.step(actions)
            for lane in np.flatnonzero(ended):
                records[at[lane]] = many.record(lane)
                if next_trial < trials:
                    many.reset([next_trial], SEED, [lane])
                    policies[lane], at[lane], next_trial = Policy(), next_trial, next_trial + 1
        return records

    def test_eight_on_two_threads_are_one_at_a_time(self):
        for count, threads in ((8, 2), (3, 1), (5, 9)):
            with self.subTest(count=count, threads=threads):
                records = self.side_by_side(count, threads, 12)
                self.assertEqual(sorted(records), list(range(12)))
                for index, record in records.items():
                    self.assert_record(record, index)

    def test_the_seed_and_index_have_defaults(self):
        env = environment()
        first = env.reset()
        self.assertEqual(first[1], {"index": 0})
        self.assertEqual(env.reset()[1], {"index": 1})
        again, info = environment().reset(seed=ry.Scenario(NOMINAL)._core.seed, options={"index": 0})
        np.testing.assert_equal(again, first[0])
        ends = []
        for seed in (1, 1, 99):
            env.reset(seed=seed, index=0)
            ends.append(tuple(env.step(forward(0.0, 1.0))[0]["pose"]))
        self.assertEqual(ends[0], ends[1])
        self.assertNotEqual(ends[1], ends[2])

    def test_a_time_limit_truncates(self):
        env = Environment(NOMINAL, set={**QUICK, "referee.time_limit_s": 30})
        env.reset()
        *_, terminated, truncated, info = env.step(rest(1000))
        self.assertEqual((terminated, truncated, info["record"]["outcome"]), (False, True, "time_limit"))

    def test_a_reward_of_ones_own_is_asked(self):
        asked = []

        def progress(before, after, ended, record):
            asked.append((ended, record is not None))
            return float(before["goal"][2] - after["goal"][2])
        made = drive(environment(reward=progress), 0)
        self.assertEqual(asked, [(False, False)] * (made.steps - 1) + [(True, True)])

    def test_a_reward_that_raises_harms_nothing(self):
        env = environment(reward=lambda *given: 1 / 0)
        env.reset(seed=SEED, index=0)
        with self.assertRaises(ZeroDivisionError):
            env.step(look())
        env._reward = lambda *given: 0.0
        self.assert_record(drive(env, 0).record, 0)


class GivenUp(EnvironmentTest):
    def test_a_reset_in_the_middle_gives_the_drive_up(self):
        env = environment()
        for steps in (0, 1, 5, 20):
            made = Drive(env, 1)
            for _ in range(steps):
                made.step()
            self.assert_record(drive(env, 2).record, 2)

    def test_a_deletion_in_the_middle_leaves_nothing(self):
        for scenario in KINDS:
            env = environment(scenario)
            made = Drive(env, 0)
            for _ in range(5):
                made.step()
            drives = weakref.ref(env._all)
            del env, made
            gc.collect()
            self.assertIsNone(drives())
        many = environment(kind=Environments, count=4, threads=2)
        many.reset([0, 1, 2, 0], SEED)
        many.step(np.array([look()] * 4))
        seen = many._seen
        del many
        gc.collect()
        self.assertEqual(len(seen["pose"]), 4)  # arrays outlive the drives
        self.assert_record(drive(environment(), 0).record, 0)

    def test_a_closed_one_drives_no_more(self):
        env = environment()
        env.reset()
        env.close()
        env.close()
        self.refusal(env.step, look())
        self.refusal(env.reset)

    def test_a_step_after_the_end_is_refused(self):
        env = environment()
        self.refusal(env.step, look())
        drive(env, 0)
        self.refusal(env.step, look())
        self.assert_record(drive(env, 1).record, 1)
        many = environment(kind=Environments, count=2)
        self.assertFalse(many.driving.any())
        self.assertIsNone(many.record(0))
        many.reset([0], SEED, lanes=[1])
        self.assertEqual(list(many.driving), [False, True])
        _, ended = many.step(np.array([look(), gave_up()]))
        self.assertEqual(list(ended), [False, True])
        self.assertEqual(many.record(1)["outcome"], "no_path")
        self.assertEqual(list(many.step(np.array([look(), look()]))[1]), [False, False])


class Wrong(package.PackageTest):
    def test_wrong_actions_are_refused_and_change_nothing(self):
        env, other = environment(), environment()
        env.reset(seed=SEED, index=0)
        other.reset(seed=SEED, index=0)
        nan = float("nan")
        for wrong in (
                np.zeros(5), np.zeros(7), [], np.array([9.0, 0, 0, 0, 0, 0]), np.array([-1.0, 0, 0, 0, 0, 0]), np.array([nan] * 6),
                forward(nan), forward(1e4), forward(0.0, nan), forward(0.0, -1.0), forward(speed_share=1.5), forward(speed_share=-0.5),
                forward(speed_share=nan), turn(1, -0.5), turn(1, nan), rest(-1), rest(nan), backward(float("inf"))):
            self.assertIn("action", str(self.refusal(env.step, wrong)), wrong)
        for wrong in ("left", {"kind": 1}, None, [object()] * 6):
            with self.assertRaises((ry.InputError, ValueError, TypeError)):
                env.step(wrong)
        for action in (look(), forward(0.1, 0.3)):
            np.testing.assert_equal(env.step(action), other.step(action))

    def test_one_wrong_action_of_many_stops_all(self):
        many = environment(kind=Environments, count=3)
        many.reset([0, 1, 2], SEED)
        before = {name: rows.copy() for name, rows in many._seen.items()}
        self.refusal(many.step, np.array([look(), forward(1e6), look()]))
        np.testing.assert_equal(many._seen, before)
        self.refusal(many.step, np.array([look()] * 2))
        self.refusal(many.step, look())

    def test_wrong_numbers_are_refused(self):
        many = environment(kind=Environments, count=2)
        for given in (([0],), ([0, 1, 2],), ([0, -1],), ([0, 2**33],), ([0, "1"],), ([0], None, [2]), ([0], None, [-1]), ([0, 1], -1)):
            self.refusal(many.reset, *given)
        self.assertFalse(many.driving.any())
        for more in ({"count": 0}, {"count": -1}, {"threads": 0}, {"points": -1}, {"count": 1.5}):
            self.refusal(environment, kind=Environments, **more) if "points" not in more else self.refusal(Environments, NOMINAL, **more)
        self.refusal(environment().reset, index=-1)

    def test_what_is_no_drive_is_refused(self):
        for name in ("mission/no_aid", "hazard_detection/detection"):
            self.assertIn("experiment", str(self.refusal(Environment, name)))
        self.refusal(Environment, "no_such_scenario")
        self.refusal(Environment, NOMINAL, set={"course.goal_radius_m": 0.2}, goal_tolerance_m=0.3)
        self.refusal(Environment, NOMINAL, goal_tolerance_m=-1)

    def test_its_scenario_can_be_run(self):
        env = environment()
        self.assertEqual(ry.run(env.scenario, 1, SEED, folder="plain").hash, run("plain_too", 1).hash)
        self.assertEqual(env.scenario["navigation.navigator"], "pathfinder")


class Spaces(package.PackageTest):
    def test_spaces_hold_every_observation_and_sampled_actions_are_done(self):
        generator = np.random.default_rng(1)
        for scenario in KINDS:
            env = environment(scenario)
            for index in range(4):
                observation, _ = env.reset(seed=SEED, index=index)
                for _ in range(25):
                    self.assertEqual(set(observation), set(env.observation_space))
                    for name, space in env.observation_space.items():
                        value = np.asarray(observation[name])
                        self.assertTrue(space.contains(value), (name, value))
                        self.assertEqual(value.dtype, space.dtype, name)
                    action = env.action_space.sample(generator)
                    self.assertTrue(env.action_space.contains(action))
                    observation, *_, terminated, truncated, _ = env.step(action)
                    if terminated or truncated:
                        break

    def test_observations_are_copies_of_one_and_views_of_many(self):
        env = environment()
        first, _ = env.reset(seed=SEED, index=0)
        before = {name: np.copy(value) for name, value in first.items()}
        env.step(forward(0.0, 0.5))
        np.testing.assert_equal(first, before)

    def test_actions_are_rows_of_their_columns(self):
        self.assertEqual(len(ACTION), len(forward()))
        self.assertEqual([each(*given)[0] for each, given in (
            (forward, ()), (backward, ()), (turn, (1,)), (turn, (-1,)), (look, ()), (look, (True,)), (rest, (1,)), (arrived, ()),
            (gave_up, ()))], list(Kind))
        self.assertEqual(list(forward(0.1, 0.5, 0.7)), [0, 0.1, 0.5, 0, 0, 0.7])

    def test_gymnasium_gets_its_own_spaces(self):
        with self.assertRaises(ry.MissingPart) as missing:
            gymnasium_environment(NOMINAL)
        self.assertIn("gymnasium", str(missing.exception))
        stub = types.ModuleType("gymnasium")
        stub.Env = type("Env", (), {"reset": lambda self, seed=None: None})
        stub.spaces = types.SimpleNamespace(Dict=dict, Box=lambda low, high, shape, dtype: (np.asarray(low).shape, shape, dtype))
        sys.modules["gymnasium"] = stub
        self.addCleanup(sys.modules.pop, "gymnasium")
        env = gymnasium_environment(NOMINAL, set=QUICK)
        for low, shape, _ in (*env.observation_space.values(), env.action_space):
            self.assertEqual(low, shape)
        observation, info = env.reset(seed=SEED, options={"index": 3})
        self.assertEqual(info, {"index": 3})
        np.testing.assert_equal(observation, environment().reset(seed=SEED, index=3)[0])
        self.assertEqual(len(env.step(look())), 5)
        env.close()


class Threads(EnvironmentTest):
    def test_a_drive_goes_on_in_another_thread(self):
        """Its stack moves between threads of Python, those that estimators in Python take included."""
        from estimators_test import DeadReckoning
        held = ry.Scenario(NOMINAL, set=QUICK, deciders=[DeadReckoning])
        for scenario in (NOMINAL, held):
            made = Drive(Environment(scenario, set=QUICK, look_time_s=0.5), 1)
            while made.record is None:
                thread = threading.Thread(target=made.step)
                thread.start()
                thread.join()
            self.assert_record(made.record, 1)

    def test_an_environment_is_let_go_in_another_thread(self):
        held = [Drive(environment(), 0)]
        held[0].step()
        thread = threading.Thread(target=held.clear)
        thread.start()
        thread.join()
        self.assert_record(drive(environment(), 0).record, 0)

    def test_two_threads_step_two_environments(self):
        made = {}
        threads = [threading.Thread(target=lambda at=at: made.update({at: drive(environment(), at).record})) for at in (0, 1, 2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for index, record in made.items():
            self.assert_record(record, index)
        self.assertEqual(len(made), 3)

    def test_two_threads_on_one_environment_are_refused(self):
        """A drive cannot go on twice at once. The estimator waits until the other thread has tried."""
        from estimators_test import DeadReckoning
        inside, tried = threading.Event(), threading.Event()

        class Waits(DeadReckoning):
            name = "waits"

            def propagate(self, *motion):
                super().propagate(*motion)
                inside.set()
                tried.wait(30)
        env = Environment(ry.Scenario(NOMINAL, set=QUICK, deciders=[Waits]))
        env.reset()  # a drive begins with a decision: nothing has moved
        thread = threading.Thread(target=env.step, args=(forward(0.0, 0.2),))
        thread.start()
        self.assertTrue(inside.wait(30))
        for call in (lambda: env.step(look()), env.reset, lambda: env._all.driving, lambda: env._all.record(0)):
            self.assertIn("another thread", str(self.refusal(call)))
        tried.set()
        thread.join()

    def test_an_estimator_that_recurs_ends_its_drive_alone(self):
        from estimators_test import DeadReckoning

        class Recurs(DeadReckoning):
            name = "recurs"

            def propagate(self, *motion):
                self.more

            def __getattr__(self, name):
                return getattr(self, name + "x")
        env = Environment(ry.Scenario(NOMINAL, set=QUICK, deciders=[Recurs]))
        env.reset()
        *_, info = env.step(forward())
        self.assertEqual(info["record"]["outcome"], "navigator_fault")
        self.assertIn("RecursionError", info["record"]["detail"])


class Forks(package.PackageTest):
    def test_a_fork_leaves_the_drives_to_its_parent(self):
        for threads in (1, 2):
            many = environment(kind=Environments, count=2, threads=threads)
            many.reset([0, 1], SEED)
            child = os.fork()
            if child == 0:
                code = 1
                try:
                    try:
                        many.step(np.array([look()] * 2))
                    except ry.InputError as error:
                        code = 0 if "forked" in str(error) else 2
                    del many
                    gc.collect()
                    fresh = environment()
                    fresh.reset(seed=SEED, index=0)
                    fresh.step(look())
                    del fresh
                    gc.collect()
                finally:
                    os._exit(code)
            self.assertEqual(os.waitpid(child, 0)[1], 0)
            self.assertEqual(list(many.step(np.array([look()] * 2))[1]), [False, False])

    def test_a_program_ends_with_drives_under_way(self):
        program = """
            import sys
            sys.path.insert(0, sys.argv.pop(1))
            from environments_test import *
            from estimators_test import DeadReckoning
            held = ry.Scenario(NOMINAL, set=QUICK, deciders=[DeadReckoning])
            kept = [Environments(held, 3, threads=threads) for threads in (1, 2)]
            for each in kept:
                each.reset([0, 1, 2])
                each.step(np.array([forward(0.0, 0.3)] * 3))
            kept.append(kept)
            print("ended", flush=True)
            {}
            """
        for end in ("", "sys.exit(0)", "import builtins; builtins.kept = kept"):
            self.assertEqual(package.python(program.format(end), os.path.dirname(__file__)).stdout, "ended\n")


if __name__ == "__main__":
    package.main()
