#!/usr/bin/env python3
"""Writes the messages of the ROS 2 package skein_msgs from Skein's IDL, one file per message.

    generate_messages.py [--check]        --check: writes nothing; exit code 1 if a file is not as it would be written

idl/skein_msgs.idl is the only source; the files in skein_msgs/msg are checked in, so that a workspace with ROS 2 alone
builds the package. tests/ros2 checks that they are current.
"""
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
IDL = os.path.join(HERE, "..", "idl", "skein_msgs.idl")
FOLDER = os.path.join(HERE, "skein_msgs", "msg")
PACKAGE = "skein_msgs"
PRIMITIVES = {"boolean": "bool", "octet": "uint8", "long": "int32", "unsigned long": "uint32",
              "long long": "int64", "unsigned long long": "uint64", "float": "float32", "double": "float64",
              "string": "string"}


def ros_type(idl):
    """ "sequence<geometry_msgs::msg::dds_::Point_>" -> "geometry_msgs/Point[]" """
    if sequence := re.fullmatch(r"sequence<(.*)>", idl):
        return ros_type(sequence.group(1)) + "[]"
    if idl in PRIMITIVES:
        return PRIMITIVES[idl]
    *scope, struct = idl.removesuffix("_").split("::")
    return f"{scope[0]}/{struct}" if scope else struct


def field_line(line):
    """ "  string name;   // why" -> "string name   # why" """
    code, _, comment = line.partition("//")
    kind, name, array = re.fullmatch(r"(.*\S)\s+(\w+)(\[\d+\])?;", code.strip()).groups()
    text = f"{ros_type(kind)}{array or ''} {name}"
    return f"{text:<40}# {comment.strip()}" if comment else text


def messages(text):
    """{name: .msg text} of the IDL's structs, with the comments immediately before a struct and within it."""
    result, comment, fields, name = {}, [], None, None
    for line in text.splitlines():
        bare = line.strip()
        if fields is not None:
            if bare == "};":
                result[name] = "\n".join(comment + fields) + "\n"
                comment, fields = [], None
            elif bare.startswith("//"):
                fields.append(f"{'':<40}# {bare[2:].strip()}")
            elif bare:
                fields.append(field_line(bare))
        elif struct := re.fullmatch(r"@final struct (\w+)_ \{", bare):
            name, fields = struct.group(1), []
        elif bare.startswith("// ----") or not bare.startswith("//"):
            comment = []
        else:
            comment.append("#" + bare[2:])
    return result


def main():
    check = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not check:
        sys.exit(__doc__)
    with open(IDL, encoding="utf-8") as idl:
        wanted = {f"{name}.msg": text for name, text in messages(idl.read()).items()}
    stale = sorted(set(os.listdir(FOLDER)) - set(wanted))
    for file, text in wanted.items():
        path = os.path.join(FOLDER, file)
        if os.path.exists(path):
            with open(path, encoding="utf-8") as before:
                if before.read() == text:
                    continue
        stale.append(file)
        if not check:
            with open(path, "w", encoding="utf-8") as out:
                out.write(text)
    for file in set(stale) - set(wanted):
        if not check:
            os.remove(os.path.join(FOLDER, file))
    if check and stale:
        sys.exit("not as idl/skein_msgs.idl has them; run ros2/generate_messages.py: " + ", ".join(stale))


if __name__ == "__main__":
    main()
