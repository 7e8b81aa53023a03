"""Reads and writes messages of ROS 2 without ROS 2: fields by name, serialised as CDR, as DDS carries them.

    twist = messages.new("geometry_msgs/msg/Twist")
    twist.linear.x = 1.0
    payload = messages.encode(twist)

It knows all types of Skein's topics (docs/topics.md); `define()` adds a type from the text of its `.msg` file. Texts
are `str`, arrays of numbers are NumPy arrays, arrays of anything else are lists. Bytes that are not a message of the
type raise `DamagedError`, values that do not fit into their field `InputError`.
"""

from __future__ import annotations

import re
import struct
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ..errors import DamagedError, InputError
from ._native import native

__all__ = ["Message", "decode", "define", "encode", "new", "type_named"]

_LINE = "=" * 80
_FIELD = re.compile(r"([\w/]+)(\[(\d*)\])?\s+([a-zA-Z]\w*)$")
#: ROS types of numbers: code in `struct`, size in bytes.
_NUMBERS = {"bool": ("?", 1), "char": ("B", 1), "uint8": ("B", 1), "int8": ("b", 1), "byte": ("B", 1),
            "int16": ("h", 2), "uint16": ("H", 2), "int32": ("i", 4), "uint32": ("I", 4), "int64": ("q", 8),
            "uint64": ("Q", 8), "float32": ("f", 4), "float64": ("d", 8)}
_HEADER = 4  #: bytes of the encapsulation header
_MOST_DEPTH = 32  #: deepest nesting of messages


@dataclass(frozen=True)
class _Field:
    name: str
    kind: str          #: a key of `_NUMBERS`, "string", or a message's type
    count: int | None  #: None: a single value; 0: an array of any length; otherwise: an array of this length

    @property
    def is_number(self) -> bool:
        return self.kind in _NUMBERS


class Message:
    """Base of all messages. Each type is a class of its own, whose only attributes are its fields."""

    __slots__ = ()
    TYPE: ClassVar[str] = ""
    FIELDS: ClassVar[tuple[_Field, ...]] = ()

    def __init__(self, **values: Any) -> None:
        for field in self.FIELDS:
            setattr(self, field.name, _default(field))
        for name, value in values.items():
            setattr(self, name, value)

    def __repr__(self) -> str:
        return f"{self.TYPE}({', '.join(f'{field.name}={getattr(self, field.name)!r}' for field in self.FIELDS)})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Message) and other.TYPE == self.TYPE and encode(self) == encode(other)

    __hash__ = None  # type: ignore[assignment]

    def __getattr__(self, name: str) -> Any:
        """Called for an unknown field. Raises AttributeError with the names of the fields."""
        raise AttributeError(f"{self.TYPE} has no field '{name}'; it has "
                             + ", ".join(field.name for field in self.FIELDS))

    def __setattr__(self, name: str, value: Any) -> None:
        try:
            object.__setattr__(self, name, value)
        except AttributeError:
            self.__getattr__(name)


_types: dict[str, type[Message]] = {}


def type_named(name: str) -> type[Message]:
    """The class of a type like "std_msgs/msg/String". Raises InputError if the type is unknown."""
    if not isinstance(name, str):
        raise InputError(f"the type of a message is a text like 'std_msgs/msg/String', not {name!r:.80}")
    if name not in _types:
        try:
            text = native.definition(name)
        except (KeyError, TypeError):  # TypeError: a text that is not UTF-8
            raise InputError(f"the message type '{name}' is not known; skein.client.messages.define() makes it so"
                             ) from None
        except native.WrongInput as error:
            raise InputError(str(error)) from None
        define(name, text)
    return _types[name]


def define(name: str, text: str) -> type[Message]:
    """Defines a type by the text of its `.msg` file. The types that it contains may follow, each after a line of 80 '='
    and a line "MSG: package/Type", as in `ros2 interface` and recordings. Constants and default values, which are not
    part of a message's bytes, are not supported. Raises InputError."""
    if not isinstance(text, str):
        raise InputError(f"the definition of a message is the text of its .msg file, not {text!r:.80}")
    if not isinstance(name, str) or not re.fullmatch(r"[a-zA-Z]\w*/msg/[a-zA-Z]\w*", name):
        raise InputError(f"'{name}' is not a message type; write it like 'std_msgs/msg/String'")
    first, *parts = (part.strip("\n") for part in text.split(_LINE + "\n"))
    for part in reversed(parts):
        head, _, fields = part.partition("\n")
        if not head.startswith("MSG: "):
            raise InputError(f"{name}: 'MSG: package/Type' must follow a line of '=', not {head!r}")
        _add(_full(head.removeprefix("MSG: ").strip(), name), fields)
    return _add(name, first)


