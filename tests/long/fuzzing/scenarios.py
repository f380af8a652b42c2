"""Scenario and sweep files that are wrong in some way, read by `rockyard validate`."""

import json
import re
import shutil
import tempfile
from pathlib import Path

from fuzzing import harness
from progress import Progress

BATCH = 100  # files that one process reads
TIMEOUT_S = 600

NUMBERS = [0, -1, 1, -0.0, 1e-300, 5e-324, 1e308, -1e308, 2**31, -2**31, 2**53 + 1, 2**63 - 1, 2**63, 2**64,
           -2**63 - 1, 10**40, 0.1, 1e16, 90, 360, 1e9]
TEXTS = ["", " ", "a", "none", "\x00", "\u202e", "\ud7ff", "\U0010ffff", "../../../etc/passwd", "nominal.json",
         "x" * 200, "x" * 20000, "=1+1", "'; DROP TABLE trials; --", "<script>alert(1)</script>", "%s%n",
         "{}", "\n", "\r\n\t", "-x", "NaN", "1e5", "true"]
# What JSON is not, put in the place of a value.
RAW = ["NaN", "Infinity", "-Infinity", "1e999", "-1e999", "01", "+1", ".5", "1.", "0x10", "1e", "'a'", "undefined",
       "nul", "TRUE", '"\\x"', '"\\u12"', '"\\ud800"', '"a', "/* c */ 1", "1 2", "", ",", "[", "{", "]", "}",
       "9" * 400, "0." + "0" * 400 + "1", "1e-999", '"\\u0000"', "[" * 40 + "]" * 40, "[" * 5000,
       '{"a":' * 40 + "1" + "}" * 40, '{"a":' * 5000, '"' + "y" * 70000 + '"']
PLACE = "@@here@@"
# Characters: a hundred copies of copies of everything would take more memory than there is.
LARGEST = 1 << 22


