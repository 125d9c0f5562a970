"""Formulas of case files: arithmetic of position, time and constants, evaluated without Python's eval.

The position is x and y, or r and phi, polar coordinates about the origin.

A formula is parsed once into a tree. Only arithmetic, comparisons, listed functions and listed names are allowed;
anything else raises an ExpressionError with its column.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np

from reynolds.numerics.arrays import Array
from system.inputs.faults import nearest_choice

_Evaluate = Callable[[Mapping[str, Array]], Array]

LONGEST = 2000  # characters
PLACE = ("x", "y", "r", "phi")
IN_TIME = (*PLACE, "t")
CONSTANTS = {"pi": math.pi}
NO_CONSTANTS: Mapping[str, float] = MappingProxyType({})
FUNCTIONS: dict[str, tuple[Callable[..., Array], int]] = {
    "sin": (np.sin, 1), "cos": (np.cos, 1), "tan": (np.tan, 1),
    "asin": (np.arcsin, 1), "acos": (np.arccos, 1), "atan": (np.arctan, 1), "atan2": (np.arctan2, 2),
    "sinh": (np.sinh, 1), "cosh": (np.cosh, 1), "tanh": (np.tanh, 1),
    "exp": (np.exp, 1), "log": (np.log, 1), "log10": (np.log10, 1), "sqrt": (np.sqrt, 1),
    "abs": (np.abs, 1), "floor": (np.floor, 1), "sign": (np.sign, 1), "hypot": (np.hypot, 2),
    "min": (np.minimum, 2), "max": (np.maximum, 2), "where": (np.where, 3),
}  # fmt: skip
_BINARY = {
    ast.Add: np.add, ast.Sub: np.subtract, ast.Mult: np.multiply, ast.Div: np.divide, ast.Pow: np.float_power,
}  # fmt: skip
_UNARY = {ast.USub: np.negative, ast.UAdd: np.positive, ast.Not: np.logical_not}
_COMPARE = {ast.Lt: np.less, ast.LtE: np.less_equal, ast.Gt: np.greater, ast.GtE: np.greater_equal}
_JOIN = {ast.And: np.logical_and, ast.Or: np.logical_or}


class ExpressionError(ValueError):
    """An invalid formula: found text and its column, expectation, nearest valid choice."""

    def __init__(self, found: str, expected: str, nearest: str = "") -> None:
        super().__init__(f"{found}; expected {expected}")
        self.found, self.expected, self.nearest = found, expected, nearest


@dataclass(frozen=True)
class Expression:
    """A checked formula of x and y or r (m) and phi (-pi .. pi), and of t (s); a call returns its value."""

    text: str
    evaluate: _Evaluate = field(repr=False, compare=False)
    constants: Mapping[str, float] = field(default_factory=dict)

    @property
    def _constants(self) -> dict[str, Array]:
        return {name: np.asarray(value) for name, value in self.constants.items()}

    def __call__(self, x: Array, y: Array, t: float = 0.0) -> Array:
        """Return the value at these positions, x and y broadcast; not finite where undefined (1/0, sqrt(-1))."""
        with np.errstate(all="ignore"):
            place = {"x": x, "y": y, "r": np.hypot(x, y), "phi": np.arctan2(y, x)}
            value = self.evaluate(place | {"t": np.asarray(t)} | self._constants)
        return np.array(np.broadcast_to(value, np.broadcast_shapes(np.shape(x), np.shape(y))), dtype=float)


def parse_expression(
    text: str, variables: Sequence[str] = PLACE, constants: Mapping[str, float] = NO_CONSTANTS
) -> Expression:
    """Return the formula of a text: numbers, variables, constants, + - * / **, < <= > >=, and or not, FUNCTIONS.

    Raises ExpressionError for a syntax error (with its column), an unknown name (with the nearest known one) and
    anything that is not arithmetic.
    """
    if len(text) > LONGEST:
        raise ExpressionError(f"{len(text)} characters", f"a formula of at most {LONGEST} characters")
    try:
        tree = ast.parse(text.strip(), mode="eval")
        _check_powers(tree, text.strip())
        _check_names(tree, variables, constants)
        formula = Expression(text.strip(), _compile(tree.body), dict(constants))
        formula(np.ones(1), np.ones(1))
    except SyntaxError as slip:
        column = f" at column {slip.offset}" if slip.offset else ""
        raise ExpressionError(f"'{text}', a syntax error{column}", f"a formula of {_listed(variables)}") from None
    except (RecursionError, MemoryError):
        raise ExpressionError("a formula nested too deep", "a simpler formula") from None
    except ValueError as reason:
        if isinstance(reason, ExpressionError):
            raise ExpressionError(f"'{text}': {reason.found}", reason.expected, reason.nearest) from None
        raise ExpressionError(f"{text!r} ({reason})", f"a formula of {_listed(variables)}") from None
    return formula


def _check_powers(tree: ast.Expression, text: str) -> None:
    """Raise ExpressionError for ^, with its column."""
    for node in ast.walk(tree):
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitXor):
            column = text.index("^", node.left.end_col_offset) + 1
            raise ExpressionError(f"^ at column {column}", "** for a power", "**")


def _check_names(tree: ast.Expression, variables: Sequence[str], constants: Iterable[str]) -> None:
    """Raise ExpressionError for a name that is not a variable, constant or function."""
    fixed = (*CONSTANTS, *constants)
    called = {id(node.func) for node in ast.walk(tree) if isinstance(node, ast.Call)}
    for node in ast.walk(tree):
        if not isinstance(node, ast.Name) or id(node) in called or node.id in (*variables, *fixed):
            continue
        if node.id in IN_TIME:
            expected = f"a formula of {_listed(variables)}" + (" (t needs a table [time])" if node.id == "t" else "")
            raise ExpressionError(f"{node.id}{_at(node)}", expected)
        known = f"{', '.join((*variables, *fixed))} and the functions {', '.join(FUNCTIONS)}"
        nearest = nearest_choice(node.id, (*FUNCTIONS, *fixed))
        raise ExpressionError(f"unknown name {node.id}{_at(node)}", known, nearest)


def _listed(names: Sequence[str]) -> str:
    if not names:
        return "the constants of [constants]"
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def _compile(node: ast.expr) -> _Evaluate:
    """Return the function that evaluates a node; raise ExpressionError for a node that is not arithmetic."""
    match node:
        case ast.Constant(value=bool()):
            pass
        case ast.Constant(value=int() | float() as number):
            return _constant(number, node)
        case ast.Name(id=name):
            return _named(name)
        case ast.BinOp(left=left, op=sign, right=right) if type(sign) in _BINARY:
            return _call(_BINARY[type(sign)], [left, right])
        case ast.UnaryOp(op=sign, operand=operand) if type(sign) in _UNARY:
            return _call(_UNARY[type(sign)], [operand])
        case ast.BoolOp(op=sign, values=values):
            parts = [_compile(value) for value in values]
            join = _JOIN[type(sign)]
            return lambda names: join.reduce(np.broadcast_arrays(*(part(names) for part in parts)))
        case ast.Compare(left=left, ops=operators, comparators=others):
            return _comparison(node, left, operators, others)
        case ast.Call(func=ast.Name(id=name), args=arguments, keywords=[]):
            return _function(name, arguments, node)
        case _:
            pass
    raise ExpressionError(
        f"'{ast.unparse(node)}'{_at(node)}, which is not arithmetic",
        f"numbers, variables, {', '.join(CONSTANTS)}, the functions {', '.join(FUNCTIONS)}, + - * / **",
    )


def _constant(number: float, node: ast.expr) -> _Evaluate:
    try:
        value = np.asarray(float(number))
    except OverflowError:
        raise ExpressionError(f"a number beyond 1e308{_at(node)}", "a number below 1e308") from None
    return lambda names: value


def _named(name: str) -> _Evaluate:
    if name in CONSTANTS:
        value = np.asarray(CONSTANTS[name])
        return lambda names: value
    return lambda names: names[name]


def _function(name: str, arguments: list[ast.expr], node: ast.expr) -> _Evaluate:
    if name not in FUNCTIONS:
        raise ExpressionError(
            f"unknown function {name}{_at(node)}", ", ".join(FUNCTIONS), nearest_choice(name, FUNCTIONS)
        )
    function, count = FUNCTIONS[name]
    if len(arguments) != count:
        raise ExpressionError(f"{len(arguments)} arguments of {name}{_at(node)}", f"{count}")
    return _call(function, arguments)


def _call(function: Callable[..., Array], arguments: list[ast.expr]) -> _Evaluate:
    parts = [_compile(argument) for argument in arguments]
    return lambda names: function(*(part(names) for part in parts))


def _comparison(node: ast.Compare, left: ast.expr, operators: list[ast.cmpop], others: list[ast.expr]) -> _Evaluate:
    """Return the function that evaluates a chain such as 0 < x <= 1: true where every comparison holds."""
    if not all(type(operator) in _COMPARE for operator in operators):
        raise ExpressionError(f"'{ast.unparse(node)}'{_at(node)}", "one of < <= > >=")
    links = [_COMPARE[type(operator)] for operator in operators]
    parts = [_compile(part) for part in (left, *others)]

    def holds(names: Mapping[str, Array]) -> Array:
        values = [part(names) for part in parts]
        held = [link(a, b) for link, a, b in zip(links, values, values[1:], strict=False)]
        return np.logical_and.reduce(np.broadcast_arrays(*held))

    return holds


def _at(node: ast.expr) -> str:
    return f" at column {node.col_offset + 1}"
