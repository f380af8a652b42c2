#!/usr/bin/env python3
"""The process of a navigator that does harm as it is told, for hostile_navigators.py: at the `at`-th question of a
drive whose seed is divisible by `every`, what `harm` names."""

import json
import os
import signal
import struct
import sys
import time

HARMS = ["none", "error", "raises", "crashes", "aborts", "hangs", "sleeps", "nan", "text_for_number", "no_direction",
         "garbage", "too_long", "two_answers", "half_an_answer", "no_object", "endless_answer", "endless_stderr",
         "prints", "exits", "closes", "forks", "daemon", "allocates", "kills_itself", "stops_itself", "wrong_own"]
requests, answers = os.fdopen(3, "rb"), os.fdopen(4, "wb")


def read():
    head = requests.read(4)
    if len(head) < 4:
        sys.exit(0)
    return json.loads(requests.read(struct.unpack("<I", head)[0]))


def write(answer, text=None):
    body = (json.dumps(answer) if text is None else text).encode()
    answers.write(struct.pack("<I", len(body)) + body)
    answers.flush()


def do(harm, answer):
    """Does it. Returns whether the answer is still to be written."""
    if harm == "error":
        answer.clear()
        answer["error"] = "as it was told"
    elif harm == "raises":
        raise RuntimeError("as it was told")
    elif harm == "crashes":
        os.kill(os.getpid(), signal.SIGSEGV)
    elif harm == "aborts":
        os.abort()
    elif harm == "hangs":
        while True:
            pass
    elif harm == "sleeps":
        time.sleep(1000)
    elif harm == "nan":
        answer["motion"] = {"kind": "arc", "curvature_per_m": float("nan")}
    elif harm == "text_for_number":
        answer["motion"] = {"kind": "arc", "curvature_per_m": "sharp"}
    elif harm == "no_direction":
        answer["motion"] = {"kind": "arc", "direction": 0}
    elif harm == "garbage":
        write(None, "\x00not json {{{")
        return False
    elif harm == "too_long":
        answers.write(b"\xff\xff\xff\xff")
        answers.flush()
        return False
    elif harm == "two_answers":
        write(answer)
    elif harm == "half_an_answer":
        answers.write(struct.pack("<I", 1000) + b"{")
        answers.flush()
        os._exit(0)
    elif harm == "no_object":
        write([1, 2, 3])
        return False
    elif harm == "endless_answer":
        while True:
            answers.write(b"x" * 65536)
    elif harm == "endless_stderr":
        while True:
            os.write(2, b"y" * 65536)
    elif harm == "prints":
        print("a navigator that prints\n" * 1000)
    elif harm == "exits":
        sys.exit(0)
    elif harm == "closes":
        os.close(4)
        time.sleep(1000)
    elif harm == "forks":
        for _ in range(5):
            if os.fork() == 0:
                time.sleep(1000)
    elif harm == "daemon":
        if os.fork() == 0:
            os.setsid()
            if os.fork() == 0:
                time.sleep(30)
            os._exit(0)
    elif harm == "allocates":
        blocks = []
        for _ in range(10):
            blocks.append(b"z" * (1 << 30))
    elif harm == "kills_itself":
        os.kill(os.getpid(), signal.SIGKILL)
    elif harm == "stops_itself":
        os.kill(os.getpid(), signal.SIGSTOP)
    elif harm == "wrong_own":
        answer["own_values"] = [1, 2, 3]
    return True


def describe():
    numbers = [{"name": name, "type": "integer", "default": value, "min": 1, "max": 1000}
               for name, value in (("at", 1), ("every", 3))]
    return {"protocol": 1, "name": "hostile", "version": "1",
            "parameters": [{"name": "goal_tolerance_m", "type": "real", "default": 0.3},
                           {"name": "harm", "type": "choice", "choices": HARMS, "default": 0}] + numbers}


def main():
    asked, hostile, goal, parameters = 0, False, None, None
    while True:
        request = read()
        kind, answer = request["type"], {}
        of = {"id": request["id"]}
        if kind == "describe":
            answer = describe()
        elif kind == "traits":
            answer = {"reads": "nothing",
                      "goal_tolerance": {"parameter": "goal_tolerance_m",
                                         "value_m": request["parameters"]["goal_tolerance_m"]}}
        elif kind == "start":
            parameters, goal, asked = request["parameters"], request["setup"]["goal"], 0
            hostile = int(request["setup"]["random_seed"]) % parameters["every"] == 0
        elif kind == "goal":
            goal = request["goal"]
        elif kind == "decide":
            here = request["estimate"]
            way_m = ((goal["x_m"] - here["x_m"]) ** 2 + (goal["y_m"] - here["y_m"]) ** 2) ** 0.5
            answer = {"motion": {"kind": "arc"}, "until": {"distance_m": 0.2}}
            if way_m <= parameters["goal_tolerance_m"]:
                answer = {"status": "arrived"}
            answer |= of
            asked += 1
            if hostile and asked == parameters["at"] and not do(parameters["harm"], answer):
                continue
        write({**answer, **of})


main()
