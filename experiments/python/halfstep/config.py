"""Configs as dicts, and what halfstep ships."""

from __future__ import annotations

import json
import math
import numbers
import os
from collections.abc import Iterable, Mapping
from typing import Any

from . import _halfstep
from .errors import InputError

__all__ = ["configs", "load_config", "methods", "planners", "robots", "scenes", "solvers"]


def robots() -> dict[str, str]:
    """The shipped robots: name to path of the robot file."""
    return _halfstep.robots()


def scenes() -> dict[str, str]:
    """The shipped scenes: name to path of the scene file."""
    return _halfstep.scenes()


def configs() -> dict[str, str]:
    """The shipped configs: name to path."""
    return _halfstep.configs()


def methods() -> dict[str, str]:
    """All methods of smoothing, those that you registered included: name to one line on it."""
    return _halfstep.methods()


def solvers() -> dict[str, str]:
    """All solvers: name to why it is not in this build, "" when it is."""
    return _halfstep.solvers()


def planners() -> list[str]:
    """The names of all planners of footsteps."""
    return _halfstep.planners()


def load_config(config: str | os.PathLike, **overrides: Any) -> dict[str, Any]:
    """Reads a config file, or a shipped config by its name, into a dict that has every key.

    Keyword arguments change keys before the file is checked; levels are separated by two
    underscores::

        hs.load_config("bar_8cm", smoothing__optimizer__heights=True, half_step__duration_s=1.5)

    Paths in the dict are absolute, so it holds in every folder. ``None`` stands for ``none``.
    Keys, units and ranges: ``halfstep explain-config``. Raises InputError.
    """
    return _halfstep.load_config(path_of_config(config),
                                 [(text("config: a key", key).replace("__", "."), to_yaml(value))
                                  for key, value in overrides.items()])


def path_of_config(config: str | os.PathLike) -> str:
    """The path of a config file or of a shipped one."""
    if not isinstance(config, (str, os.PathLike)):
        raise TypeError(f"config: {type(config).__name__} (valid: a path or a shipped config's "
                        "name)")
    return _path_or_shipped(os.fspath(config), configs())


def path_of_robot(robot: str | os.PathLike) -> str:
    """The path of a robot file or of a shipped one."""
    return _path_or_shipped(os.fspath(robot), robots(), "robot")


def path_of_scene(scene: str | os.PathLike) -> str:
    """The path of a scene file or of a shipped one."""
    return _path_or_shipped(os.fspath(scene), scenes(), "scene")


def _path_or_shipped(name: str, shipped: Mapping[str, str], what: str = "config") -> str:
    if not isinstance(name, str):
        raise TypeError(f"{what}: {type(name).__name__} (valid: text)")
    text(what, name)
    if name in shipped and not os.path.exists(name):
        return shipped[name]
    if os.sep not in name and not name.endswith((".yaml", ".yml")) and not os.path.exists(name):
        raise InputError(f"no {what} {name!r} (valid: a path, or one of {', '.join(shipped)})")
    return name


def text(what: str, value: str) -> str:
    """Text that UTF-8 can hold, or an InputError: halves of surrogate pairs cannot be written."""
    try:
        value.encode()
    except UnicodeEncodeError as error:
        raise InputError(f"{what}: character {error.start + 1} is half of a surrogate pair (valid: "
                         "text that UTF-8 can hold)") from None
    return value


def to_yaml(value: Any) -> str:
    """A value as YAML in one line. ``None`` is ``none``."""
    if value is None:
        return "none"
    if isinstance(value, str):
        return "none" if value == "none" else json.dumps(text("config", value),
                                                         ensure_ascii=False)
    if isinstance(value, bool) or type(value).__name__ == "bool_":
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        number = float(value)
        return repr(number) if math.isfinite(number) else ".nan"  # is refused with its key
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(k)}: {to_yaml(v)}" for k, v in value.items()) + "}"
    if isinstance(value, os.PathLike):
        return to_yaml(os.fspath(value))
    if isinstance(value, Iterable):
        return "[" + ", ".join(to_yaml(item) for item in value) + "]"
    raise TypeError(f"a config has no value of type {type(value).__name__} (valid: numbers, text, "
                    "True, False, None, lists and dicts of these)")


def to_document(config: Mapping[str, Any]) -> str:
    """A dict as a YAML document with a line for each key of the first two levels, so that
    complaints name lines that one finds."""
    if not config:
        return "{}\n"
    lines = []
    for key, value in config.items():
        if isinstance(value, Mapping) and value:
            lines.append(f"{_key(key)}:")
            lines += [f"  {_key(k)}: {to_yaml(v)}" for k, v in value.items()]
        else:
            lines.append(f"{_key(key)}: {to_yaml(value)}")
    return "\n".join(lines) + "\n"


def _key(key: Any) -> str:
    if not isinstance(key, str):
        raise TypeError(f"a key of a config is {type(key).__name__} (valid: text)")
    text("config: a key", key)
    return key if key.replace("_", "").isalnum() and key.isascii() else json.dumps(key)
