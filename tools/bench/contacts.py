"""Instructions of a step of 1 to 4 contacts in float on a Cortex-M4F, counted
in the emulator: of the random mechanisms of tests/target/contacts.c. Prints the
table, stack and flash (`make contacts-cost`)."""
from pathlib import Path

import driven
import numpy as np
import pandas as pd
from boards import Board, Firmware, plugin
from measure import BUILD

KINDS = "masses", "few freedoms", "twins with products"
DRAWS = {1: 2000, 2: 2000, 3: 200, 4: 20}  # twins: of 1 and 2
CART = "tools/package/dist/cmake/examples/demo/cart.c"


def main() -> None:
    board, rows, elf = Board("stm32f405"), [], BUILD / "cart.elf"
    counts = Firmware(board, "float", "generic").counted(
        plugin(), "contacts")[0]
    for n, draws in DRAWS.items():
        for kind in KINDS[:3 if n < 3 else 2]:
            of, counts = np.split(counts, [draws])
            rows.append((n, kind, of.mean(), np.percentile(of, 99), of.max(),
                         (of <= 168e3).mean()))
    print(pd.DataFrame(rows, columns=["n", "drawn", "mean", "99 %", "most",
                                      "within 1 ms at 168 MHz"]).to_string(
        index=False, float_format="{:.4g}".format))
    driven.output(board.fact("CC"), "-Os", "-std=c99", "-ffp-contract=off",
                  "-DTF_REAL_FLOAT", "-Iinclude", "-ffunction-sections",
                  *board.fact("FLAGS").split(), CART, *map(
                      str, [*Path("src").glob("[fn][ru][im]*/*.c")]),
                  "-Wl,--gc-sections", "--specs=nosys.specs", "-lm", "-o", elf)
    text, data = driven.output(board.tool("size"), elf).split()[6:8]
    stack = pd.read_csv("docs/bench/worst.csv", comment="#", index_col=0).loc[
        "tf_contacts_modes", "stack stm32f405"]
    print(f"Stack of tf_contacts_modes: {stack:.0f} bytes. Flash of cart.c "
          f"with its C library: {int(text) + int(data)} bytes.")
