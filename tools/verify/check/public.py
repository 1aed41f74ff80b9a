"""The public functions, as the headers in include/ describe them."""
import re
from pathlib import Path


class Function:
    def __init__(self, name, file, line, text):
        self.name, self.file, self.line, self.text = name, file, line, text

    def row(self, pattern):
        """What the one group of a pattern takes out of the comment."""
        found = re.search(pattern, self.text)
        return found and found[1]


def functions_of(file):
    """Of each function of a header: its name and the comment before it. The
    line between them may be the macro that gives it its linked name."""
    text, name = "", None
    for number, line in enumerate(Path(file).read_text().split("\n"), 1):
        if line.startswith("///"):
            text += " " + line[3:].strip()
        elif line.startswith("#define"):
            linked = re.match(r"#define (tf_\w+) TF_LINK", line)
            name = linked[1] if linked else name
        else:
            if re.match(r"(TF_API|static inline) .*\(", line):
                named = re.search(r"(tf_\w+)\(", line)
                yield Function(name or (named and named[1]), file, number, text)
            text, name = "", None


def public_functions():
    return [function for file in sorted(Path("include").rglob("*.h"))
            for function in functions_of(file)]
