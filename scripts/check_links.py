#!/usr/bin/python3
"""Checks the links of all tracked .md files: the file must exist, and so must the heading.

    scripts/check_links.py [FILE.md...]     these files instead of all
    scripts/check_links.py --below FOLDER   all .md files of a folder, as they are installed

A link out of the repository, or out of the folder, is broken. Addresses with a scheme (https:) are
not opened. Code is not read. Exit code 1 for a broken link, or where there is no file.
"""
import re
import subprocess
import sys
from pathlib import Path
from urllib.parse import unquote

ROOT = Path(__file__).resolve().parent.parent
# [text](target) and ![text](target); the text may hold one pair of brackets.
INLINE = re.compile(r"\[(?:[^\[\]]|\[[^\]]*\])*\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
REFERENCE = re.compile(r"^ {0,3}\[[^\]]+\]:\s+<?(\S+?)>?(?:\s|$)")
HEADING = re.compile(r"^ {0,3}#{1,6}\s+(.*?)\s*#*$")
FENCE = re.compile(r"^ {0,3}(```|~~~)")
LIST = re.compile(r"([-*+]|\d+[.)]) ")
SCHEME = re.compile(r"^[a-z][a-z0-9+.-]*:", re.IGNORECASE)


def without_code(text):
    """The same lines, with blank ones in place of code blocks and inline code emptied."""
    lines, fence, after_blank, indented, in_list = [], None, True, False, False
    for line in text.split("\n"):
        mark = FENCE.match(line)
        if fence or mark:
            fence = None if fence and mark and mark.group(1) == fence else fence or mark.group(1)
            lines.append("")
            continue
        # An indented block begins after a blank line; inside lists such lines are text.
        if line.strip() and not line.startswith(" "):
            in_list = bool(LIST.match(line))
        indented = line.startswith("    ") and (indented or after_blank) and not in_list
        after_blank = not line.strip()
        lines.append("" if indented else line)
    return re.sub(r"(`+)(?:.|\n)*?\1", lambda code: "\n" * code.group(0).count("\n"), "\n".join(lines))


def slug(heading):
    """The anchor that GitHub gives a heading."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    return re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")


def anchors(file, known={}):
    if file not in known:
        text = file.read_text(encoding="utf-8")
        found, counts, fence = set(), {}, False
        for line in text.split("\n"):
            if FENCE.match(line):
                fence = not fence
            heading = None if fence else HEADING.match(line)
            if heading:
                name = slug(heading.group(1))
                count = counts[name] = counts.get(name, -1) + 1
                found.add(name if count == 0 else f"{name}-{count}")
        found.update(re.findall(r"<[^>]+ (?:id|name)=\"([^\"]+)\"", text))
        known[file] = found
    return known[file]


def links(text):
    """(line number, target) of every link. Links may run over a line's end."""
    text = without_code(text)
    for match in INLINE.finditer(text):
        yield text.count("\n", 0, match.start()) + 1, match.group(1)
    for number, line in enumerate(text.split("\n"), 1):
        match = REFERENCE.match(line)
        if match:
            yield number, match.group(1)


def fault(file, target, root):
    """What is wrong with a link of this file; None where it leads somewhere below the root."""
    if SCHEME.match(target) or target.startswith("//"):
        return None
    path, _, anchor = target.partition("#")
    there = (file.parent / unquote(path)).resolve() if path else file
    if not there.is_relative_to(root):
        return f"found a file outside of {root}"
    if not there.exists():
        return "found no such file"
    if anchor and there.suffix == ".md" and unquote(anchor) not in anchors(there):
        return "found no such heading"
    return None


def tracked_files():
    listed = subprocess.run(["git", "ls-files", "-z", "*.md"], cwd=ROOT, check=True,
                            capture_output=True, text=True).stdout.split("\0")
    return [ROOT / name for name in listed if name and (ROOT / name).exists()]


def main():
    root = ROOT
    if sys.argv[1:2] == ["--below"] and len(sys.argv) == 3:
        root = Path(sys.argv[2]).resolve()
        files = sorted(root.rglob("*.md"))
    else:
        files = [Path(name).resolve() for name in sys.argv[1:]] or tracked_files()
    count = broken = 0
    for file in files:
        for line, target in links(file.read_text(encoding="utf-8")):
            count += 1
            why = fault(file, target, root)
            if why:
                broken += 1
                print(f"{file.relative_to(root)}:{line}: {target}: {why}", file=sys.stderr)
    print(f"check_links: {len(files)} files, {count} links, {broken} broken")
    return 1 if broken or not files else 0


if __name__ == "__main__":
    sys.exit(main())