def sources(rockyard):
    """Every scenario and sweep file, with what it extends named by a whole path; and all defaults."""
    found = []
    for path in sorted((harness.ROOT / "scenarios").rglob("*.json")):
        found.append(_absolute(json.loads(path.read_text(encoding="utf-8")), path.parent))
    defaults = harness.run([rockyard, "defaults"], harness.ROOT, TIMEOUT_S)
    found += [json.loads(defaults.out)] * max(1, len(found) // 3)  # every key there is, in a quarter of all
    return found


def _absolute(value, folder):
    if isinstance(value, list):
        return [_absolute(item, folder) for item in value]
    if isinstance(value, str) and value.endswith(".json") and (folder / value).is_file():
        return str((folder / value).resolve())
    if isinstance(value, dict):
        return {key: _absolute(item, folder) for key, item in value.items()}
    return value


def _places(value, found, top=True):
    """Every (container, key) of a document."""
    entries = value.items() if isinstance(value, dict) else enumerate(value)
    for key, item in entries:
        found.append((value, key))
        if isinstance(item, (dict, list)):
            _places(item, found, False)
    return found


def _misspelt(word, rng):
    if not word:
        return "a"
    at = rng.randrange(len(word))
    return rng.choice([word[:at] + word[at + 1:], word[:at] + rng.choice("aeiou_.\u202e") + word[at:],
                       word[:at] + word[at:].swapcase(), word + "_m"])


def _copies(value, count):
    """Copies that share nothing: a change of one of a hundred must not be a change of all, again and again."""
    text = json.dumps(value)
    return [json.loads(text) for _ in range(count if count * len(text) < LARGEST else 1)]


def _other_value(value, rng):
    kind = rng.randrange(8)
    if kind == 0:
        return rng.choice(NUMBERS)
    if kind == 1:
        return rng.choice(TEXTS)
    if kind == 2:
        return rng.choice([None, True, False, [], {}, [[]], [{}], {"": 1}, {"extends": 1}, {"extends": "none.json"}])
    if kind == 3 and isinstance(value, (int, float)) and not isinstance(value, bool):
        return value * rng.choice([-1, 0, 2, 10, 1e3, 1e6, 1e-3, 1e-9, 1e300])
    if kind == 4:
        return _copies(value, rng.choice([1, 2, 3, 100]))
    if kind == 5 and isinstance(value, list):
        return value[: rng.randrange(len(value) + 1)] + sum(_copies(value, rng.randrange(3)), [])
    if kind == 6:
        deep = value
        for _ in range(rng.choice([1, 10, 31, 33, 200])):
            deep = [deep] if rng.random() < 0.5 else {"a": deep}
        return deep
    return rng.uniform(-1, 1) * 10.0 ** rng.randrange(-12, 13)


def _change(document, everything, rng):
    """One change of the document in place; what is to stand there literally, or None."""
    places = _places(document, [])
    if not places:
        document["name"] = rng.choice(TEXTS)
        return None
    container, key = rng.choice(places)
    kind = rng.randrange(10)
    if kind < 5:
        container[key] = _other_value(container[key], rng)
    elif kind == 5:
        del container[key]
    elif kind == 6 and isinstance(container, dict):
        container[_misspelt(key, rng)] = container.pop(key)
    elif kind == 7 and isinstance(container, dict):
        container[rng.choice(TEXTS)] = rng.choice(NUMBERS + TEXTS)
    elif kind == 8:
        donor, there = rng.choice(_places(rng.choice(everything), []) or [(container, key)])
        container[key] = json.loads(json.dumps(donor[there]))
    else:
        raw = rng.choice(RAW)
        container[key] = PLACE
        return raw
    return None


def _spoil_bytes(data, rng):
    """Bytes that are no such text any more, or another encoding of it."""
    kind = rng.randrange(9)
    at = rng.randrange(len(data) + 1)
    text = data.decode("utf-8", "surrogatepass")
    if kind == 0:
        return data[:at]
    if kind == 1:
        return data[:at] + bytes([rng.randrange(256)]) + data[at + 1:]
    if kind == 2:
        return data[:at] + bytes(rng.randrange(256) for _ in range(rng.randrange(1, 9))) + data[at:]
    if kind == 3:
        return data[:at] + data[rng.randrange(len(data) + 1):]
    if kind == 4:
        return b"\xef\xbb\xbf" + data
    if kind == 5:
        return text.encode(rng.choice(["utf-16", "utf-16-le", "utf-32", "cp500"]), "replace")
    if kind == 6:
        return data + rng.choice([b"\x00", b"{}", b"\n\n\n", b"\xff", data])
    if kind == 7:  # a key twice
        return re.sub(rb'"(\w+)": ([^,{}\[\]\n]+),', rb'"\1": \2, "\1": \2,', data, count=1)
    return bytes(rng.randrange(256) for _ in range(rng.randrange(200)))


def make(everything, rng):
    """The bytes of one file."""
    document = json.loads(json.dumps(rng.choice(everything)))
    raws = []
    for _ in range(rng.choice([1, 1, 1, 2, 3, 8])):
        if not isinstance(document, dict):
            break
        raw = _change(document, everything, rng)
        if raw is not None:
            raws.append(raw)
    text = json.dumps(document, ensure_ascii=rng.random() < 0.5, indent=rng.choice([None, 2]))
    for raw in raws:
        text = text.replace(f'"{PLACE}"', raw, 1)
    data = text.encode("utf-8", "surrogatepass")
    return _spoil_bytes(data, rng) if rng.random() < 0.15 else data


def _command(rockyard, names):
    return [rockyard, "validate", *names]


def _unheard(names, end):
    """The first file of which nothing is said."""
    said = set(re.findall(r"^(\d+\.json): valid, ", end.out, re.M))
    said |= set(re.findall(r"^error: (\d+\.json): ", end.err, re.M))
    return next((name for name in names if name not in said), None)


def _one_by_one(rockyard, names, folder, findings):
    for name in names:
        end = harness.run(_command(rockyard, [name]), folder, TIMEOUT_S)
        reason = harness.problem_of(end, {harness.DONE, harness.BAD_INPUT})
        if reason:
            findings.fail(int(name.split(".")[0]), reason, _command(rockyard, [name]), end, [Path(folder) / name])


def run(rockyard, first, count, findings):
    """Cases `first` to `count` - 1."""
    everything = sources(rockyard)
    folder = tempfile.mkdtemp(prefix="rockyard-fuzz-", dir="/dev/shm" if Path("/dev/shm").is_dir() else None)
    try:
        progress = Progress(findings.part, count - first)
        for begin in range(first, count, BATCH):
            progress.at(begin - first, len(findings.failures))
            names = []
            for index in range(begin, min(begin + BATCH, count)):
                data = make(everything, harness.generator(findings.seed, findings.part, index))
                names.append(f"{index}.json")
                (Path(folder) / names[-1]).write_bytes(data)
            end = harness.run(_command(rockyard, names), folder, TIMEOUT_S)
            findings.counts["files"] += len(names)
            findings.counts["valid"] += len(re.findall(r": valid, ", end.out))
            if harness.problem_of(end, {harness.DONE, harness.BAD_INPUT}):
                _one_by_one(rockyard, names, folder, findings)
            elif len(names) > 1 and _unheard(names, end):
                findings.fail(int(_unheard(names, end).split(".")[0]), "is not told of", _command(rockyard, names),
                              end, [Path(folder) / _unheard(names, end)])
            for name in names:
                (Path(folder) / name).unlink()
    finally:
        shutil.rmtree(folder, ignore_errors=True)
