"""The archives themselves: equal bytes of two builds, descriptions that agree
with the core, sources that compile, and no memory from a heap."""
import os
import shutil
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path

from importer import DISCARD, Fmu
from tap import ROOT, Skip, call, check, lacks
from test_calls import refused

LEFT = {"memcpy", "memset", "memcmp", "memmove", "strcmp", "strncpy", "sqrt"}
MINGW, WINE = "x86_64-w64-mingw32-gcc", "/usr/lib/wine/wine64"
FUNCTIONS = {"2": 34, "3": 75}
M4F = ["arm-none-eabi-gcc", "-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard",
       "-mfpu=fpv4-sp-d16"]


def make_fmu(scene, build):
    """What `make fmu` makes, with the flags of this build."""
    call("-s", "-C", ROOT, "fmu", f"BUILD={build}", f"SCENE={scene}",
         *(f"{name}={os.environ[name]}" for name in ("OPT", "CC", "EXTRA")
           if os.environ.get(name)), program=os.environ.get("MAKE", "make"))


class Archive:
    def __init__(self, archive, rows, same_bits):
        self.archive, self.rows, self.same_bits = archive, rows, same_bits

    def two_builds_are_equal(self):
        with tempfile.TemporaryDirectory(prefix="twofold-fmu.") as folder:
            make_fmu("chaos", folder)
            for archive in (self.archive("chaos", v) for v in "23"):
                again = Path(folder, "dist", archive.name).read_bytes()
                check(again == archive.read_bytes(), f"{archive}: other bytes")

    def descriptions_agree_with_the_core(self):
        """Each variable has a start in its range, which is what the binary
        begins with."""
        for version in "23":
            fmu = Fmu(self.archive("chaos", version))
            wheel = fmu.instance()
            self.members_are_those_of_the_core(fmu, wheel)
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

    @staticmethod
    def members_are_those_of_the_core(fmu, wheel):
        """An enumeration has as many items as the core accepts numbers."""
        types = {element.get("name"): len(list(element.iter("Item")))
                 for element in fmu.root.find("TypeDefinitions")}
        check(types["Take"] == types["Mode"] + 1, "Take")
        for name in ("law", "rule", "scheme"):
            variable = fmu.variables[name].attributes
            count, start = types[variable["declaredType"]], wheel.get(name)
            wheel.set(name, count - 1)
            refused(DISCARD, name, wheel.set, name, count)
            wheel.set(name, start)

    def every_function_is_there(self):
        """Importers look for all of the standard."""
        if not shutil.which("nm"):
            raise Skip("no nm")
        for version in "23":
            fmu = Fmu(self.archive("chaos", version))
            library = next(fmu.home.glob("binaries/*/*.so"))
            exported, _ = call("-D", "--defined-only", library, program="nm")
            names = [line.split()[-1] for line in exported.splitlines()]
            check(len(names) == FUNCTIONS[version], f"exported: {names}")
            check(all(name.startswith(f"fmi{version}") for name in names),
                  f"exported: {names}")

    def sources_have_the_same_bits(self):
        """Compiled as importers do: all files, GNU C, no flags of ours."""
        expected = self.rows("chaos", "--t-end", "3", "--every", "10")
        for version in "23":
            fmu = Fmu(self.archive("chaos", version))
            sources = sorted(str(p) for p in fmu.home.glob("sources/*.c"))
            # FMI 3 has the list in a file of its own.
            root = (fmu.root if version == "2" else ET.parse(
                fmu.home / "sources/buildDescription.xml").getroot())
            listed = [e.get("name") for e in root.iter(
                "File" if version == "2" else "SourceFile")]
            check(sorted(listed) == [Path(s).name for s in sources], "list")
            library = fmu.home / "own.so"
            call("-std=gnu17", "-O1", "-fPIC", "-shared", *sources, "-lm", "-o",
                 library, program=os.environ.get("CC", "gcc"))
            again = Fmu(self.archive("chaos", version), library)
            self.same_bits(again.instance().begin(), expected, 10)

    def compiles_for_a_microcontroller(self):
        """All sources, in both real types; what is left to link is memcpy and
        its kin, and what the compiler's own library has: no heap."""
        if not shutil.which(M4F[0]):
            raise Skip(f"no {M4F[0]}")
        for version, real in (("2", []), ("3", ["-DTF_REAL_FLOAT"])):
            fmu = Fmu(self.archive("chaos", version))
            sources = sorted(str(p) for p in fmu.home.glob("sources/*.c"))
            program = fmu.home / "all.o"
            call(*M4F[1:], "-std=gnu17", "-O1", "-fno-math-errno", "-Wall",
                 "-Werror", "-DFMU_INSTANCES=1", "-DFMU_COPIES=1",
                 f"-DFMI{version}_FUNCTION_PREFIX=wheel_", *real, "-nostdlib",
                 "-r", *sources, "-o", program, program=M4F[0])
            symbols, _ = call(program, program=M4F[0].replace("gcc", "nm"))
            left = {line.split()[-1] for line in symbols.splitlines()
                    if line.split()[-2] == "U"}
            left = {name for name in left if not name.startswith("__aeabi_")}
            check(left <= LEFT, f"left to link: {left - LEFT}")
            check(f"T wheel_fmi{version}DoStep" in symbols, "prefix")

    def windows_has_the_same_bits(self):
        """Under Wine, stepped by a program that is linked with the binary."""
        for tool, of in ((MINGW, "gcc-mingw-w64-x86-64"), (WINE, "wine64")):
            if not shutil.which(tool):
                lacks(of)
        prefix = self.archive("chaos", "3").parents[1] / "wine"
        env = {**os.environ, "WINEDEBUG": "-all", "WINEPREFIX": str(prefix)}
        expected = [row[1] for row in
                    self.rows("chaos", "--t-end", "3", "--every", "100")[1:]]
        for version in "23":
            fmu = Fmu(self.archive("chaos", version))
            dll = next(fmu.home.glob("binaries/*/*.dll"))
            program = dll.with_name("windows.exe")
            call("-std=gnu17", f"-DFMI={version}", "-o", program,
                 ROOT / "tools/package/dist/test/windows.c", dll, program=MINGW)
            said, _ = call(program, fmu.token, fmu.variables["r"].reference,
                           program=WINE, env=env)
            check([*map(float.fromhex, said.split())] == expected, "bits")


def tests(*arguments):
    archive = Archive(*arguments)
    return [(f"fmu_{test.__name__}", test) for test in (
        archive.descriptions_agree_with_the_core,
        archive.every_function_is_there, archive.two_builds_are_equal,
        archive.sources_have_the_same_bits, archive.windows_has_the_same_bits,
        archive.compiles_for_a_microcontroller)]
