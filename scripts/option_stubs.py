#!/usr/bin/python3
"""Writes the classes of options into the type stubs, from the attributes that the module has.

    PYTHONPATH=build/release/python scripts/option_stubs.py

A test fails where an option is missing there or has another type.
"""

import pathlib
import re
import textwrap

import edgescout

STUB = pathlib.Path(__file__).parents[1] / "host/bindings/python/edgescout/_core.pyi"
TYPES = {bool: "bool", int: "int", float: "float", str: "str", tuple: "Tuple[float, float]",
         list: "Sequence[float]"}


def stub_of(name):
    """The class of this name as text. An option's type is that of its default."""
    defaults = getattr(edgescout, name)()
    options = {option: TYPES[type(getattr(defaults, option))] for option in defaults.help()}
    arguments = ["self", "*", *(f"{option}: {type_} = ..." for option, type_ in options.items())]
    unbroken = ", ".join(argument.replace(" ", "~") for argument in arguments)
    indent = " " * 8
    wrapped = textwrap.fill(unbroken, 100, initial_indent=indent, subsequent_indent=indent,
                            break_long_words=False, break_on_hyphens=False).replace("~", " ")
    return "\n".join([f"class {name}:",
                      *(f"    {option}: {type_}" for option, type_ in options.items()),
                      "    def __init__(", wrapped, "    ) -> None: ...",
                      f"    def copy(self) -> {name}: ...",
                      "    def help(self) -> Dict[str, str]: ...", ""])


def with_option_classes(stub):
    """The text of the stubs with each class of options written anew."""
    return re.sub(r"^class (\w+Options):\n(?: .*\n)+", lambda found: stub_of(found[1]), stub,
                  flags=re.MULTILINE)


if __name__ == "__main__":
    STUB.write_text(with_option_classes(STUB.read_text()))