def _full(kind: str, of: str) -> str:
    """Full name of a type that the type `of` calls "geometry_msgs/Point", or "Point" if it is of the same package."""
    names = kind.split("/")
    return f"{names[0] if len(names) > 1 else of.split('/')[0]}/msg/{names[-1]}"


def _add(name: str, text: str) -> type[Message]:
    fields = []
    for number, line in enumerate(text.splitlines(), 1):
        line = line.split("#")[0].strip()
        if not line:
            continue
        match = _FIELD.match(line)
        if match is None:
            raise InputError(f"{name}, line {number}: '{line}' is not a field like 'float64 x' or 'float64[3] p'")
        kind, many, count, field = match.groups()
        if count and int(count) == 0:
            raise InputError(f"{name}, line {number}: '{line}' is an array without elements")
        if kind not in _NUMBERS and kind != "string":
            kind = _full(kind, name)
        fields.append(_Field(field, kind, None if many is None else int(count or 0)))
    if not fields or len({field.name for field in fields}) < len(fields):
        raise InputError(f"{name}: has " + ("a field twice" if fields else "no fields"))
    body = {"__slots__": tuple(field.name for field in fields), "TYPE": name, "FIELDS": tuple(fields)}
    known = _types.get(name)
    if known is not None:
        if known.FIELDS != tuple(fields):
            raise InputError(f"{name} is known already, with other fields: "
                             + ", ".join(field.name for field in known.FIELDS))
        return known
    if name in _always_inside(fields):
        raise InputError(f"{name}: contains itself, without an end")
    _types[name] = type(name.split("/")[-1], (Message,), body)
    return _types[name]


def _always_inside(fields: list[_Field]) -> set[str]:
    """The known types of which these fields contain messages at any depth, except in arrays that may be empty."""
    found: set[str] = set()
    left = list(fields)
    while left:
        field = left.pop()
        if field.count != 0 and field.kind not in found:
            found.add(field.kind)
            left += _types[field.kind].FIELDS if field.kind in _types else ()
    return found


def new(type_name: str, **values: Any) -> Message:
    """A message with the given values; all other fields are zero or empty."""
    return type_named(type_name)(**values)


def _default(field: _Field) -> Any:
    if field.count is None:
        return 0 if field.is_number else "" if field.kind == "string" else type_named(field.kind)()
    if field.is_number:
        return np.zeros(field.count, _NUMBERS[field.kind][0])
    return [_default(_Field(field.name, field.kind, None)) for _ in range(field.count)]


# ---- from bytes --------------------------------------------------------------------------------------------------


class _Reader:
    """Reads an untrusted payload. Raises DamagedError if it is too short or malformed."""

    def __init__(self, payload: bytes) -> None:
        if len(payload) < _HEADER or payload[0] != 0 or payload[1] not in (0, 1):
            raise DamagedError("no CDR: it must begin with 00 00 or 00 01")
        self.data, self.at = memoryview(payload)[_HEADER:], 0
        self.order = "<" if payload[1] == 1 else ">"

    def take(self, size: int, align: int) -> int:
        """Skips padding and a value of `size` bytes. Returns where the value begins."""
        begin = self.at + -self.at % align
        if begin + size > len(self.data):
            raise DamagedError(f"it ends after {len(self.data)} bytes, in the middle of a field")
        self.at = begin + size
        return begin

    def number(self, kind: str) -> Any:
        code, size = _NUMBERS[kind]
        return struct.unpack_from(self.order + code, self.data, self.take(size, size))[0]

    def numbers(self, kind: str, count: int) -> Any:
        code, size = _NUMBERS[kind]
        begin = self.take(count * size, size if count else 1)
        return np.frombuffer(self.data, self.order + code, count, begin).astype(code)

    def text(self) -> str:
        size = self.number("uint32")
        begin = self.take(size, 1)
        raw = bytes(self.data[begin:begin + size])
        if not raw.endswith(b"\0"):
            raise DamagedError("a text in it does not end")
        return raw[:-1].decode("utf-8", "surrogateescape")

    def value(self, field: _Field, depth: int) -> Any:
        if field.is_number:
            return self.number(field.kind)
        return self.text() if field.kind == "string" else self.message(type_named(field.kind), depth + 1)

    def message(self, of: type[Message], depth: int = 0) -> Message:
        if depth > _MOST_DEPTH:
            raise DamagedError("messages in messages without an end")
        message = of.__new__(of)
        for field in of.FIELDS:
            if field.count is None:
                value = self.value(field, depth)
            else:
                count = field.count or self.number("uint32")
                if count > len(self.data):  # each element takes at least one byte
                    raise DamagedError(f"it says that {count} {field.name} follow, and ends before")
                value = (self.numbers(field.kind, count) if field.is_number
                         else [self.value(field, depth) for _ in range(count)])
            object.__setattr__(message, field.name, value)
        return message


