"""Printers for gdb: show Eigen's vectors, matrices and quaternions, and Skein's ids, in one line.

Loaded by `skein run --debug UAV=gdb` and `skein attach`; by hand: (gdb) source config/gdb/skein_printers.py
"""
import os

import gdb
import gdb.printing

MOST_NUMBERS = 64  # greatest number of elements of a matrix that are shown


def number(value):
    """A number as text, with six significant digits."""
    if value.type.strip_typedefs().code == gdb.TYPE_CODE_FLT:
        return "%.6g" % float(value)
    return str(value)


class Dense:
    """Eigen::Matrix and Eigen::Array: (1, 2, 3), or rows ((1, 2), (3, 4))."""

    def __init__(self, value):
        self.value = value
        kind = value.type.strip_typedefs()
        self.scalar = kind.template_argument(0)
        sizes = [int(kind.template_argument(i)) for i in (1, 2)]
        self.row_major = int(kind.template_argument(3)) & 1
        storage = value["m_storage"]
        members = [field.name for field in storage.type.strip_typedefs().fields()]
        self.rows = int(storage["m_rows"]) if "m_rows" in members else sizes[0]
        self.cols = int(storage["m_cols"]) if "m_cols" in members else sizes[1]
        data = storage["m_data"]
        pointer = data.type.strip_typedefs().code == gdb.TYPE_CODE_PTR
        self.data = data if pointer else data["array"]  # a value that a function returned has no address

    def at(self, row, col):
        return number(self.data[row * self.cols + col if self.row_major else col * self.rows + row])

    def to_string(self):
        if self.rows * self.cols > MOST_NUMBERS:
            return "%d x %d matrix" % (self.rows, self.cols)
        if 1 in (self.rows, self.cols):
            return "(%s)" % ", ".join(self.at(r, c) for r in range(self.rows) for c in range(self.cols))
        rows = ("(%s)" % ", ".join(self.at(r, c) for c in range(self.cols)) for r in range(self.rows))
        return "(%s)" % ", ".join(rows)


class Quaternion:
    """Eigen::Quaternion, which keeps w last."""

    def __init__(self, value):
        self.coefficients = Dense(value["m_coeffs"])

    def to_string(self):
        x, y, z, w = (self.coefficients.at(i, 0) for i in range(4))
        return "w %s, xyz (%s, %s, %s)" % (w, x, y, z)


class Id:
    """skein::UavIndex and skein::Node (core/ids.hpp)."""

    def __init__(self, value):
        self.value = value
        self.tag = value.type.strip_typedefs().template_argument(0).name.split("::")[-1]

    def to_string(self):
        index = int(self.value["value_"])
        if self.tag == "NodeTag":
            return "station" if index == 0 else "node %d (UAV %d)" % (index, index - 1)
        return "UAV %d" % index


def printers():
    collection = gdb.printing.RegexpCollectionPrettyPrinter("skein")
    collection.add_printer("dense", r"^Eigen::(Matrix|Array)<", Dense)
    collection.add_printer("quaternion", r"^Eigen::Quaternion<", Quaternion)
    collection.add_printer("id", r"^skein::Id<", Id)
    return collection


def add_source_folders():
    """Tells gdb where the root of the source tree is, because debug information names source files relative to it: the
    tree that contains this file, or the folder of the package skein-source."""
    here = os.path.abspath(__file__)
    for levels, below in ((3, "."), (5, "src/skein")):
        root = here
        for _ in range(levels):
            root = os.path.dirname(root)
        root = os.path.normpath(os.path.join(root, below))
        if os.path.exists(os.path.join(root, "core", "ids.hpp")):
            gdb.execute('directory "%s"' % root, to_string=True)


gdb.printing.register_pretty_printer(None, printers(), replace=True)
add_source_folders()
