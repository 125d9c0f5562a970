"""Lanes as vector registers: numba's typing and LLVM's vector instructions for eight numbers.

LLVM maps the vectors to the registers of the processor. `scalar_lanes` has the same operations without numba's
internals.
"""

import operator
from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.imputils import lower_builtin
from numba.core.types import containers
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, models, register_model
from numba.np import arrayobj

from reynolds.numerics.scalar_lanes import WIDTH


class Lanes(types.Type):
    """The type of eight numbers side by side."""

    def __init__(self, dtype: Any) -> None:
        self.dtype = dtype
        super().__init__(name=f"Lanes({dtype})")


@register_model(Lanes)
class _LanesModel(models.PrimitiveModel):
    def __init__(self, dmm: Any, fe_type: Lanes) -> None:
        super().__init__(dmm, fe_type, ir.VectorType(dmm.lookup(fe_type.dtype).get_value_type(), WIDTH))


def _operation(symbol: Any, build: str) -> None:
    @infer_global(symbol)
    class _Typed(AbstractTemplate):
        def generic(self, args: Any, kws: Any) -> Any:
            if len(args) == 2 and isinstance(args[0], Lanes) and args[0] == args[1]:
                return signature(args[0], *args)
            return None

    @lower_builtin(symbol, Lanes, Lanes)
    def _lowered(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return getattr(builder, build)(*args, flags=("contract",))


for _symbol, _build in (
    (operator.add, "fadd"), (operator.iadd, "fadd"), (operator.sub, "fsub"), (operator.isub, "fsub"),
    (operator.mul, "fmul"), (operator.truediv, "fdiv"),
):  # fmt: skip
    _operation(_symbol, _build)


def _pointer(context: Any, builder: Any, array_type: Any, array: Any, at: Any) -> tuple[Any, int]:
    """Pointer to the eight numbers, and the alignment of their address (bytes)."""
    value = arrayobj.make_array(array_type)(context, builder, array)
    vector = ir.VectorType(context.get_value_type(array_type.dtype), WIDTH)
    return builder.bitcast(builder.gep(value.data, [at]), vector.as_pointer()), array_type.dtype.bitwidth // 8


@intrinsic
def lanes(typing_context: Any, array: Any, at: Any) -> Any:
    """array[at : at + 8] of an array of one axis."""

    def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        pointer, align = _pointer(context, builder, sig.args[0], *args)
        return builder.load(pointer, align=align)

    return Lanes(array.dtype)(array, types.intp), generate


@intrinsic
def put_lanes(typing_context: Any, array: Any, at: Any, value: Any) -> Any:
    """array[at : at + 8] = value, in the array's precision."""

    def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        pointer, align = _pointer(context, builder, sig.args[0], *args[:2])
        builder.store(_as(builder, sig.args[2].dtype, sig.args[0].dtype, args[2]), pointer, align=align)
        return context.get_dummy_value()

    return types.void(array, types.intp, value), generate


def _as(builder: Any, given: Any, wanted: Any, value: Any) -> Any:
    vector = ir.VectorType(ir.FloatType() if wanted.bitwidth == 32 else ir.DoubleType(), WIDTH)
    if given.bitwidth == wanted.bitwidth:
        return value
    return builder.fpext(value, vector) if given.bitwidth < wanted.bitwidth else builder.fptrunc(value, vector)


@intrinsic
def lanes_like(typing_context: Any, array: Any, value: Any) -> Any:
    """Eight numbers in the precision of an array."""

    def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return _as(builder, sig.args[1].dtype, sig.args[0].dtype, args[1])

    return Lanes(array.dtype)(array, value), generate


@intrinsic
def all_lanes(typing_context: Any, array: Any, number: Any) -> Any:
    """Eight times the same number, in the precision of an array."""

    def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        number = context.cast(builder, args[1], sig.args[1], sig.args[0].dtype)
        empty = ir.Constant(ir.VectorType(number.type, WIDTH), ir.Undefined)
        one = builder.insert_element(empty, number, cgutils.int32_t(0))
        places = ir.Constant(ir.VectorType(cgutils.int32_t, WIDTH), [0] * WIDTH)
        return builder.shuffle_vector(one, empty, places)

    return Lanes(array.dtype)(array, number), generate


@intrinsic
def where_positive(typing_context: Any, test: Any, one: Any, other: Any) -> Any:
    """Lane by lane: one where test > 0, else other."""

    def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        zero = ir.Constant(args[0].type, [0.0] * WIDTH)
        return builder.select(builder.fcmp_ordered(">", args[0], zero), args[1], args[2])

    return one(test, one, other), generate


def _shuffled(first: tuple[int, ...], second: tuple[int, ...]) -> Any:
    def shuffled(typing_context: Any, a: Any, b: Any) -> Any:
        def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
            places = (ir.Constant(ir.VectorType(cgutils.int32_t, WIDTH), list(p)) for p in (first, second))
            return context.make_tuple(builder, sig.return_type, [builder.shuffle_vector(*args, p) for p in places])

        return containers.UniTuple(a, 2)(a, b), generate

    return shuffled


_ALL = tuple(range(2 * WIDTH))
_TOGETHER = tuple(k // 2 + (k % 2) * WIDTH for k in _ALL)

apart = intrinsic(_shuffled(_ALL[::2], _ALL[1::2]))
"""(a, b) -> their even and their odd numbers: a0 a2 .. b6 and a1 a3 .. b7."""

together = intrinsic(_shuffled(_TOGETHER[:WIDTH], _TOGETHER[WIDTH:]))
"""The mirror of `apart`: (a, b) -> a0 b0 .. a3 b3 and a4 b4 .. a7 b7."""
