"""The type stubs name what the module has."""

import ast
import importlib.util
import pathlib

from conftest import SOURCE

import edgescout

STUB = pathlib.Path(edgescout.__file__).with_name("_core.pyi").read_text()


def public(names):
    return {name for name in names if not name.startswith("_")}


def test_the_stubs_name_what_the_module_has():
    stub = ast.parse(STUB)
    classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
    functions = {node.name for node in stub.body if isinstance(node, ast.FunctionDef)}
    module = edgescout._core
    assert classes.keys() | functions == public(vars(module))
    for name, node in classes.items():
        listed = {member.name for member in node.body if isinstance(member, ast.FunctionDef)}
        listed |= {member.target.id for member in node.body if isinstance(member, ast.AnnAssign)}
        assert public(listed) == public(vars(getattr(module, name))), name


def test_the_stubs_give_each_option_its_type():
    spec = importlib.util.spec_from_file_location("option_stubs", SOURCE / "scripts/option_stubs.py")
    option_stubs = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(option_stubs)
    assert "    coarse_poses: int\n" in STUB
    assert option_stubs.with_option_classes(STUB) == STUB, "scripts/option_stubs.py mends it"


def test_the_package_shows_what_the_module_has():
    assert public(vars(edgescout._core)) <= public(vars(edgescout))


def explained(member):
    """Whether there is a sentence beside the signatures, which pybind11 writes."""
    lines = (member.__doc__ or "").splitlines()
    return any(line.strip() and "->" not in line for line in lines)


def test_every_member_is_explained():
    of_enums = {"name", "value"}
    for name in public(vars(edgescout._core)):
        of_module = getattr(edgescout, name)
        assert explained(of_module), name
        if not isinstance(of_module, type) or issubclass(of_module, Exception):
            continue
        is_enum = hasattr(of_module, "__members__")
        for member, value in vars(of_module).items():
            if not member.startswith("_") and not (is_enum and member in of_enums):
                assert explained(value), f"{name}.{member}"
    told = edgescout.detect.__doc__
    assert all(word in told for word in ("uint16", "float32", "max_seconds"))
