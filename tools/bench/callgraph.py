"""Worst stack of every function, from what gcc -fcallgraph-info=su wrote
(FILE.ci) and, where it is there, its assembly (FILE.s): of global functions
and of public inline ones. A frame is what gcc says of it, return address
included. The worst of a function is its frame and the worst of what it calls;
where the assembly only ever jumps to another function (a tail call) the frame
is gone by then and does not add. A function that is in no file counts `flat`
bytes. Recursion, calls through pointers and frames of unbounded size are
refused.
"""
import re

FLAT = 32


def short(name):
    """gcc calls a file-local function "file.c:name"."""
    return name.rsplit(":", 1)[-1]


class Graph:
    def __init__(self, files, flat=FLAT):
        self.flat = flat
        self.frame, self.calls = {}, {}
        self.called, self.jumped = set(), set()
        self.depth, self.path, self.open = {}, {}, set()
        self.refused = []
        for file in files:
            with open(file) as lines:
                (self.read_assembly if str(file).endswith(".s")
                 else self.read_graph)(lines)
        self.depths = [(short(n), self.worst(n), self.path.get(n, ""))
                       for n in list(self.frame)
                       if n == short(n) or short(n).startswith("tf_")]
        for name in list(self.frame):  # also those that are never called
            self.worst(name)

    def read_assembly(self, lines):
        """A label that is no local one begins a function or its cold part."""
        inside = ""
        for line in lines:
            label = re.match(r"([A-Za-z_][\w.]*):", line)
            words = line.split()
            if label:
                inside = re.sub(r"\.cold$", "", label[1])
            elif len(words) > 1 and re.fullmatch("call|bl|j.*|tail|b",
                                                 words[0]):
                target = words[1].split("@")[0]
                if not target.startswith("."):
                    (self.called if words[0] in ("call", "bl")
                     else self.jumped).add((inside, target))

    def read_graph(self, lines):
        """node: { title: "name" label: "name\\nplace\\n48 bytes (static)" }
        edge: { sourcename: "name" targetname: "other" ... }"""
        for line in lines:
            quoted = line.split('"')
            if line.startswith("node:"):
                bytes_ = re.search(r"(\d+) bytes \(([a-z,]+)\)", quoted[3])
                if bytes_:
                    self.frame[quoted[1]] = int(bytes_[1])
                    if bytes_[2] == "dynamic":
                        self.refused.append(
                            f"{quoted[1]}: frame without a bound")
            elif line.startswith("edge:"):
                self.calls.setdefault(quoted[1], []).append(quoted[3])
                if "indirect" in quoted[3]:
                    self.refused.append(f"{quoted[1]}: calls through a pointer")

    def worst(self, name):
        if name in self.depth:
            return self.depth[name]
        if name not in self.frame:
            return self.flat
        if name in self.open:
            self.refused.append(f"{name}: recursion")
            return 0
        self.open.add(name)
        deepest, way = 0, ""
        for target in self.calls.get(name, ()):
            below = self.worst(target)
            pair = short(name), short(target)
            if pair in self.called or pair not in self.jumped:
                below += self.frame[name]
            if below > deepest:
                deepest, way = below, " > " + self.path.get(target, target)
        self.open.remove(name)
        self.path[name] = short(name) + way
        self.depth[name] = max(deepest, self.frame[name])
        return self.depth[name]
