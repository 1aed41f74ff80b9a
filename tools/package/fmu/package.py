#!/usr/bin/python3 -B
"""Makes the FMUs of a scene, in two steps: `layout` writes their sources and
descriptions, after which the binaries are compiled, and `pack` puts all into
archives with fixed times, so that equal contents are equal bytes.

usage: package.py layout DESCRIPTION.json CORE DIRECTORY
       package.py pack DIRECTORY FMI2.fmu FMI3.fmu

DIRECTORY/fmi2 and DIRECTORY/fmi3 are the contents of the two; the scene is in
DIRECTORY/scene.h, as a constant; CORE has twofold.c and twofold.h. The model
descriptions are made from DESCRIPTION.json, what describe.c prints: from the
core's own table of parameters."""
import hashlib
import json
import re
import shutil
import sys
import uuid
import zipfile
from pathlib import Path
from xml.sax.saxutils import quoteattr

ROOT = Path(__file__).resolve().parents[3]
HERE = Path(__file__).resolve().parent
FACES = "fmi2", "fmi3"
NOT_IN_FMU = {"describe.c", "fmu_scene.h"}
WRITTEN = 0o100644 << 16  # a plain file that all may read
MODEL = "twofold"
# Enumerations, by the variable of the type.
ABOUT = {"Law": "law of friction", "Rule": "rule of selection",
         "Scheme": "scheme", "Mode": "mode of contact",
         "Take": "mode to take, or choose: by the rule",
         "Status": "what a step returned"}
CATEGORIES = {"logEvents": "changes of mode or of the consistent modes",
              "logStatusDiscard": "refused values; of FMI 3 also steps",
              "logStatusError": "wrong calls; of FMI 2 also refused steps"}
# Exponents of the SI base units, as attributes of BaseUnit.
UNITS = {"kg": "kg=1", "m": "m=1", "s": "s=1", "N": "kg=1 m=1 s=-2",
         "N/m": "kg=1 s=-2", "N m": "kg=1 m=2 s=-2",
         "N m s": "kg=1 m=2 s=-1", "N s/m": "kg=1 s=-1", "rad": "rad=1",
         "m/s": "m=1 s=-1", "rad/s": "rad=1 s=-1", "rad/s^2": "rad=1 s=-2",
         "1/m": "m=-1", "1/m^2": "m=-2", "1/s": "s=-1", "1/kg": "kg=-1",
         "J": "kg=1 m=2 s=-2", "1": ""}
# Elements of FMI 2 and 3.
KINDS = {"real": ("Real", "Float64"), "truth": ("Boolean", "Boolean"),
         "member": ("Enumeration", "Enumeration"),
         "small": ("Integer", "Int32"), "seed": ("Integer", "UInt32"),
         "count": ("Real", "UInt64")}
FMI2_INTEGER = 2**31 - 1  # the largest number of the type


def tag(element, inside=None, /, **attributes):
    """An element on one line, or around the lines inside."""
    text = "<" + element + "".join(
        f" {key}={quoteattr(str(value))}"
        for key, value in attributes.items() if value is not None)
    if inside is None:
        return text + "/>"
    lines = "\n".join(inside).splitlines()
    return "\n".join([text + ">", *("  " + line for line in lines),
                      f"</{element}>"])


def document(root):
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + root + "\n"


def unit_definitions(model):
    used = {v["unit"] for v in model["variables"]} | {"s"}
    units = []
    for name in sorted(used):
        powers = dict(item.split("=") for item in UNITS[name].split())
        units.append(tag("Unit", [tag("BaseUnit", **powers)], name=name))
    return tag("UnitDefinitions", units)


def enumerations(model):
    """For every enumeration: name of the type, its items."""
    for variable in model["variables"]:
        if "members" not in variable:
            continue
        low = int(float(variable["low"]))
        about = (model["statuses"] if variable["name"] == "status"
                 else [None] * len(variable["members"]))
        yield variable["name"].capitalize(), [
            tag("Item", name=name, value=low + i, description=text)
            for i, (name, text) in enumerate(zip(variable["members"], about))]


def common(model, token_name, token, co_simulation, type_of, variables,
           structure, version):
    """The description of either version. type_of: makes the definition of an
    enumeration."""
    return document(tag(
        "fmiModelDescription",
        [co_simulation, unit_definitions(model),
         tag("TypeDefinitions",
             [type_of(name, items) for name, items in enumerations(model)]),
         tag("LogCategories", [tag("Category", name=name, description=about)
                               for name, about in CATEGORIES.items()]),
         tag("DefaultExperiment", startTime="0", stopTime=model["t_end"],
             stepSize=model["dt"]),
         tag("ModelVariables", variables), tag("ModelStructure", structure)],
        fmiVersion=version, **{token_name: token},
        modelName=f"{MODEL} {model['scene']}",
        description=f"wheel on a turntable, set-valued friction; scene "
                    f"{model['scene']}: {model['shows']}",
        version=model["version"], license="MIT",
        generationTool=f"twofold {model['version']}",
        variableNamingConvention="structured"))


