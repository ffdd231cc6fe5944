"""The type stubs name what the module has."""

import ast
import pathlib

import edgescout


def public(names):
    return {name for name in names if not name.startswith("_")}


def test_the_stubs_name_what_the_module_has():
    stub = ast.parse(pathlib.Path(edgescout.__file__).with_name("_core.pyi").read_text())
    classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
    functions = {node.name for node in stub.body if isinstance(node, ast.FunctionDef)}
    module = edgescout._core
    assert classes.keys() | functions == public(vars(module))
    for name, node in classes.items():
        listed = {member.name for member in node.body if isinstance(member, ast.FunctionDef)}
        listed |= {member.target.id for member in node.body if isinstance(member, ast.AnnAssign)}
        assert public(listed) == public(vars(getattr(module, name))), name
