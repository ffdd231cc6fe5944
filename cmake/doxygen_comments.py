#!/usr/bin/python3
"""Doxygen's input filter: prints a header with its `//` comments as ones that Doxygen reads.

A comment on lines of its own describes what follows it. The first comment of a file describes the
file. A comment behind code describes that code. Lines indented by three blanks after an empty line
are an example. The number of lines stays the same, so that warnings name the right line.
"""
import re
import sys
from pathlib import Path

# Code, then a comment; no `//` within a string.
CODE_AND_COMMENT = re.compile(r"""^((?:[^"'/]|/(?!/)|"(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)*')*)//(.*)$""")
NO_CODE_TO_DESCRIBE = re.compile(r"^\s*(#|}|public:|private:|protected:)")


def escaped(text):
    """Outside of `code` nothing is a command or a tag of HTML."""
    parts = text.split("`")
    if len(parts) % 2 == 0:  # a pair of marks ends on another line
        return text.replace("@", r"\@").replace("<", r"\<")
    for i in range(0, len(parts), 2):
        parts[i] = re.sub(r"([\\@<>&#])", r"\\\1", parts[i])
        # A dot by itself would end a list.
        parts[i] = re.sub(r"(?<=\s)\.+(?=\s|$)", lambda dots: r"\." * len(dots[0]), parts[i])
    return "`".join(parts)


def is_example(text, last_text, in_example):
    """The lines of a paragraph that is indented."""
    return text.startswith("   ") and (in_example or last_text == "")


def filtered(lines, name):
    in_head, behind_code = True, None  # behind_code: column of the comment that may go on
    last_text, in_example = None, False  # of the comment on lines of its own
    for number, line in enumerate(lines):
        found = CODE_AND_COMMENT.match(line)
        if not found or NO_CODE_TO_DESCRIBE.match(line):
            in_head, behind_code = False, None
            last_text, in_example = None, False
            yield line
            continue
        in_example = is_example(found[2], last_text, in_example)
        last_text = found[2]
        code, text = found[1], "   " + found[2] if in_example else escaped(found[2])
        if code.strip():
            in_head, behind_code = False, len(code)
            yield f"{code}///<{text}"
        elif behind_code == len(code):
            yield f"{code}///<{text}"
        else:
            behind_code = None
            head = f" \\file {name}" if in_head and number == 0 else ""
            yield f"{code}///{head}{text}"


def main():
    file = Path(sys.argv[1])
    for line in filtered(file.read_text().splitlines(), file.name):
        print(line)


if __name__ == "__main__":
    main()