def variability(variable):
    if variable["role"] == "parameter":
        return "fixed"
    steady = variable["kind"] != "real" or variable["name"] == "event_time"
    return "discrete" if steady else "continuous"


def start(variable):
    """The value at the start, as text; an output has none."""
    if variable["role"] == "output":
        return None
    if variable["kind"] == "truth":
        return "true" if float(variable["start"]) else "false"
    if variable["kind"] == "real":
        return variable["start"]
    return str(int(float(variable["start"])))


def bounds(variable, most=None):
    """min and max of a number that the importer sets."""
    if variable["role"] == "output" or variable["kind"] in ("truth", "member"):
        return {}
    low, high = variable["low"], variable["high"]
    if variable["kind"] != "real":
        low, high = int(float(low)), int(float(high))
        high = min(high, most) if most else high
    return {"min": low, "max": high}


def of_variable(variable):
    """What both versions say of a variable."""
    return {"name": variable["name"], "valueReference": variable["reference"],
            "description": variable["about"], "causality": variable["role"],
            "variability": variability(variable),
            "initial": {"parameter": "exact", "output": "calculated"}.get(
                variable["role"])}


def of_value(variable, most=None):
    """What both versions say of its values. most: of integers."""
    kind, name = variable["kind"], variable["name"]
    return {"declaredType": name.capitalize() if kind == "member" else None,
            "unit": variable["unit"] if kind == "real" else None,
            **bounds(variable, most), "start": start(variable)}


TIME = {"name": "time", "valueReference": 0, "description": "time",
        "causality": "independent", "variability": "continuous"}


def fmi3(model, token):
    outputs = [v["reference"] for v in model["variables"]
               if v["role"] == "output"]
    return common(
        model, "instantiationToken", token,
        tag("CoSimulation", modelIdentifier=MODEL,
            canHandleVariableCommunicationStepSize="true",
            canGetAndSetFMUState="true", canSerializeFMUState="true",
            fixedInternalStepSize=model["dt"],
            mightReturnEarlyFromDoStep="true", hasEventMode="true"),
        lambda name, items: tag("EnumerationType", items, name=name,
                                description=ABOUT[name]),
        [tag("Float64", **TIME, unit="s"),
         *(tag(KINDS[v["kind"]][1], **of_variable(v), **of_value(v))
           for v in model["variables"])],
        [tag(element, valueReference=r)
         for element in ("Output", "InitialUnknown") for r in outputs], "3.0")


def fmi2(model, token, sources):
    unknowns = [tag("Unknown", index=i)
                for i, v in enumerate(model["variables"], 2)
                if v["role"] == "output"]
    return common(
        model, "guid", token,
        tag("CoSimulation",
            [tag("SourceFiles", [tag("File", name=n) for n in sources])],
            modelIdentifier=MODEL,
            canHandleVariableCommunicationStepSize="true",
            canNotUseMemoryManagementFunctions="true",
            canGetAndSetFMUstate="true", canSerializeFMUstate="true"),
        lambda name, items: tag("SimpleType", [tag("Enumeration", items)],
                                name=name, description=ABOUT[name]),
        [tag("ScalarVariable", [tag("Real", unit="s")], **TIME),
         *(tag("ScalarVariable",
               [tag(KINDS[v["kind"]][0], **of_value(v, FMI2_INTEGER))],
               **of_variable(v)) for v in model["variables"])],
        [tag("Outputs", unknowns), tag("InitialUnknowns", unknowns)], "2.0")


def build_description(sources):
    """How to compile the sources of an FMU of FMI 3."""
    return document(tag(
        "fmiBuildDescription",
        [tag("BuildConfiguration",
             [tag("SourceFileSet",
                  [tag("SourceFile", name=name) for name in sources],
                  language="C99", compiler="gcc",
                  compilerOptions="-O2 -ffp-contract=off -fno-math-errno"),
              tag("Library", name="m")],
             modelIdentifier=MODEL)],
        fmiVersion="3.0"))


def icon_description():
    """Where the icon of an FMU of FMI 3 is drawn."""
    corners = {"x1": "-100", "y1": "-100", "x2": "100", "y2": "100"}
    system = tag("CoordinateSystem", **corners,
                 suggestedScalingFactorTo_mm="0.1")
    return document(tag(
        "fmiTerminalsAndIcons",
        [tag("GraphicalRepresentation", [system, tag("Icon", **corners)])],
        fmiVersion="3.0"))


