"""Of check `arrows`: the rooms of tools/ and the one way between them, for
includes in C and imports in Python. A room uses those before it in ROOMS, what
lies in tools/ itself, and, from `bench` on, the reference of the tests. A file
in C that names a function of another one of its folder is an arrow, too.
"""
import ast
import json
import re
import subprocess
from pathlib import Path

ROOMS = ("cli", "board", "package", "page", "bench", "study", "verify")
REFERENCE, JUDGES = "tests/reference/", ("bench", "study", "verify")
PYTHON = re.compile(r"#!.*\bpython3?\b")
# Not code: comments, strings.
QUIET = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"', re.S)


def room_of(file):
    """Of a file of tools/; None where it lies in tools/ itself or elsewhere."""
    parts = file.split("/")
    return parts[1] if parts[0] == "tools" and len(parts) > 2 else None


def allows(file, target):
    """Whether a file of a room may use another file."""
    room, other = room_of(file), room_of(target)
    if target.startswith("tests/"):
        return target.startswith(REFERENCE) and room in JUDGES
    if room is None or other is None:
        return other is None
    return room in ROOMS and other in ROOMS and \
        ROOMS.index(other) <= ROOMS.index(room)


def python_files(root):
    """Scripts and modules of tools/, and modules of the reference."""
    for path in sorted([*root.glob("tools/**/*"),
                        *root.glob(f"{REFERENCE}**/*.py")]):
        if path.is_file() and (
                path.suffix == ".py" or not path.suffix and
                PYTHON.match(path.read_text("utf-8", "replace"))):
            yield path.relative_to(root).as_posix()


def imports(root):
    """(file, file that it imports): by a module's last name, of its own folder
    or else of any."""
    files = list(python_files(root))
    for file in files:
        folder = file.rsplit("/", 1)[0]
        for node in ast.walk(ast.parse((root / file).read_text("utf-8"))):
            names = [alias.name for alias in node.names] if isinstance(
                node, (ast.Import, ast.ImportFrom)) else []
            if isinstance(node, ast.ImportFrom) and node.module:
                names = [node.module] + [f"{node.module}.{n}" for n in names]
            for name in names:
                stem = name.replace(".", "/") + ".py"
                found = [one for one in files if one.endswith("/" + stem)]
                own = [one for one in found if one.startswith(folder + "/")]
                yield from ((file, one) for one in own or found)


def uses(root):
    """(file, other file of the same folder of tools/ whose functions it
    names); a table of functions that these read is data, no arrow back."""
    files = [path.relative_to(root).as_posix()
             for path in sorted(root.glob("tools/**/*.c"))]
    if not files:
        return
    tags = subprocess.run(
        ["ctags", "--sort=no", "--output-format=json", "--kinds-C=f",
         "--fields=+{file}", "-f", "-", *files], cwd=root, check=True,
        stdout=subprocess.PIPE, text=True).stdout
    home = {}
    for tag in map(json.loads, tags.splitlines()):
        if not tag.get("file"):
            home.setdefault(tag["name"], set()).add(tag["path"])
    for file in files:
        text = QUIET.sub(" ", (root / file).read_text())
        for name in set(re.findall(r"\b[A-Za-z_]\w*", text)) & home.keys():
            for other in home[name] - {file}:
                if file not in home[name] and \
                        Path(other).parent == Path(file).parent:
                    yield file, other
