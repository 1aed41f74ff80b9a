"""The archives themselves: equal bytes of two builds, descriptions that agree
with the core and with the standard's schemas, sources that compile, and no
memory from a heap."""
import os
import shutil
import subprocess
import tempfile
import xml.etree.ElementTree as ET
import zipfile
from pathlib import Path

from importer import Fmu, Refused
from tap import Skip, check

NO_HEAP = ("malloc", "calloc", "realloc", "free", "printf", "fopen", "mmap")
LEFT = {"memcpy", "memset", "memcmp", "memmove", "strcmp", "strncpy", "sqrt"}
FUNCTIONS = {"2": 34, "3": 75}
M4F = ["arm-none-eabi-gcc", "-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard",
       "-mfpu=fpv4-sp-d16"]


def done(*command, **options):
    """Runs a command that has to succeed; returns its output."""
    result = subprocess.run(command, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True, check=False,
                            **options)
    check(result.returncode == 0, f"{command[0]}: {result.stdout[-2000:]}")
    return result.stdout


class Archive:
    """root: of the project; build: what make made."""

    def __init__(self, root, build, archive, rows, same_bits):
        self.root, self.build, self.archive = root, build, archive
        self.rows, self.same_bits = rows, same_bits

    def two_builds_are_equal(self):
        with tempfile.TemporaryDirectory(prefix="twofold-fmu.") as folder:
            make = os.environ.get("MAKE", "make")
            settings = [f"{k}={os.environ[k]}" for k in ("OPT", "CC", "EXTRA")
                        if os.environ.get(k)]
            done(make, "-s", "-C", str(self.root), "fmu", f"BUILD={folder}",
                 "SCENE=chaos", *settings)
            for version, name in (("3", "twofold.fmu"),
                                  ("2", "twofold-fmi2.fmu")):
                again = Path(folder, "dist", name).read_bytes()
                check(again == self.archive("chaos", version).read_bytes(),
                      f"{name}: other bytes")

    def descriptions_agree_with_the_core(self):
        """Names, units and ranges, read from the source of the core's table."""
        text = (self.root / "src/model/prepare.c").read_text()
        names = [line.split("(")[1].split(",")[0]
                 for line in text.splitlines()
                 if line.strip().startswith("RANGE(")] + ["gamma"]
        check(len(names) == 21, f"parameters: {names}")
        for version in "23":
            fmu = Fmu(self.archive("chaos", version))
            for name in names:
                variable = fmu.variables[name].attributes
                expected = ("input" if name in ("omega0", "r0")
                            else "parameter")
                check(variable["causality"] == expected, name)
                check("unit" in variable, f"{name}: no unit")
                low, high = float(variable["min"]), float(variable["max"])
                check(low <= float(variable["start"]) <= high, f"{name}: start")
            wheel = fmu.instance()
            self.members_are_those_of_the_core(fmu, wheel)
            for name, variable in fmu.variables.items():
                check(variable.attributes.get("description"), f"{name}: what?")
                if "start" in variable.attributes:
                    start = variable.attributes["start"]
                    start = {"true": 1, "false": 0}.get(start, start)
                    check(wheel.get(name) == float(start), f"{name}: start")

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
            try:
                wheel.set(name, count)
            except Refused:
                wheel.set(name, start)
            else:
                raise AssertionError(f"{name}: items are missing")

    def valid_by_the_schemas(self):
        """FMI_SCHEMAS is a folder with fmi2/ and fmi3/, the schemas of the
        standard, which are not part of this project."""
        schemas = os.environ.get("FMI_SCHEMAS")
        for version in "23":
            check(Fmu(self.archive("chaos", version)).root is not None, "XML")
        if not schemas:
            raise Skip("FMI_SCHEMAS is not set")
        if not shutil.which("xmllint"):
            raise Skip("no xmllint")
        pairs = [("2", "modelDescription.xml", "fmi2ModelDescription.xsd"),
                 ("3", "modelDescription.xml", "fmi3ModelDescription.xsd"),
                 ("3", "sources/buildDescription.xml",
                  "fmi3BuildDescription.xsd"),
                 ("3", "terminalsAndIcons/terminalsAndIcons.xml",
                  "fmi3TerminalsAndIcons.xsd")]
        for scene in sorted(p.parent.name
                            for p in self.build.glob("fmu/*/done")):
            for version, name, schema in pairs:
                fmu = Fmu(self.archive(scene, version))
                done("xmllint", "--noout", "--schema",
                     f"{schemas}/fmi{version}/{schema}", str(fmu.home / name))

    def no_heap(self):
        if not shutil.which("nm"):
            raise Skip("no nm")
        for version in "23":
            fmu = Fmu(self.archive("chaos", version))
            library = next(fmu.home.glob("binaries/*/*.so"))
            symbols = done("nm", "-D", "--undefined-only", str(library))
            for word in NO_HEAP:
                check(word not in symbols, f"{word} in: {symbols}")
            # Importers look for every function of the standard.
            exported = done("nm", "-D", "--defined-only", str(library))
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
            listed = [e.get("name") for e in self.listed(fmu)]
            check(sorted(listed) == [Path(s).name for s in sources], "list")
            library = fmu.home / "own.so"
            done(os.environ.get("CC", "gcc"), "-std=gnu17", "-O1", "-fPIC",
                 "-shared", *sources, "-lm", "-o", str(library))
            again = Fmu(self.archive("chaos", version), library)
            options = ({} if version == "2"
                       else {"events": False, "early": False})
            self.same_bits(again.instance(**options).begin(), expected, 10)

    @staticmethod
    def listed(fmu):
        if fmu.version == "2":
            return fmu.root.iter("File")
        path = fmu.home / "sources" / "buildDescription.xml"
        return ET.parse(path).getroot().iter("SourceFile")

    def compiles_for_a_microcontroller(self):
        """All sources, in both real types; what is left to link is memcpy and
        its kin, and what the compiler's own library has."""
        if not shutil.which(M4F[0]):
            raise Skip(f"no {M4F[0]}")
        for version, real in (("2", []), ("3", ["-DTF_REAL_FLOAT"])):
            fmu = Fmu(self.archive("chaos", version))
            sources = sorted(str(p) for p in fmu.home.glob("sources/*.c"))
            program = fmu.home / "all.o"
            done(*M4F, "-std=gnu17", "-O1", "-fno-math-errno", "-Wall",
                 "-Werror", "-DFMU_INSTANCES=1", "-DFMU_COPIES=1",
                 f"-DFMI{version}_FUNCTION_PREFIX=wheel_", *real, "-nostdlib",
                 "-r", *sources, "-o", str(program))
            nm = M4F[0].replace("gcc", "nm")
            left = {line.split()[-1] for line in done(
                nm, "--undefined-only", str(program)).splitlines()}
            left = {name for name in left if not name.startswith("__aeabi_")}
            check(left <= LEFT, f"left to link: {left - LEFT}")
            check(f"T wheel_fmi{version}DoStep" in done(nm, str(program)),
                  "prefix")

    def archive_holds_what_it_should(self):
        for version in "23":
            with zipfile.ZipFile(self.archive("chaos", version)) as files:
                names = files.namelist()
                check(files.testzip() is None, "broken")
                check(names[0] == "modelDescription.xml", names[0])
                for name in ("documentation/index.html",
                             "documentation/licenses/license.txt",
                             "sources/fmu_scene.h"):
                    check(name in names, name)
                check(not any("fmi2Func" in n or "fmi3Func" in n
                              for n in names), "headers of the standard")


def tests(*arguments):
    archive = Archive(*arguments)
    return [(f"fmu_{test.__name__}", test) for test in (
        archive.archive_holds_what_it_should,
        archive.descriptions_agree_with_the_core,
        archive.valid_by_the_schemas, archive.no_heap,
        archive.two_builds_are_equal, archive.sources_have_the_same_bits,
        archive.compiles_for_a_microcontroller)]