def sources_of(face, core):
    """The files from which one FMU is compiled, name to text: those here and
    the core in two files, because importers know no folders."""
    others = {f"{other}.c" for other in FACES if other != face}
    paths = [*sorted(HERE.glob("*.[ch]")), *sorted(HERE.glob("../../*.[ch]")),
             core / "twofold.c", core / "twofold.h"]
    return {path.name: path.read_text() for path in paths
            if path.name not in others | NOT_IN_FMU}


def token_of(model, texts):
    """Names interface and sources: it changes when either does."""
    digest = hashlib.sha256(json.dumps([model, texts], sort_keys=True).encode())
    return "{" + str(uuid.UUID(digest.hexdigest()[:32])) + "}"


def page(model, version):
    rows = "\n".join(
        f"<tr><td>{v['name']}</td><td>{v['role']}</td><td>{v['unit']}</td>"
        f"<td>{v['about'].replace('>', '&gt;')}</td></tr>"
        for v in model["variables"])
    use = (ROOT / "docs" / "USE.md").read_text()
    guide = re.search(r"^## FMI.*?(?=^## )", use, re.M | re.S)[0]
    guide = guide.replace("&", "&amp;").replace("<", "&lt;")
    return (f"<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\">\n"
            f"<title>twofold {model['scene']}, FMI {version}</title>\n"
            f"<h1>twofold {model['scene']}, FMI {version}</h1>\n"
            f"<table>\n{rows}\n</table>\n<pre>\n{guide}</pre>\n</html>\n")


def reference(model, csv):
    """Results of the command line, with the names and numbers of the FMU."""
    modes = next(v["members"] for v in model["variables"]
                 if v["name"] == "mode")
    head, *rows = [line.split(",") for line in csv.splitlines()]
    for row in rows:
        for name, number in (("mode", modes.index), ("set", lambda modes_: sum(
                1 << modes.index(one) for one in modes_.split("|") if one))):
            at = head.index(name)
            row[at] = str(number(row[at]))
    return "".join(",".join(row) + "\n"
                   for row in [["time", *head[1:]], *rows])


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def lay_out(model, core, directory):
    texts = {face: sources_of(face, core) for face in FACES}
    constant = (directory / "scene.h").read_text()
    token = token_of([model, constant], texts)
    scene = (f"// The scene and the token of this FMU, {model['scene']}.\n"
             f"#include \"twofold.h\"\n\n{constant}\n"
             "#define FMU_SCENE (&scene_constants)\n"
             f"#define FMU_TOKEN \"{token}\"\n")
    picture = (HERE / "icon.png").read_bytes()
    for face, files in texts.items():
        home = directory / face
        shutil.rmtree(home, ignore_errors=True)
        for name, text in files.items():
            write(home / "sources" / name, text)
        write(home / "sources" / "fmu_scene.h", scene)
        units = [name for name in sorted(files) if name.endswith(".c")]
        if face == "fmi2":
            xml = fmi2(model, token, units)
            (home / "model.png").write_bytes(picture)
        else:
            write(home / "terminalsAndIcons" / "terminalsAndIcons.xml",
                  icon_description())
            (home / "terminalsAndIcons" / "icon.png").write_bytes(picture)
            xml = fmi3(model, token)
            write(home / "sources" / "buildDescription.xml",
                  build_description(units))
        write(home / "modelDescription.xml", xml)
        write(home / "documentation" / "index.html", page(model, face[-1]))
        write(home / "documentation" / "licenses" / "license.txt",
              (ROOT / "LICENSE").read_text())
        write(home / "documentation" / "twofold_ref.csv",
              reference(model, (directory / "reference.csv").read_text()))


def pack(home, archive):
    archive.parent.mkdir(parents=True, exist_ok=True)
    files = sorted(p for p in home.rglob("*") if p.is_file())
    files.sort(key=lambda p: p.name != "modelDescription.xml")
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as out:
        for path in files:
            entry = zipfile.ZipInfo(path.relative_to(home).as_posix(),
                                    (1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = 3
            entry.external_attr = WRITTEN
            out.writestr(entry, path.read_bytes())


def main():
    if len(sys.argv) == 5 and sys.argv[1] == "layout":
        _, _, model, core, directory = sys.argv
        lay_out(json.loads(Path(model).read_text()), Path(core),
                Path(directory))
    elif len(sys.argv) == 5 and sys.argv[1] == "pack":
        pack(Path(sys.argv[2]) / "fmi2", Path(sys.argv[3]))
        pack(Path(sys.argv[2]) / "fmi3", Path(sys.argv[4]))
    else:
        raise SystemExit(__doc__)


main()
