"""The families of a walk's parameters, as the compiled part has them."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, TypeVar

from . import _halfstep

__all__: list[str] = []

_Function = TypeVar("_Function", bound=Callable[..., Any])


class Family(NamedTuple):
    """A row of the table."""

    name: str
    """Of its values: "overlaps"."""
    of: str
    """What it has one of: "junction", "step" or "half_step"."""
    unit: str
    """"s"; "": a number."""
    meaning: str
    """One line."""
    key: str
    """What lets methods move it: "heights"; "": they always may, or that of another family is for both."""


FAMILIES = [Family(*row) for row in _halfstep.parameter_families()]
FLAGS = [family.key for family in FAMILIES if family.key]


def described() -> str:
    """A line for each family: name, shape, unit and meaning."""
    shapes = {"junction": "n-1", "step": "n/2", "half_step": "n"}
    return "\n".join(
        f"        {f.name} ({shapes[f.of]}){f' [{f.unit}]' if f.unit else ''}: {f.meaning}"
        for f in FAMILIES)


def describes(function: _Function) -> _Function:
    """Puts the families into a docstring, in place of "<families>"."""
    function.__doc__ = (function.__doc__ or "").replace("<families>", described().strip())
    return function


def _named(names: list[str], default: Any, kind: Any) -> list[inspect.Parameter]:
    return [inspect.Parameter(name, kind, default=default) for name in names]


def takes_values(function: _Function) -> _Function:
    """The same method, which takes values of each family, by name or in their order, and a
    docstring and signature that say so."""
    own = inspect.signature(function)
    myself = next(iter(own.parameters.values()))
    function.__signature__ = own.replace(parameters=[myself, *_named(  # type: ignore[attr-defined]
        [family.name for family in FAMILIES], None, inspect.Parameter.POSITIONAL_OR_KEYWORD)])
    return describes(function)


def takes_flags(function: _Function) -> _Function:
    """The same method, whose ``**flags`` are those of families, with a signature that says so."""
    own = inspect.signature(function)
    *before, _flags = own.parameters.values()
    function.__signature__ = own.replace(parameters=[  # type: ignore[attr-defined]
        *before, *_named(FLAGS, False, inspect.Parameter.KEYWORD_ONLY)])
    return function


def given_values(method: Callable[..., Any], values: tuple[Any, ...],
                 named: Mapping[str, Any]) -> dict[str, Any]:
    """The arguments of a bound method that ``takes_values``, by family, but for None."""
    bound = inspect.signature(method).bind(*values, **named)
    return {name: row for name, row in bound.arguments.items() if row is not None}


def all_flags(flags: Mapping[str, Any]) -> dict[str, Any]:
    """The flags of families, those that are not given False."""
    for name in flags:
        if name not in FLAGS:
            raise TypeError(f"unexpected keyword argument '{name}' (valid: {', '.join(FLAGS)})")
    return {name: flags.get(name, False) for name in FLAGS}
