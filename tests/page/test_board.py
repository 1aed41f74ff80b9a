"""A board on the page's line."""
import base64
import os
import re
import subprocess

from page import BUILD, ROOT, URL, check, command, tab as empty_tab

BOARD = """
const put = [];
const flush = () => postMessage(put.splice(0));
const started = performance.now();
onmessage = async ({ data }) => {
  const bytes = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
  const { instance } = await WebAssembly.instantiate(bytes, { port: {
    put: (byte) => { if (put.push(byte) >= 100) flush(); },
    get: () => -1,
    now: () => performance.now() - started,
    halt: () => { throw 'halt'; },
  } });
  try {
    instance.exports.main();
  } catch (end) {
    if (end !== 'halt') throw end;
  }
  flush();
  postMessage('end');
};
"""


def board_in_a_worker():
    """Firmware for wasm32 sends from a Worker in real time. All of its frames
    decode, and its rows are those of the command line."""
    make = os.environ.get("MAKE", "make")
    name = subprocess.run(
        [make, "-s", "--no-print-directory", f"BUILD={BUILD}", "elf",
         "BOARD=wasm32", "SCENE=chaos", "REAL=double", "RATE=1000", "EVERY=20",
         "STEPS=1500", "FORMAT=frames", "NAMED=-page"], cwd=ROOT, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    check(name.returncode == 0, name.stdout)
    elf = BUILD / "boards/wasm32/chaos-double/firmware-page.elf"
    tab = empty_tab()
    tab.call("Page.setBypassCSP", enabled=True)  # for the Worker alone
    tab.open(URL)
    tab.value("twofold.play(false)")
    firmware = base64.b64encode(elf.read_bytes()).decode()
    got = tab.value(f"""(async () => {{
      const worker = new Worker(URL.createObjectURL(new Blob([{BOARD!r}])));
      const readable = new ReadableStream({{ start(stream) {{
        worker.onmessage = ({{ data }}) => data === 'end' ? stream.close()
          : stream.enqueue(Uint8Array.from(data));
      }} }});
      worker.postMessage('{firmware}');
      const rows = [], asked = [];
      const writable = new WritableStream({{
        write(bytes) {{ asked.push(...bytes); }} }});
      const counters = await twofold.connect({{ readable, writable }},
        (row) => rows.push(Array.from(row)));
      return {{ counters, rows, asked }};
    }})()""")
    documented = re.search(r"```hex describe\n([0-9A-F ]+)\n",
                           (ROOT / "docs/PROTOCOL.md").read_text())[1]
    check(bytes(got["asked"][:23]) == bytes.fromhex(documented),
          f"asks for the schema by {got['asked']}")
    frames, damaged, lost, rows, incomplete, unknown, schema, is_float = \
        got["counters"]
    check((damaged, lost, incomplete, unknown, schema, is_float)
          == (0, 0, 0, 0, 1, 0), got["counters"])
    print(f"# {frames} frames, {rows} rows")
    want = [line.split(",") for line in command(
        "run", "chaos", "--dt", "1e-3", "--every", "20", "--t-end",
        "1.5").splitlines()[1:]]
    modes = tab.value("twofold.core.modes")
    want = [[float(x) for x in row[:8]] + [modes.index(row[8]), int(row[9])]
            for row in want]
    have = {row[0]: row for row in got["rows"]}
    check(len(have) >= 70, f"{len(have)} rows")
    for row in want:
        check(have.get(row[0], row) == row, f"{have.get(row[0])} not {row}")
    check(len(set(have) & {row[0] for row in want}) >= 70, "other instants")


TESTS = [board_in_a_worker]
