#!/usr/bin/env python3
"""The package edgescout_msgs says what idl/edgescout_msgs.idl says: the same fields in order."""
import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parents[2] / "host/bridge/ros2"
BASIC = {"unsigned long long": "uint64", "long long": "int64", "long": "int32", "boolean": "bool",
         "double": "float64", "string": "string", "octet": "uint8"}
HEADER = [("uint64", "guid"), ("int64", "seq")]
EMPTY = [("uint8", "structure_needs_at_least_one_member")]


def ros_type(idl):
    sequence = re.fullmatch(r"sequence<(.*)>", idl)
    if sequence:
        return ros_type(sequence[1]) + "[]"
    named = re.fullmatch(r"(?:(\w+)::msg::dds_::)?(\w+)_", idl)
    if idl in BASIC:
        return BASIC[idl]
    package = named[1] or "edgescout_msgs"
    return named[2] if package == "edgescout_msgs" else f"{package}/{named[2]}"


def structs_of_idl():
    text = re.sub(r"//.*", "", (root / "idl/edgescout_msgs.idl").read_text())
    for name, body in re.findall(r"struct (\w+)_ \{(.*?)\};", text, re.DOTALL):
        fields = [f.strip().rsplit(" ", 1) for f in body.split(";") if f.strip()]
        yield name, [(ros_type(" ".join(kind.split())), field) for kind, field in fields]


def fields_of(text):
    lines = [re.sub(r"#.*", "", line).split() for line in text.splitlines()]
    return [tuple(words) for words in lines if words]


def structs_of_package():
    for file in (root / "edgescout_msgs/msg").glob("*.msg"):
        yield file.stem, fields_of(file.read_text())
    for file in (root / "edgescout_msgs/srv").glob("*.srv"):
        request, response = file.read_text().split("---\n")
        yield file.stem + "_Request", HEADER + (fields_of(request) or EMPTY)
        yield file.stem + "_Response", HEADER + fields_of(response)


idl, package = dict(structs_of_idl()), dict(structs_of_package())
assert len(idl) == 22, len(idl)
for name in sorted(idl.keys() | package.keys()):
    if idl.get(name) != package.get(name):
        sys.exit(f"{name}: found {idl.get(name)} in the IDL, expected {package.get(name)}")
