"""Message definitions: Skein's IDL, converted to the types of .msg files, and those of an installed ROS 2.

    definitions.py IDL_FOLDER      compares; prints JSON: the types that are "same", "different", "missing" in ROS 2
"""
import json
import os
import re
import sys

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

PRIMITIVES = {"boolean": "bool", "octet": "uint8", "int8": "int8", "long": "int32", "unsigned long": "uint32",
              "long long": "int64", "unsigned long long": "uint64", "float": "float32", "double": "float64",
              "string": "string"}


def ros_type(package, idl):
    """ "sequence<Point_>" of geometry_msgs -> "geometry_msgs/Point[]" """
    if sequence := re.fullmatch(r"sequence<(.*)>", idl):
        return ros_type(package, sequence.group(1)) + "[]"
    if idl in PRIMITIVES:
        return PRIMITIVES[idl]
    *scope, struct = idl.removesuffix("_").split("::")
    return f"{scope[0] if scope else package}/{struct}"


def read_idl(folder):
    """{(package, name): [(type, field)]} of all IDL files."""
    structs = {}
    for file in sorted(os.listdir(folder)):
        if not file.endswith(".idl"):
            continue
        package = file[:-4]
        with open(os.path.join(folder, file), encoding="utf-8") as text:
            idl = re.sub(r"//.*", "", text.read())
        for name, body in re.findall(r"struct (\w+)_ \{(.*?)\};", idl, re.DOTALL):
            fields = []
            for line in filter(None, map(str.strip, body.split(";"))):
                kind, field, array = re.fullmatch(r"(.*\S)\s+(\w+)(\[\d+\])?", line).groups()
                fields.append((ros_type(package, kind) + (array or ""), field))
            structs[package, name] = fields
    return structs


def read_msg(package, name):
    """[(type, field)] of a message in the installed ROS 2; None when it has no such message."""
    try:
        file = os.path.join(get_package_share_directory(package), "msg", name + ".msg")
    except PackageNotFoundError:
        return None
    if not os.path.exists(file):
        return None
    fields = []
    with open(file, encoding="utf-8") as text:
        for line in (re.sub("#.*", "", line).strip() for line in text):
            if not line or "=" in line:  # a constant
                continue
            kind, field = line.split()[:2]
            element = kind.split("[")[0]
            if "/" not in kind and element not in PRIMITIVES.values():
                kind = f"{package}/{kind}"
            fields.append((kind, field))
    return fields


def main():
    found = {"same": [], "different": [], "missing": []}
    for (package, name), fields in read_idl(sys.argv[1]).items():
        installed = read_msg(package, name)
        verdict = "missing" if installed is None else "same" if installed == fields else "different"
        found[verdict].append(f"{package}/{name}")
    print(json.dumps(found))


if __name__ == "__main__":
    main()
