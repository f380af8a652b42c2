"""The course of one trial: arrays over time, in SI units; W is the world, R the rover."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, Mapping

import numpy as np

from .errors import UnknownName, need

if TYPE_CHECKING:
    from os import PathLike

    import pandas

    Array = np.ndarray[Any, Any]


def _position_error_m(trace: "Mapping[str, Any]") -> "Array":
    apart: "Array" = np.linalg.norm(trace["believed"][:, :2] - trace["position_m"][:, :2], axis=1)
    return apart


def _heading_error_rad(trace: "Mapping[str, Any]") -> "Array":
    turned = trace["believed"][:, 2] - trace["heading_rad"]
    error: "Array" = np.arctan2(np.sin(turned), np.cos(turned))
    return error


def _speed_m_s(trace: "Mapping[str, Any]") -> "Array":
    way = np.linalg.norm(np.diff(trace["position_m"], axis=0), axis=1)
    passed = np.diff(trace["time_s"])
    speed = np.divide(way, passed, out=np.zeros_like(way), where=(passed > 0) & (trace["set_back"][1:] == 0))
    return np.concatenate([[0.0], speed])


# What follows from the arrays of a trace.
DERIVED = {"position_error_m": _position_error_m, "heading_error_rad": _heading_error_rad, "speed_m_s": _speed_m_s}


def quantity_of(file: "str | PathLike[str]", quantity: str) -> "tuple[Array, Array]":
    """Returns (time_s, quantity) of a stored trace; reads no other arrays."""
    with np.load(file) as arrays:
        return arrays["time_s"], _value(arrays, quantity)


def _value(arrays: "Mapping[str, Any]", name: str) -> "Array":
    if name in DERIVED:
        return DERIVED[name](arrays)
    if name not in arrays:
        raise UnknownName("a trace", name, [*DERIVED, *arrays])
    return arrays[name]  # type: ignore[no-any-return]


class Trace(Mapping[str, Any]):
    """trace["position_m"] or trace.position_m: moments x 3. src/replay/README.md lists the arrays.

    Beside them: position_error_m (in the plane, believed against true), heading_error_rad, speed_m_s.
    """

    def __init__(self, file: Any) -> None:
        self._arrays = np.load(file)

    @property
    def meta(self) -> dict[str, Any]:
        """Scenario, cell, seed, trial, outcome, detail, record_hash, provenance."""
        return dict(json.loads(str(self._arrays["meta"])))

    def __getitem__(self, name: str) -> Any:
        return _value(self._arrays, name)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except UnknownName as error:
            raise AttributeError(str(error)) from None

    def __repr__(self) -> str:
        moments, events = self["time_s"], self["event_time_s"]
        return f"<Trace: {len(moments)} moments of {moments[-1] if len(moments) else 0.0:.0f} s, {len(events)} events>"

    def __iter__(self) -> Any:
        return iter([*self._arrays.files, *DERIVED])

    def __len__(self) -> int:
        return len(self._arrays.files) + len(DERIVED)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self]

    @property
    def events(self) -> "pandas.DataFrame":
        """What happened: time_s, true x_m, y_m, heading_rad, kind, detail."""
        pandas = need("pandas", "python3-pandas", "Trace.events")
        pose = self["event_pose"].reshape(-1, 3)
        return pandas.DataFrame({"time_s": self["event_time_s"], "x_m": pose[:, 0], "y_m": pose[:, 1],
                                 "heading_rad": pose[:, 2], "kind": self["event_kind"], "detail": self["event_detail"]})

    @property
    def hazards(self) -> "pandas.DataFrame":
        """The scans of the light stripe that saw a hazard, by number: time_s, true x_m, y_m, heading_rad, a flag each stripe."""
        pandas = need("pandas", "python3-pandas", "Trace.hazards")
        flags, pose = self["scan_hazards"], self["scan_pose"].reshape(-1, 3)
        frame = pandas.DataFrame({"time_s": self["scan_time_s"], "x_m": pose[:, 0], "y_m": pose[:, 1], "heading_rad": pose[:, 2]},
                                 index=pandas.RangeIndex(len(pose), name="scan"))
        for stripe in range(flags.shape[1] if flags.ndim == 2 else 0):
            frame[f"stripe_{stripe}"] = flags[:, stripe]
        return frame[flags.any(axis=1)] if flags.size else frame.iloc[:0]

    def pose_at(self, time_s: float) -> tuple[float, float, float]:
        """Returns the true x, y, heading of the last moment that is not after time_s."""
        at = max(int(np.searchsorted(self["time_s"], time_s, side="right")) - 1, 0)
        x, y, _ = self["position_m"][at]
        return float(x), float(y), float(self["heading_rad"][at])

    def scan_at(self, number: int) -> dict[str, Any]:
        """Returns a scan of the light stripe: time_s, true pose (x, y, heading), points (n x 3, in W through the
        true pose), stripe of each, height_m of each as believed, hazards by stripe of this scan alone."""
        points = self["scan_points"]
        own = points[points[:, 0] == number]
        return {"time_s": float(self["scan_time_s"][number]), "pose": self["scan_pose"][number], "points": own[:, 1:4],
                "stripe": own[:, 4].astype(int), "height_m": own[:, 5], "hazards": self["scan_hazards"][number]}

    def map_at(self, step: int) -> dict[str, Any]:
        """Returns the map of a map-based navigator at a step: x_m and y_m of the cells (believed world),
        elevation_m, goodness, certainty (ny x nx; NaN, -1, -1 where unknown)."""
        x0, y0, dx, dy = self["map_grid"][step]
        shown = {name: self[f"map_{name}"][step] for name in ("elevation_m", "goodness", "certainty")}
        ny, nx = shown["elevation_m"].shape
        return {"x_m": x0 + dx * (np.arange(nx) + 0.5), "y_m": y0 + dy * (np.arange(ny) + 0.5), **shown}

    def tum(self, path: "str | PathLike[str]", believed: bool = False) -> None:
        """Writes a new file with a line a moment: time, x, y, z, then the unit quaternion x, y, z, w."""
        rows = np.empty((len(self["time_s"]), 8))
        rows[:, 0] = self["time_s"]
        if believed:
            pose = self["believed"]
            rows[:, 1:3], rows[:, 3:6] = pose[:, :2], 0.0
            rows[:, 6], rows[:, 7] = np.sin(pose[:, 2] / 2), np.cos(pose[:, 2] / 2)
        else:
            rows[:, 1:4], rows[:, 4:7], rows[:, 7] = self["position_m"], self["attitude_wxyz"][:, 1:], self["attitude_wxyz"][:, 0]
        kept = np.concatenate([np.diff(rows[:, 0]) > 0, [True]])  # evo wants rising times
        with Path(path).open("x", encoding="ascii") as file:
            np.savetxt(file, rows[kept], fmt="%.17g")
