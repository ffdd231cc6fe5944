"""Writes fitted weights into their section of host/register/pose_classifier_weights.h."""
import datetime
import re
import subprocess
from pathlib import Path


def head_commit():
    command = ["git", "-C", str(Path(__file__).parent), "rev-parse", "--short", "HEAD"]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


def section(name, kind, weights, data):
    """The text of one section. `kind` is OneView or SeveralViews, `weights` maps fields to values in their order."""
    fields = ",\n    ".join(f".{field} = {value:.4g}" for field, value in weights.items())
    return (f"// begin {name}\n"
            f"// Data: {data}\n"
            f"// Date: {datetime.date.today()}. Commit: {head_commit()}.\n"
            f"inline constexpr {kind} {name}{{\n    {fields}}};\n"
            f"// end {name}\n")


def write_weights(file, name, kind, weights, data):
    text = Path(file).read_text()
    changed, count = re.subn(rf"// begin {name}\n.*?// end {name}\n",
                             lambda _: section(name, kind, weights, data), text, flags=re.DOTALL)
    if count != 1:
        raise SystemExit(f"{file}: found {count} sections {name}, expected 1")
    Path(file).write_text(changed)
