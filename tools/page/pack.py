#!/usr/bin/python3
"""Packs the page into one file that needs no server and asks for nothing: the
style, the modules in the order of their imports, and the simulator.

    pack.py MODULE.wasm PAGE.html SOURCE...
    pack.py sources SOURCE...    only prints the hash of the sources

Names at the top of a module are unique over all of them, so the modules can
stand in one scope, without their lines of import and export. The page's policy
allows this very style and this very script, and no connection at all. It names
the hash of what it is made of.
"""
import base64
import gzip
import hashlib
import re
import sys
from pathlib import Path

HERE = Path(__file__).parent
FIRST = "main.mjs"
IMPORT = re.compile(r"^import [^;]*? from '\./([\w.]+)';\n", re.M)
TOP = re.compile(r"^(?:export )?(?:async )?(?:const|let|class|function)\*? "
                 r"(\w+|\{[^}]*\})", re.M)


def modules(name, seen):
    """Names of modules, each behind those that it imports."""
    if name in seen:
        return
    seen[name] = None
    text = (HERE / name).read_text()
    for other in IMPORT.findall(text):
        modules(other, seen)
    del seen[name]
    seen[name] = text


def script():
    texts, owner = {}, {}
    modules(FIRST, texts)
    for name, text in texts.items():
        for word in re.findall(r"\w+", " ".join(TOP.findall(text))):
            if owner.setdefault(word, name) != name:
                sys.exit(f"pack.py: {word} is at the top of both "
                         f"{owner[word]} and {name}")
    text = "".join(IMPORT.sub("", text) for text in texts.values())
    if re.search(r"^import\b", text, re.M) or "</script" in text:
        sys.exit("pack.py: an import that is not from './NAME';, or </script")
    return re.sub(r"^(?: *//.*\n| +|export )", "", text, flags=re.M)


def digest(text):
    return base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def hashed(sources):
    """Of their names and contents."""
    found = hashlib.sha256()
    for source in sorted(sources):
        found.update(source.encode() + b"\0" + Path(source).read_bytes())
    return found.hexdigest()[:16]


def main(module, page, *sources):
    style = (HERE / "page.css").read_text()
    # In hexadecimal, where a byte is two characters wherever it stands, so that
    # gzip finds what is repeated: 9 kB less than in base64.
    core = Path(module).read_bytes().hex()
    program = script().replace("@CORE@", core)
    policy = (f"default-src 'none'; style-src 'sha256-{digest(style)}'; "
              f"script-src 'sha256-{digest(program)}' 'wasm-unsafe-eval'; "
              "img-src data:; base-uri 'none'; form-action 'none'")
    text = (HERE / "page.html").read_text()
    for key, value in (("@POLICY@", policy), ("@STYLE@", style),
                       ("@SCRIPT@", program), ("@SOURCES@", hashed(sources))):
        if text.count(key) != 1:
            sys.exit(f"pack.py: page.html has {text.count(key)} of {key}")
        text = text.replace(key, value)
    Path(page).write_text(text)
    print(f"  PACK  {page}: "
          f"{len(gzip.compress(text.encode(), 9, mtime=0))} bytes gzipped")


if sys.argv[1] == "sources":
    print(hashed(sys.argv[2:]))
else:
    main(*sys.argv[1:])
