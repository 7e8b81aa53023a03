"""Random messages of all types in skein_msgs, as real ROS 2 serialises them.

    message_bytes.py write FILE COUNT     writes one JSON line per message: type on the wire, bytes in hexadecimal
    message_bytes.py read FILE COUNT      reads another program's bytes of the same messages: exit code 1 if one differs
"""
import json
import random
import sys

import skein_msgs.msg
from rclpy.serialization import deserialize_message, serialize_message
from rosidl_parser.definition import AbstractSequence, BasicType, NamespacedType
from rosidl_runtime_py.utilities import get_message

RANGES = {"uint8": (0, 2**8 - 1), "octet": (0, 255), "int32": (-2**31, 2**31 - 1), "uint32": (0, 2**32 - 1),
          "int64": (-2**63, 2**63 - 1), "uint64": (0, 2**64 - 1)}


def value_of(kind, draw):
    if isinstance(kind, AbstractSequence):
        values = [value_of(kind.value_type, draw) for _ in range(draw.randrange(4))]
        return values
    if isinstance(kind, NamespacedType):
        return message_of(get_message("/".join(kind.namespaced_name())), draw)
    if not isinstance(kind, BasicType):
        return "".join(draw.choice("abc /_9") for _ in range(draw.randrange(9)))
    if kind.typename == "boolean":
        return draw.random() < 0.5
    if kind.typename == "float":
        return draw.randrange(-2**20, 2**20) / 16.0
    if kind.typename == "double":
        return draw.uniform(-1e9, 1e9)
    return draw.randint(*RANGES[kind.typename])


def message_of(cls, draw):
    message = cls()
    for name, kind in zip(cls.__slots__, cls.SLOT_TYPES):
        setattr(message, name[1:], value_of(kind, draw))
    return message


def messages(count):
    draw = random.Random(38)
    names = sorted(name for name in dir(skein_msgs.msg) if name[0].isupper())
    for name in names:
        for _ in range(count):
            yield f"skein_msgs::msg::dds_::{name}_", message_of(getattr(skein_msgs.msg, name), draw)


def main():
    what, path, count = sys.argv[1], sys.argv[2], int(sys.argv[3])
    if what == "write":
        with open(path, "w", encoding="utf-8") as out:
            for name, message in messages(count):
                out.write(json.dumps({"type": name, "bytes": serialize_message(message).hex()}) + "\n")
        return
    with open(path, encoding="utf-8") as lines:
        for line, (name, message) in zip(lines, messages(count), strict=True):
            entry = json.loads(line)
            if entry["type"] != name or deserialize_message(bytes.fromhex(entry["bytes"]), type(message)) != message:
                sys.exit(f"{name}: {message} came back otherwise")


main()
