#!/usr/bin/env python3
"""The package among other things of a program: errors of its own functions, threads, forks, pools of processes, an end in
the middle; and what it holds on to.

Usage: processes_test.py ROCKYARD PLUGINS [unittest's arguments]
"""

import concurrent.futures
import contextlib
import gc
import io
import multiprocessing
import os
import signal
import sys
import threading
import time
from pathlib import Path

import package
import rockyard as ry
from package import NOMINAL, PLUGINS, QUICK, SEED, files, navigator, python, run
from rockyard.environment import Environment, Environments, forward, look

import numpy as np

HERE = Path(__file__).parent
PROGRAM = """
    import sys
    sys.path.insert(0, sys.argv.pop(1))
    from processes_test import *
    """


def program(text, *words, **more):
    """Runs a program that has all names of this test."""
    import textwrap
    return python(textwrap.dedent(PROGRAM) + textwrap.dedent(text), HERE, *words, **more)


def hash_of(trials, folder):
    """Runs a campaign in another process."""
    return run(folder, trials).hash


class Progress(package.PackageTest):
    def test_it_counts_to_the_end(self):
        told = []
        run("counted", 8, threads=2, resume=True)
        made = ry.run(NOMINAL, 8, SEED, set=QUICK, folder="counted_too", progress=lambda *each: told.append(each))
        self.assertEqual(told[-1], (8, 8))
        self.assertEqual(told, sorted(told))
        self.assertEqual(made.hash, ry.load("counted").hash)

    def test_a_line_is_shown_where_it_is_asked_for(self):
        for progress, shown in ((True, True), (False, False), (None, False)):
            with contextlib.redirect_stderr(io.StringIO()) as told:
                ry.run(NOMINAL, 2, SEED, set=QUICK, folder=f"line{progress}", progress=progress)
            self.assertEqual("2/2" in told.getvalue(), shown, told.getvalue())

    def test_an_error_of_it_ends_the_run_early(self):
        class Enough(Exception):
            pass
        for number, error in enumerate((Enough("enough"), KeyboardInterrupt(), SystemExit(3))):
            raised, begun = threading.Event(), []

            def progress(finished, planned):
                raised.set()
                raise error

            def start(self, setup):
                begun.append(setup.random_seed)
                if len(begun) > 2:
                    raised.wait(60)
            kind = navigator("waits", start=start)
            with self.assertRaises(type(error)) as caught:
                ry.run(NOMINAL, 6, SEED, set=QUICK, folder=f"early{number}", progress=progress, threads=1, deciders=[kind])
            self.assertIs(caught.exception, error)
            self.assertTrue(2 <= len(ry.load(f"early{number}")) < 6)
            whole = run(f"early{number}", 6, resume=True, deciders=[kind])
            self.assertEqual(len(set(begun)), 6, "none was driven twice")
            self.assertEqual(len(begun), 6)
        self.assertEqual(whole.hash, run("undisturbed", 6, deciders=[kind]).hash)

    def test_it_may_call_the_package(self):
        inner = []

        def progress(finished, planned):
            if not inner:
                inner.append(run("inner", 2).hash)
        ry.run(NOMINAL, 4, SEED, set=QUICK, folder="outer", progress=progress)
        self.assertEqual(inner, [run("inner_too", 2).hash])


class Threads(package.PackageTest):
    def test_two_threads_run_campaigns_at_once(self):
        plain = run("twice", 6).hash
        with concurrent.futures.ThreadPoolExecutor(3) as pool:
            made = list(pool.map(lambda number: run(f"thread{number}", 6, threads=2).hash, range(4)))
        self.assertEqual(made, [plain] * 4)

    def test_two_threads_on_one_folder_do_not_meet(self):
        def attempt(_):
            try:
                return run("shared", 6, resume=True).hash
            except ry.InputError as error:
                return str(error)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            told = list(pool.map(attempt, range(2)))
        self.assertIn(run("alone", 6).hash, told)
        for each in told:
            self.assertTrue(each == ry.load("alone").hash or "in use by another run" in each, each)

    def test_threads_share_a_scenario_whose_navigator_is_python(self):
        """None waits for the interpreter's lock while it holds one that another waits for with it."""
        held = ry.Scenario(NOMINAL, set=QUICK, deciders=[navigator(name="shared")])
        over = time.monotonic() + 1.0

        def work(number):
            count = 0
            while time.monotonic() < over and count < 60:
                count += 1
                tolerance = 0.1 + 0.001 * count + 0.1 * number  # asks for traits anew
                copy = ry.Scenario(held, {"navigation.shared.goal_tolerance_m": tolerance})
                copy.resolved()
                copy._core.columns()
                Environment(copy, goal_tolerance_m=0.2)
            return count
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            self.assertGreater(min(pool.map(work, range(4))), 0)

    def test_a_run_in_another_thread_leaves_signals_alone(self):
        told = program("""
            def later():
                time.sleep(0.3)
                os.kill(os.getpid(), signal.SIGINT)
            thread = threading.Thread(target=later)
            made = {}
            worker = threading.Thread(target=lambda: made.update(hash=run("behind", 40).hash))
            worker.start()
            thread.start()
            try:
                time.sleep(60)
            except KeyboardInterrupt:
                print("interrupted")
            worker.join()
            print(made["hash"])
            """).stdout.split()
        self.assertEqual(told, ["interrupted", run("plain40", 40).hash])

    def test_a_handler_of_ones_own_is_called(self):
        told = program("""
            seen = []
            signal.signal(signal.SIGUSR1, lambda *given: seen.append("seen"))
            def start(self, setup):
                os.kill(os.getpid(), signal.SIGUSR1)
                while not seen:
                    time.sleep(0.01)
            made = run("handled", 1, deciders=[navigator("signals", start=start)])
            print(seen, len(made))
            """).stdout
        self.assertEqual(told, "['seen'] 1\n")

    def test_a_program_ends_though_a_thread_still_runs(self):
        for more in ("", ", plugins=[sys.argv[1]]"):
            done = program(f"""
                threading.Thread(target=lambda: run("endless", 100000{more}), daemon=True).start()
                while not Path("endless/results.sqlite").exists():
                    time.sleep(0.01)
                print("ends", flush=True)
                """, PLUGINS["pathfinder_twin"])
            self.assertEqual(done.stdout, "ends\n")
            stored = ry.load("endless")
            self.assertLess(len(stored), 100000)
            os.rename("endless", f"ended{len(more)}")


