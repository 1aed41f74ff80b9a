"""Scenes from files, in the page and on the command line."""
import json
import random
import struct
import tempfile
from pathlib import Path
from urllib.parse import quote

from page import (COMMAND, ROOT, check, command, csv, leads_there, opened,
                  settled, shown, visit)
from tap import call

OWN = ROOT / "tests/data/own.scene"
# Lines over `based-on chaos`, each wrong in its own way; the last ones have
# numbers that only exact reading and printing tells apart.
WRONG = ["kapa 0.3", "kappa", "kappa 0.3 0.4", "kappa = 1x", "kappa nan",
         "kappa -1e-400", "mu = 1e999", "m 0x1p-60", "law glue", "rule slip",
         "rest bow", "profile 0:1 0:2 0:3", "profile 0", "h 1\nv 2",
         "with-angle 1", "name a b", "r 1e10", "\u00e9 1", "#\ngamma 4\n#",
         "d 2\nd 2", "based-on chaos", "shows \"x\"", "t-end -1", "x" * 600,
         "#" * 17000, "kappa 1000000.0000000002", "mu inf", "r 1e-320",
         "beta 1e-10",
         "beta 0.00000000012345678901234567", "k2 123456789012345678",
         "kappa 9999999.5", "theta 0.49999999999999994", "c1 -5e-324"]
COMMAND_LINE = ("twofold.draw(); "
                "document.getElementById('command').textContent")


def address_of(path):
    return f"file={quote(path.name, safe='')}:{quote(path.read_text())}"


def test_csv_of_a_file():
    """Byte for byte what `run FILE` writes."""
    tab = opened(address_of(OWN), 21000)
    check(shown(tab, "refusal") == "", shown(tab, "refusal"))
    got, (_, run, name, *words) = csv(tab)
    check(name == OWN.name, "another file is named")
    check(got == command(run, OWN, *words), "another motion")


def test_file_in_the_address():
    """What was changed in the page holds beside the file, to the bit."""
    tab = opened(address_of(OWN) + "&kappa=0.31&take=40:slip%2B&tick=900",
                 900)
    check(leads_there(tab).value("twofold.core.get('kappa')") == 0.31, "kappa")


def test_save_is_the_command_line():
    """`save` writes what `scene` prints of the same set-up."""
    tab = opened(address_of(OWN) + "&kappa=0.1&v=-0.3&law=smooth&epsilon=1e-3")
    got = tab.value("twofold.core.text(twofold.core.c.scene_print())")
    want = command("scene", str(OWN), "--set", "kappa=0.1", "--set", "v=-0.3",
                   "--set", "law=smooth", "--set", "epsilon=1e-3")
    check(got == want, f"{got}\n---\n{want}")
    for line in command("scenes").splitlines():
        name = line.split()[0]
        visit(tab, name)
        check(tab.value("twofold.core.text(twofold.core.c.scene_print())")
              == command("scene", name), name)


def test_wrong_files():
    """A file that is none is refused in the words of the command line, and the
    motion goes on."""
    tab = opened("scene=coulomb")
    with tempfile.TemporaryDirectory() as folder:
        for line in WRONG:
            path = Path(folder, "my.scene")
            path.write_text(f"based-on chaos\n{line}\n")
            said = call("run", "my.scene", code=(2, 3), program=COMMAND,
                        cwd=folder)[1]
            got = tab.value("twofold.core.takeFile('my.scene', "
                            f"{json.dumps(path.read_text())})")
            check(f"twofold: {got}\n" == said, f"{got}: {said}")
    check(tab.value("twofold.motion.advance(100)"), "does not go on")
    # A file whose start no motion has: the page shows another scene.
    tab = opened("file=no.scene:" + quote("based-on chaos\ngamma 0\nh 1"))
    told = shown(tab, "refusal")
    check("gamma = 0: with a start by h, |sin(gamma)| must be" in told
          and "scene chaos is shown unchanged" in told, told)
    check(tab.value("document.getElementById('scene').selectedIndex") == 0, "0")
    check(not tab.complaints(), tab.complaints())


def test_numbers():
    """Decimal and hexadecimal numbers have the bits that they have anywhere."""
    draw = random.Random(15)
    tab = opened()
    texts = ["-0", "0x1p-1074", "0x.8p-1021", "0.1e1", "+.5", "1.",
             "9007199.254740993", "0x1.00000000000008p0",
             "0x1.000000000000081p0", "0x1.000000000000180000000000001p-9",
             "1.00000000000000011102230246251565404",
             "1.00000000000000011102230246251565405"]
    while len(texts) < 400:
        value = struct.unpack("d", draw.randbytes(8))[0]
        if 1e-300 < abs(value) < 1e9:
            texts += [repr(value), value.hex(), f"{value:.3e}"]
        texts.append(f"{draw.getrandbits(60)}.{draw.getrandbits(200)}e"
                     f"{draw.randint(-300, -10)}")
    got = tab.value(f"""{json.dumps(texts)}.map((text) => Array.from(
      new Uint8Array(Float64Array.of(twofold.core.number(text)).buffer)))""")
    for text, bits in zip(texts, got):
        value = float.fromhex(text) if "0x" in text else float(text)
        check(bits == list(struct.pack("d", value)), f"{text}: {bits}")


def test_chosen_and_dropped():
    """By the button, and by a pointer that drops it on the page."""
    tab = opened()
    node = tab.call("DOM.querySelector", selector="#file",
                    nodeId=tab.call("DOM.getDocument")["root"]["nodeId"])
    tab.call("DOM.setFileInputFiles", files=[str(OWN)], **node)
    settled(tab)
    name = "document.getElementById('scene').selectedOptions[0].text"
    check(tab.value(name) == "own", tab.value(name))
    check(tab.value("document.getElementById('shows').textContent")
          == "a scene from a file", "what it shows")
    tab.value("""(() => {
      const data = new DataTransfer();
      data.items.add(new File(['based-on rolling\\nname dropped\\n'], 'd'));
      document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: data,
        bubbles: true, cancelable: true }));
    })()""")
    settled(tab)
    check(tab.value(name) == "dropped", tab.value(name))
    check(tab.value("document.getElementById('scene').length") == 10, "list")
    check("twofold run ./d" in tab.value(COMMAND_LINE), "./d")
    tab.value("""(() => {
      const list = document.getElementById('scene');
      for (const i of [2, 9]) {
        list.selectedIndex = i;
        list.onchange();
      }
    })()""")
    settled(tab)
    check(tab.value(name) == "dropped", "it can be chosen again")
    check(not tab.complaints(), tab.complaints())
