"""Results of Millstress in Python: headline figures, load histories, and stress recombined for any effects.

    import millstress
    results = millstress.load("results/vibratory_mill")
    results.figures["bodies.shaft.peak_von_mises"]     # value, error, unit
    shaft = results.body("shaft")
    stress_Pa, instant = shaft.envelope(effects=["springs", "gravity_charge"])

Everything is in SI. Needs numpy and h5py (Debian: python3-h5py). Solves nothing: stress is the sum of unit responses
times the factors of their channels, stress(x, t) = sum over k of a_k(t) S_k(x).
"""

import json
import os
from pathlib import Path
from typing import NamedTuple

import h5py
import numpy as np


class Figure(NamedTuple):
    """A headline figure; its error is None where none is stated."""

    value: float
    error: float
    unit: str


class Load(NamedTuple):
    """A quantity of the load stage over the cycle."""

    time_s: np.ndarray
    values: np.ndarray
    unit: str


def load(directory):
    """The results in a directory that `millstress run` has written."""
    return Results(Path(directory))


class Results:
    def __init__(self, directory):
        self.directory = directory
        with open(directory / "summary.json", encoding="utf-8") as file:
            self.summary = json.load(file)
        self.verdict = self.summary["verdict"]
        self.figures = dict(_figures(self.summary, ""))
        with h5py.File(directory / "loads.h5") as loads:
            self.time_s = loads["time"][()]
            self.drive_angle_rad = loads["phi"][()]
            self.effects = list(loads.get("effects", {}))
            self.loads = {name: Load(self.time_s, values[()], _text(values.attrs["unit"]))
                          for name, values in loads.get("quantities", {}).items()}

    def body(self, name):
        """A body that was solved, by harmonics around the axis or as a solid."""
        return Body(self.directory, name)


class Body:
    """Unit responses of a body and the factors of its channels.

    channels: names; nodes_m: positions, nodes x 3, in the body's frame; unit_stress_Pa: nodes x channels x 6
    (xx, yy, zz, xy, yz, xz).
    """

    def __init__(self, directory, name):
        self.name = name
        self._loads = directory / "loads.h5"
        with h5py.File(_responses(directory, name)) as responses:
            self.channels = [_text(channel) for channel in responses["channels"][()]]
            self.nodes_m = responses["nodes/xyz"][()]
            self.unit_stress_Pa = responses["stress"][()]

    def factors(self, effects=None):
        """Factors of the channels, instants x channels: of all effects, or the sum of those that are named."""
        with h5py.File(self._loads) as loads:
            if effects is None:
                parts = [loads["channels"][self.name]]
            else:
                unknown = set(effects) - set(loads["effects"])
                if unknown:
                    raise KeyError(f"no effects of these results: {sorted(unknown)}; there are {list(loads['effects'])}")
                parts = [loads["effects"][effect][self.name] for effect in effects if self.name in loads["effects"][effect]]
            n_instants = len(loads["time"])
            sums = np.zeros((n_instants, len(self.channels)))
            for part in parts:
                for k, channel in enumerate(self.channels):
                    if channel in part:
                        sums[:, k] += part[channel][()]
        return sums

    def nearest(self, position_m):
        """The node nearest to a position."""
        return int(np.argmin(np.linalg.norm(self.nodes_m - np.asarray(position_m), axis=1)))

    def stress(self, node, effects=None):
        """Stress at a node over the cycle, instants x 6."""
        return self.factors(effects) @ self.unit_stress_Pa[node]

    def envelope(self, effects=None, nodes_at_once=2000):
        """Largest von Mises stress of each node over the cycle, and the instant when it occurs."""
        factors = self.factors(effects)
        largest = np.empty(len(self.nodes_m))
        instant = np.empty(len(self.nodes_m), dtype=int)
        for begin in range(0, len(self.nodes_m), nodes_at_once):
            part = slice(begin, begin + nodes_at_once)
            unit_Pa = self.unit_stress_Pa[part].transpose(1, 0, 2)
            stress_Pa = (factors @ unit_Pa.reshape(len(unit_Pa), -1)).reshape(len(factors), -1, 6)
            history = von_mises(stress_Pa)
            instant[part] = history.argmax(axis=0)
            largest[part] = history.max(axis=0)
        return largest, instant


def von_mises(stress_Pa):
    """Von Mises stress of tensors, ... x 6."""
    xx, yy, zz, xy, yz, xz = np.moveaxis(np.asarray(stress_Pa), -1, 0)
    return np.sqrt(((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) / 2 + 3 * (xy**2 + yz**2 + xz**2))


def _responses(directory, name):
    """The file of a body's unit responses: beside the results, or in the user's cache."""
    with open(directory / "run.json", encoding="utf-8") as file:
        key = json.load(file)["responses"].get(name)
    if key is None:
        raise FileNotFoundError(f"{directory / name}: no unit responses; a beam has none")
    cache = Path(os.environ.get("XDG_CACHE_HOME", ""))
    if not cache.is_absolute():
        cache = Path.home() / ".cache"
    for file in (directory / name / "unit_responses.h5", cache / "millstress" / f"{key}.h5"):
        if file.exists():
            return file
    raise FileNotFoundError(f"{directory / name}: its unit responses are no longer in {cache / 'millstress'}; "
                            "`millstress run --fresh` computes them, keep = \"all\" in [results] keeps them here")


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def _figures(value, name):
    """Names and figures below a part of summary.json."""
    if isinstance(value, list):
        value = {str(index): item for index, item in enumerate(value)}
    if not isinstance(value, dict):
        return
    if isinstance(value.get("value"), (int, float)) and "unit" in value:
        error = value.get("error")
        yield name, Figure(value["value"], error.get("total") if isinstance(error, dict) else error, value["unit"])
    for key, item in value.items():
        yield from _figures(item, f"{name}.{key}" if name else key)
