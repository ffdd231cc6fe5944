"""Takes single files out of Debian packages, without installing them."""
import gzip
import subprocess
import sys
import tarfile
from pathlib import Path


def require(packages, folder):
    """Exits with the command that downloads what is missing."""
    missing = sorted(p for p in set(packages) if not list(Path(folder).glob(f"{p}_*.deb")))
    if missing:
        sys.exit(f"{folder}: found no package {', '.join(missing)}. Download them:\n"
                 f"    cd {folder} && apt-get download {' '.join(missing)}")


def take(package, members, folder, out):
    """Unpacks members of a package from `folder` to `out`. Returns their files by member.

    A member is a path in the package. `data.tar.gz:meshes/bear.off` is a file in an archive, and
    what ends in .gz is unpacked."""
    paths = sorted({member.split(":")[0] for member in members})
    deb = next(Path(folder).glob(f"{package}_*.deb"))
    Path(out).mkdir(parents=True, exist_ok=True)
    archive = subprocess.Popen(["dpkg-deb", "--fsys-tarfile", deb], stdout=subprocess.PIPE)
    done = subprocess.run(["tar", "-x", "-C", out, *(f"./{p}" for p in paths)],
                          stdin=archive.stdout, stderr=subprocess.PIPE, text=True, check=False)
    archive.stdout.close()
    archive.wait()
    if done.returncode != 0:
        raise FileNotFoundError(f"{deb}: {done.stderr.strip()}")
    return {member: unpacked(Path(out), member) for member in members}


def unpacked(out, member):
    path, _, inner = member.partition(":")
    file = out / path
    if inner:
        with tarfile.open(file) as archive:
            archive.extract(inner, out)
        return out / inner
    if file.suffix == ".gz":
        plain = file.with_suffix("")
        plain.write_bytes(gzip.decompress(file.read_bytes()))
        return plain
    return file
