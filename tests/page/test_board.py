"""A board on the page's line."""
import base64
import re

from page import COMMAND, ROOT, check, command, opened, shown
from tap import output

MOTION = ("run", "chaos", "--dt", "1e-3", "--every", "20", "--t-end", "1.5")


def test_board_on_a_line():
    """Its frames come in pieces: all of them decode, the page asks for the
    schema, and rows are those of the command line."""
    stream = output(COMMAND, *MOTION, "--format", "frames")
    tab = opened()
    got = tab.value(f"""(async () => {{
      const bytes = Uint8Array.from(atob(
        '{base64.b64encode(stream).decode()}'), (c) => c.charCodeAt(0));
      const readable = new ReadableStream({{ start(line) {{
        for (let at = 0; at < bytes.length; at += 100)
          line.enqueue(bytes.slice(at, at + 100));
        line.close();
      }} }});
      const rows = [], asked = [];
      const writable = new WritableStream({{
        write(bytes) {{ asked.push(...bytes); }} }});
      const isHeld = () => document.getElementById('side').inert;
      let held = true;
      const counters = await twofold.connect({{ readable, writable }},
        (row) => {{ held &&= isHeld(); rows.push(Array.from(row)); }});
      return {{ counters, rows, asked, held: held && !isHeld() }};
    }})()""")
    check(got["held"], "the motion that is not shown can be acted on")
    documented = re.search(r"```hex describe\n([0-9A-F ]+)\n",
                           (ROOT / "docs/PROTOCOL.md").read_text())[1]
    check(bytes(got["asked"][:23]) == bytes.fromhex(documented),
          f"asks for the schema by {got['asked']}")
    # Damaged, lost, rows, rows without their other half, unknown frames,
    # whether the schema has come, whether numbers are floats.
    check(got["counters"][1:] == [0, 0, 76, 0, 0, 1, 0, 0], got["counters"])
    modes = tab.value("twofold.core.modes")
    want = [line.split(",") for line in command(*MOTION).splitlines()[1:]]
    check(got["rows"] == [[float(x) for x in row[:8]] + [
        modes.index(row[8]), int(row[9]),
        sum(1 << modes.index(name) for name in row[10].split("|"))]
        for row in want], "other rows")


def test_board_that_breaks():
    """Its line of text comes in two pieces."""
    tab = opened()
    tab.value("""twofold.connect({ readable: new ReadableStream({
      start(line) {
        for (const text of ['\\0\\r\\nfault: bus at 08000106 c',
          'ause 00008200\\r\\n\\0'])
          line.enqueue(new TextEncoder().encode(text));
      } }) })""")
    check(shown(tab, "said") == "the board's line failed: fault: bus at "
          "08000106 cause 00008200", shown(tab, "said"))