class Processes(package.PackageTest):
    def test_forks_and_pools_run_campaigns_after_a_run(self):
        plain = run("plain", 4).hash
        env = Environment(NOMINAL, set=QUICK)
        env.reset(seed=SEED, index=0)
        for method in ("fork", "spawn", "forkserver"):
            with self.subTest(method):
                context = multiprocessing.get_context(method)
                with context.Pool(2) as pool:
                    made = pool.starmap(hash_of, [(4, f"{method}{number}") for number in range(3)])
                self.assertEqual(made, [plain] * 3)
        self.assertEqual(env.step(look())[2:4], (False, False))

    def test_a_fork_runs_and_ends_by_itself(self):
        run("before", 2)
        child = os.fork()
        if child == 0:
            code = 1
            try:
                run("of_child", 2, threads=2)
                code = 0
            finally:
                os._exit(code)
        self.assertEqual(os.waitpid(child, 0)[1], 0)
        self.assertEqual(ry.load("of_child").hash, ry.load("before").hash)

    def test_a_fork_by_progress_leaves_the_run_to_its_parent(self):
        told = program("""
            children = []
            def progress(finished, planned):
                if not children:
                    children.append(os.fork())
            try:
                made = ry.run(NOMINAL, 20, SEED, set=QUICK, folder="forking", progress=progress)
                print(len(made), os.waitpid(children[0], 0)[1], flush=True)
            except ry.InputError as error:
                print("forked" in str(error), flush=True)
            """).stdout.split("\n")
        self.assertEqual(sorted(told), ["", "20 0", "True"])

    def test_a_worker_that_is_killed_is_replaced(self):
        """SIGCHLD goes to whichever thread takes it: nobody waits for ever."""
        from estimators_test import DeadReckoning
        killed, go = [], self.folder / "go"

        class Waits(DeadReckoning):
            name = "waits"

            def start(self, setup):
                super().start(setup)
                while not go.exists():
                    time.sleep(0.01)

        def progress(finished, planned):
            if not killed:
                killed.extend(children())
                go.touch()
                for worker in killed:
                    os.kill(worker, signal.SIGKILL)
        with self.assertWarnsRegex(UserWarning, "SIGKILL"):
            made = ry.run(NOMINAL, 4, SEED, set=QUICK, folder="killed", plugins=[PLUGINS["pathfinder_twin"]], deciders=[Waits],
                          progress=progress)
        self.assertTrue(killed)
        self.assertEqual(made.hash, run("quiet", 4).hash)
        self.assertEqual(children(), [])


def children():
    """Returns the processes that this one has started and that live."""
    found = []
    for task in Path("/proc/self/task").iterdir():
        found += map(int, (task / "children").read_text().split())
    return found


class Leaks(package.PackageTest):
    @staticmethod
    def resident_mb():
        gc.collect()
        pages = int(Path("/proc/self/statm").read_text().split()[1])
        return pages * os.sysconf("SC_PAGE_SIZE") / 2**20

    def assert_bounded(self, work, times, most_mb):
        for _ in range(times // 4):  # what is kept is there then
            work()
        before, open_before = self.resident_mb(), len(os.listdir("/proc/self/fd"))
        for _ in range(times):
            work()
        grown = self.resident_mb() - before
        self.assertLess(grown, most_mb, f"{grown:.1f} MB by {times}")
        self.assertLessEqual(len(os.listdir("/proc/self/fd")), open_before)

    def test_environments_are_let_go(self):
        held = ry.Scenario(NOMINAL, set=QUICK)

        def work():
            env = Environment(held)
            env.reset(seed=SEED, index=0)
            env.step(forward(0.0, 0.3))
        self.assert_bounded(work, 200, 12)

    def test_threads_of_environments_are_let_go(self):
        held = ry.Scenario(NOMINAL, set=QUICK)
        before = len(os.listdir("/proc/self/task"))

        def work():
            many = Environments(held, 3, threads=3)
            many.reset([0, 1, 2], SEED)
        self.assert_bounded(work, 12, 12)
        self.assertEqual(len(os.listdir("/proc/self/task")), before)

    def test_opened_runs_are_let_go(self):
        run("opened", 4, traces=["all"])

        def work():
            opened = ry.load("opened")
            self.assertEqual(len(opened.records), 4)
            self.assertEqual(len(opened.trials), 4)
            self.assertGreater(opened.trial(0).trace["time_s"].size, 0)
            self.assertGreater(len(opened.trial(0).place.rocks), 0)
        self.assert_bounded(work, 50, 12)

    def test_campaigns_and_their_deciders_are_let_go(self):
        import weakref
        kinds = []

        def work():
            made = navigator()
            kinds.append(weakref.ref(made))
            run("again", 1, deciders=[made], force=True)
        self.assert_bounded(work, 8, 16)
        gc.collect()
        self.assertEqual([kind for kind in kinds if kind() is not None], [])


if __name__ == "__main__":
    package.main()