def decode(type_name: str, payload: bytes) -> Message:
    """Deserialises a message of this type from bytes with an encapsulation header. Raises DamagedError."""
    of = type_named(type_name)
    if not isinstance(payload, (bytes, bytearray, memoryview)):
        raise InputError(f"payload: must be bytes, not {payload!r:.80}")
    try:
        return _Reader(payload).message(of)
    except DamagedError as error:
        raise DamagedError(f"{len(payload)} bytes that are not {type_name}: {error}") from None


# ---- to bytes ----------------------------------------------------------------------------------------------------


class _Writer:
    def __init__(self) -> None:
        self.data = bytearray()

    def align(self, size: int) -> None:
        self.data += bytes(-len(self.data) % size)

    def number(self, kind: str, value: Any, place: str) -> None:
        code, size = _NUMBERS[kind]
        try:
            if kind == "bool" and not isinstance(value, (bool, np.bool_)):
                raise TypeError
            packed = struct.pack("<" + code, value if code in "fd?" else value.__index__())
        except (struct.error, TypeError, AttributeError, OverflowError, ValueError):
            raise InputError(f"{place}: must be a {kind}, not {value!r}") from None
        self.align(size)
        self.data += packed

    def numbers(self, kind: str, values: Any, place: str) -> None:
        code, size = _NUMBERS[kind]
        try:
            array = np.frombuffer(values, np.uint8) if isinstance(values, (bytes, bytearray)) else np.asarray(values)
            if array.ndim != 1 or (array.size and array.dtype.kind not in "biuf"):
                raise ValueError
            if code not in "fd" and array.dtype.kind == "f" and array.size:
                raise ValueError
            cast = array.astype(code)
            if code not in "fd" and not np.array_equal(cast, array):
                raise ValueError
        except (TypeError, ValueError, OverflowError):
            raise InputError(f"{place}: must be a list of {kind}, not {_short(values)}") from None
        if array.size:
            self.align(size)
        self.data += cast.astype("<" + code).tobytes()

    def text(self, value: Any, place: str) -> None:
        if not isinstance(value, str) or "\0" in value:
            raise InputError(f"{place}: must be a text without NUL, not {_short(value)}")
        raw = value.encode("utf-8", "surrogateescape") + b"\0"
        self.number("uint32", len(raw), place)
        self.data += raw

    def value(self, field: _Field, value: Any, place: str) -> None:
        if field.is_number:
            self.number(field.kind, value, place)
        elif field.kind == "string":
            self.text(value, place)
        elif isinstance(value, Message) and field.kind == value.TYPE:
            self.message(value, place)
        else:
            raise InputError(f"{place}: must be a {field.kind}, not {_short(value)}")

    def message(self, message: Message, place: str) -> None:
        for field in message.FIELDS:
            value, here = getattr(message, field.name), f"{place}.{field.name}"
            if field.count is None:
                self.value(field, value, here)
                continue
            if isinstance(value, (str, Message)) or not hasattr(value, "__len__"):
                raise InputError(f"{here}: must be a list, not {_short(value)}")
            if field.count and len(value) != field.count:
                raise InputError(f"{here}: must have {field.count} elements, not {len(value)}")
            if not field.count:
                self.number("uint32", len(value), here)
            if field.is_number:
                self.numbers(field.kind, value, here)
                continue
            for i, one in enumerate(value):
                self.value(field, one, f"{here}[{i}]")


def _short(value: Any) -> str:
    text = repr(value)
    return text if len(text) < 60 else text[:57] + "..."


def encode(message: Message) -> bytes:
    """Serialises a message, with an encapsulation header, padded to a multiple of four bytes. Raises InputError."""
    if not isinstance(message, Message) or not message.TYPE:
        raise InputError(f"must be a message (skein.client.messages.new), not {_short(message)}")
    writer = _Writer()
    try:
        writer.message(message, message.TYPE)
    except RecursionError:
        raise InputError(f"{message.TYPE}: messages in messages without an end") from None
    writer.align(4)
    return b"\x00\x01\x00\x00" + bytes(writer.data)
