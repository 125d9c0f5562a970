"""Single edits of a formula, a sign, a limit or a number in a source text."""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Iterator
from dataclasses import dataclass

SWAPS = {"maximum": "minimum", "minimum": "maximum", "max": "min", "min": "max", "sin": "cos", "cos": "sin"}
SWAPS |= {"sinh": "cosh", "cosh": "sinh", "floor": "ceil", "ceil": "floor", "any": "all", "all": "any"}
SIGNS = {ast.Add: ("+", "-"), ast.Sub: ("-", "+"), ast.Mult: ("*", "/"), ast.Div: ("/", "*")}
LIMITS = {ast.Lt: ("<", ">="), ast.LtE: ("<=", ">"), ast.Gt: (">", "<="), ast.GtE: (">=", "<")}
LIMITS |= {ast.Eq: ("==", "!="), ast.NotEq: ("!=", "==")}


@dataclass(frozen=True)
class Edit:
    """One mutation: the bytes of the file from `start` to `end` become `new`."""

    file: str
    function: str
    line: int
    kind: str
    start: int
    end: int
    old: str
    new: str
    before: str
    after: str

    @property
    def name(self) -> str:
        """A name that lasts while the line and its function do: a digest of place and edit."""
        return hashlib.sha256("\n".join((self.file, self.function, self.before, self.after)).encode()).hexdigest()[:12]

    def applied(self, source: bytes) -> bytes:
        """The mutated source."""
        return source[: self.start] + self.new.encode() + source[self.end :]


@dataclass(frozen=True)
class _Source:
    """A file with the byte at which each line begins."""

    file: str
    text: bytes
    begins: tuple[int, ...]

    def at(self, line: int, column: int) -> int:
        return self.begins[line - 1] + column

    def edit(self, function: str, line: int, kind: str, start: int, end: int, new: str) -> Edit:
        shown = self.text[self.begins[line - 1] : self.begins[line]]
        place = start - self.begins[line - 1]
        mutated = shown[:place] + new.encode() + shown[place + end - start :]
        return Edit(
            self.file,
            function,
            line,
            kind,
            start,
            end,
            self.text[start:end].decode(),
            new,
            shown.decode().strip(),
            mutated.decode().strip(),
        )


def edits(file: str, text: bytes) -> list[Edit]:
    """Every edit of a file's lines, whether or not the edited text is a program (`is_program`)."""
    begins = [0]
    for line in text.splitlines(keepends=True):
        begins.append(begins[-1] + len(line))
    source = _Source(file, text, tuple(begins))
    tree = ast.parse(text)
    found = [edit for node, function in _expressions(tree, "module") for edit in _of(node, function, source)]
    return [edit for edit in found if "\n" not in edit.old]


def is_program(edit: Edit, text: bytes) -> bool:
    """Whether the edited text parses, and differs in more than its form."""
    try:
        return ast.dump(ast.parse(edit.applied(text))) != ast.dump(ast.parse(text))
    except SyntaxError:
        return False


def _expressions(node: ast.AST, function: str) -> Iterator[tuple[ast.expr | ast.AugAssign, str]]:
    """Expressions that compute; not annotations, decorators, messages, defaults or exceptions."""
    for field, value in ast.iter_fields(node):
        if field in ("annotation", "returns", "decorator_list", "type_params", "args") and not isinstance(
            node, ast.Call
        ):
            continue
        for child in value if isinstance(value, list) else [value]:
            if not isinstance(child, ast.AST) or isinstance(child, (ast.Raise, ast.JoinedStr, ast.Assert)):
                continue
            inner = child.name if isinstance(child, (ast.FunctionDef, ast.ClassDef)) else function
            if isinstance(child, (ast.expr, ast.AugAssign)):
                yield child, inner
            yield from _expressions(child, inner)


def _of(node: ast.expr | ast.AugAssign, function: str, source: _Source) -> Iterator[Edit]:
    match node:
        case ast.BinOp(left=left, op=op, right=right) if type(op) in SIGNS:
            yield from _between(left, right, SIGNS[type(op)], "sign" if _adds(op) else "factor", function, source)
            yield from _dropped(node, function, source)
        case ast.BinOp(op=ast.Pow(), right=ast.Constant(value=int(power)) as right):
            yield _replaced(right, str(power + 1), "power", function, source)
        case ast.AugAssign(target=left, op=op, value=right) if type(op) in SIGNS:
            yield from _between(left, right, SIGNS[type(op)], "sign" if _adds(op) else "factor", function, source)
        case ast.UnaryOp(op=ast.USub() | ast.Not(), operand=operand) if not isinstance(operand, ast.Constant):
            start, end = source.at(node.lineno, node.col_offset), source.at(operand.lineno, operand.col_offset)
            yield source.edit(function, node.lineno, "sign", start, end, "")
        case ast.Compare(left=left, ops=[op], comparators=[right]) if type(op) in LIMITS:
            yield from _between(left, right, LIMITS[type(op)], "limit", function, source)
        case ast.BoolOp(op=op, values=[left, right, *_]):
            signs = ("and", "or") if isinstance(op, ast.And) else ("or", "and")
            yield from _between(left, right, signs, "limit", function, source)
        case ast.Call(func=ast.Attribute(attr=name) | ast.Name(id=name)) if name in SWAPS:
            end = source.at(node.func.end_lineno or 0, node.func.end_col_offset or 0)
            yield source.edit(function, node.lineno, "function", end - len(name), end, SWAPS[name])
        case ast.Constant(value=float(number)) if number not in (0.0,):
            yield _replaced(node, repr(2.0 * number), "number", function, source)
        case _:
            return


def _adds(op: ast.operator) -> bool:
    return isinstance(op, (ast.Add, ast.Sub))


def _replaced(node: ast.expr, new: str, kind: str, function: str, source: _Source) -> Edit:
    start = source.at(node.lineno, node.col_offset)
    end = source.at(node.end_lineno or 0, node.end_col_offset or 0)
    return source.edit(function, node.lineno, kind, start, end, new)


def _between(
    left: ast.expr, right: ast.expr, signs: tuple[str, str], kind: str, function: str, source: _Source
) -> Iterator[Edit]:
    """The sign between two operands replaced."""
    start = source.at(left.end_lineno or 0, left.end_col_offset or 0)
    place = source.text.find(signs[0].encode(), start, source.at(right.lineno, right.col_offset))
    if place >= 0 and left.end_lineno == right.lineno:
        yield source.edit(function, right.lineno, kind, place, place + len(signs[0]), signs[1])


def _dropped(node: ast.BinOp, function: str, source: _Source) -> Iterator[Edit]:
    """The second operand of a sum or product left out."""
    start = source.at(node.left.end_lineno or 0, node.left.end_col_offset or 0)
    end = source.at(node.end_lineno or 0, node.end_col_offset or 0)
    if node.lineno == node.end_lineno and source.text[start:end].count(b"(") == source.text[start:end].count(b")"):
        kind = "term left out" if _adds(node.op) else "factor left out"
        yield source.edit(function, node.lineno, kind, start, end, "")
