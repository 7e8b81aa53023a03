"""Builds ROS 2 message packages that an installed ROS 2 lacks, from Skein's own IDL.

    message_packages.py IDL_FOLDER PREFIX PACKAGE...    installs into PREFIX

A type of another package that this ROS 2 lacks too (sensor_msgs/CompressedImage) goes into the package that needs it:
the bytes on the wire are the same.
"""
import os
import subprocess
import sys

from definitions import PRIMITIVES, read_idl, read_msg


class Package:
    def __init__(self, name, structs):
        self.name, self.structs = name, structs
        self.messages, self.uses = {}, set()
        for package, struct in structs:
            if package == name:
                self.add(package, struct)

    def add(self, package, struct):
        if struct in self.messages:
            return
        self.messages[struct] = ""
        lines = [f"{self.type_here(kind)} {field}\n" for kind, field in self.structs[package, struct]]
        self.messages[struct] = "".join(lines)

    def type_here(self, kind):
        element = kind.split("[")[0]
        if element in PRIMITIVES.values():
            return kind
        package, struct = element.split("/")
        if package != self.name and read_msg(package, struct) is not None:
            self.uses.add(package)
            return kind
        self.add(package, struct)
        return kind.split("/")[1]

    def write(self, folder):
        os.makedirs(os.path.join(folder, "msg"), exist_ok=True)
        for struct, text in self.messages.items():
            write(os.path.join(folder, "msg", struct + ".msg"), text)
        uses = sorted(self.uses)
        messages = " ".join(f'"msg/{struct}.msg"' for struct in self.messages)
        write(os.path.join(folder, "CMakeLists.txt"), "\n".join(
            ["cmake_minimum_required(VERSION 3.8)", f"project({self.name})", "find_package(ament_cmake REQUIRED)",
             "find_package(rosidl_default_generators REQUIRED)"] + [f"find_package({p} REQUIRED)" for p in uses] +
            [f"rosidl_generate_interfaces(${{PROJECT_NAME}} {messages} DEPENDENCIES {' '.join(uses)})",
             # Each of its sources specialises a template that another source may have instantiated before.
             "set_target_properties(${PROJECT_NAME}__rosidl_typesupport_introspection_cpp PROPERTIES UNITY_BUILD OFF)",
             "ament_package()", ""]))
        depends = "".join(f"<depend>{package}</depend>" for package in uses)
        write(os.path.join(folder, "package.xml"),
              f'<package format="3"><name>{self.name}</name><version>0.0.0</version><description>test</description>'
              '<maintainer email="nobody@example.com">nobody</maintainer><license>Apache-2.0</license>'
              f"<buildtool_depend>ament_cmake</buildtool_depend>{depends}"
              "<member_of_group>rosidl_interface_packages</member_of_group></package>\n")


def write(file, text):
    """Writes a file unless it has this content already, so that what was built from it stays up to date."""
    if os.path.exists(file):
        with open(file, encoding="utf-8") as before:
            if before.read() == text:
                return
    with open(file, "w", encoding="utf-8") as out:
        out.write(text)


def main():
    idl, prefix, *names = sys.argv[1:]
    structs = read_idl(idl)
    for name in names:
        source, build = os.path.join(prefix, "src", name), os.path.join(prefix, "build", name)
        Package(name, structs).write(source)
        # As one unit, generated code has warnings, which the flags of Skein's own build may forbid.
        for command in (["cmake", "-G", "Ninja", "-S", source, "-B", build, f"-DCMAKE_INSTALL_PREFIX={prefix}",
                         "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=0",
                         "-DCMAKE_CXX_FLAGS="],
                        ["cmake", "--build", build, "--target", "install"]):
            subprocess.run(command, check=True)


main()
