"""The archives themselves: equal bytes of two builds, descriptions that agree
with the core, sources that compile, and no memory from a heap."""
import os
import shutil
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path

from importer import BUILD, DISCARD, ROOT, Fmu, refused, rows, same_bits
from tap import Skip, call, check, lacks

LEFT = {"memcpy", "memset", "memcmp", "memmove", "strcmp", "strlen", "strncpy",
        "sqrt"}
MINGW, WINE = "x86_64-w64-mingw32-gcc", "/usr/lib/wine/wine64"
FUNCTIONS = {"2": 34, "3": 75}
M4F = ["arm-none-eabi-gcc", "-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard",
       "-mfpu=fpv4-sp-d16"]


def make_fmu(scene, build):
    """What `make fmu` makes, with the flags of this build."""
    call("-s", "-C", ROOT, "fmu", f"BUILD={build}", f"SCENE={scene}",
         *(f"{name}={os.environ[name]}" for name in ("OPT", "CC", "EXTRA")
           if os.environ.get(name)), program=os.environ.get("MAKE", "make"))


def test_two_builds_are_equal():
    with tempfile.TemporaryDirectory(prefix="twofold-fmu.") as folder:
        make_fmu("chaos", folder)
        for archive in (Fmu(version).archive for version in "23"):
            again = Path(folder, "dist", archive.name).read_bytes()
            check(again == archive.read_bytes(), f"{archive}: other bytes")


def test_description_agrees_with_the_core(fmu):
    """Each variable has a start in its range, which is what the binary begins
    with. An enumeration has as many items as the core accepts numbers."""
    wheel = fmu.instance()
    for name, variable in fmu.variables.items():
        given = variable.attributes
        check(given.get("description"), f"{name}: what?")
        start = given.get("start", "nan")
        start = float({"true": 1, "false": 0}.get(start, start))
        if "start" in given:
            check(wheel.get(name) == start, f"{name}: start")
        if "min" in given:
            check(float(given["min"]) <= start <= float(given["max"]),
                  f"{name}: range")
    types = {element.get("name"): len(list(element.iter("Item")))
             for element in fmu.root.find("TypeDefinitions")}
    check(types["Take"] == types["Mode"] + 1, "Take")
    for name in ("law", "rule", "scheme"):
        count = types[fmu.variables[name].attributes["declaredType"]]
        wheel.set(name, count - 1)
        refused(DISCARD, name, wheel.set, name, count)


def test_every_function_is_there(fmu):
    """Importers look for all of the standard."""
    if not shutil.which("nm"):
        raise Skip("no nm")
    library = next(fmu.home.glob("binaries/*/*.so"))
    exported, _ = call("-D", "--defined-only", library, program="nm")
    names = [line.split()[-1] for line in exported.splitlines()]
    check(len(names) == FUNCTIONS[fmu.version], f"exported: {names}")
    check(all(name.startswith(f"fmi{fmu.version}") for name in names),
          f"exported: {names}")


def sources_of(fmu):
    return sorted(str(path) for path in fmu.home.glob("sources/*.c"))


def test_sources_have_the_same_bits(fmu):
    """Compiled as importers do: all files, GNU C, no flags of ours."""
    # FMI 3 has the list in a file of its own.
    root, kind = (fmu.root, "File") if fmu.version == "2" else (ET.parse(
        fmu.home / "sources/buildDescription.xml").getroot(), "SourceFile")
    listed = [element.get("name") for element in root.iter(kind)]
    check(sorted(listed) == [Path(s).name for s in sources_of(fmu)], "list")
    library = fmu.home / "own.so"
    call("-std=gnu17", "-O1", "-fPIC", "-shared", *sources_of(fmu), "-lm", "-o",
         library, program=os.environ.get("CC", "gcc"))
    same_bits(Fmu(fmu.version, binary=library).instance().begin(),
              rows("chaos", "--t-end", "3", "--every", "10"), 10)


def test_compiles_for_a_microcontroller(fmu):
    """All sources, in either real type; what is left to link is memcpy and its
    kin, and what the compiler's own library has: no heap."""
    if not shutil.which(M4F[0]):
        raise Skip(f"no {M4F[0]}")
    real = ["-DTF_REAL_FLOAT"] * (fmu.version == "3")
    program = fmu.home / "all.o"
    call(*M4F[1:], "-std=gnu17", "-O1", "-fno-math-errno", "-Wall", "-Werror",
         "-DFMU_INSTANCES=1", "-DFMU_COPIES=1",
         f"-DFMI{fmu.version}_FUNCTION_PREFIX=wheel_", *real, "-nostdlib", "-r",
         *sources_of(fmu), "-o", program, program=M4F[0])
    symbols, _ = call(program, program=M4F[0].replace("gcc", "nm"))
    left = {line.split()[-1] for line in symbols.splitlines()
            if line.split()[-2] == "U"}
    left = {name for name in left if not name.startswith("__aeabi_")}
    check(left <= LEFT, f"left to link: {left - LEFT}")
    check(f"T wheel_fmi{fmu.version}DoStep" in symbols, "prefix")


def test_windows_has_the_same_bits(fmu):
    """Under Wine, stepped by a program that is linked with the binary."""
    for tool, of in ((MINGW, "gcc-mingw-w64-x86-64"), (WINE, "wine64")):
        if not shutil.which(tool):
            lacks(of)
    env = {**os.environ, "WINEDEBUG": "-all",
           "WINEPREFIX": str(BUILD / "fmu/wine")}
    dll = next(fmu.home.glob("binaries/*/*.dll"))
    program = dll.with_name("windows.exe")
    call("-std=gnu17", f"-DFMI={fmu.version}", "-o", program,
         ROOT / "tools/package/dist/test/windows.c", dll, program=MINGW)
    said, _ = call(program, fmu.token, fmu.variables["r"].reference,
                   program=WINE, env=env)
    check([*map(float.fromhex, said.split())] == [row[1] for row in rows(
        "chaos", "--t-end", "3", "--every", "100")[1:]], "bits")
