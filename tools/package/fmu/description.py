"""The XML files of an FMU, made from what describe.c prints: from the core's
own table of parameters. Nothing in them depends on time or place."""
from xml.sax.saxutils import quoteattr

MODEL = "twofold"
TYPES = {"law": "Law", "rule": "Rule", "scheme": "Scheme", "mode": "Mode",
         "take": "Take", "status": "Status"}
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
    """For every enumeration: name of the type, items (name, value, about)."""
    for variable in model["variables"]:
        if "members" not in variable:
            continue
        low = int(float(variable["low"]))
        about = (model["statuses"] if variable["name"] == "status"
                 else [None] * len(variable["members"]))
        yield TYPES[variable["name"]], [
            (name, low + i, text)
            for i, (name, text) in enumerate(zip(variable["members"], about))]


def items(members):
    return [tag("Item", name=name, value=value, description=about)
            for name, value, about in members]


def log_categories():
    return tag("LogCategories", [tag("Category", name=name, description=about)
                                 for name, about in CATEGORIES.items()])


def experiment(model):
    return tag("DefaultExperiment", startTime="0", stopTime=model["t_end"],
               stepSize=model["dt"])


def common(model):
    return {"modelName": f"{MODEL} {model['scene']}",
            "description": f"wheel on a turntable, set-valued friction; scene "
                           f"{model['scene']}: {model['shows']}",
            "version": model["version"], "license": "MIT",
            "generationTool": f"twofold {model['version']}",
            "variableNamingConvention": "structured"}


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
    kind = variable["kind"]
    return {"declaredType": TYPES[variable["name"]] if kind == "member"
            else None, "unit": variable["unit"] if kind == "real" else None,
            **bounds(variable, most), "start": start(variable)}


def variable3(variable):
    element = {"real": "Float64", "truth": "Boolean", "member": "Enumeration",
               "small": "Int32", "seed": "UInt32",
               "count": "UInt64"}[variable["kind"]]
    return tag(element, **of_variable(variable), **of_value(variable))


def fmi3(model, token):
    types = [tag("EnumerationType", items(members), name=name,
                 description=ABOUT[name])
             for name, members in enumerations(model)]
    outputs = [v["reference"] for v in model["variables"]
               if v["role"] == "output"]
    time = tag("Float64", name="time", valueReference=0,
               description="time", causality="independent",
               variability="continuous", unit="s")
    return document(tag(
        "fmiModelDescription",
        [tag("CoSimulation", modelIdentifier=MODEL,
             canHandleVariableCommunicationStepSize="true",
             canGetAndSetFMUState="true", canSerializeFMUState="true",
             fixedInternalStepSize=model["dt"],
             mightReturnEarlyFromDoStep="true", hasEventMode="true"),
         unit_definitions(model), tag("TypeDefinitions", types),
         log_categories(), experiment(model),
         tag("ModelVariables",
             [time, *(variable3(v) for v in model["variables"])]),
         tag("ModelStructure",
             [tag("Output", valueReference=r) for r in outputs]
             + [tag("InitialUnknown", valueReference=r) for r in outputs])],
        fmiVersion="3.0", instantiationToken=token, **common(model)))


def variable2(variable):
    element = {"real": "Real", "truth": "Boolean", "member": "Enumeration",
               "small": "Integer", "seed": "Integer",
               "count": "Real"}[variable["kind"]]
    inside = tag(element, **of_value(variable, FMI2_INTEGER))
    return tag("ScalarVariable", [inside], **of_variable(variable))


def fmi2(model, token, sources):
    types = [tag("SimpleType",
                 [tag("Enumeration", items(members))],
                 name=name, description=ABOUT[name])
             for name, members in enumerations(model)]
    outputs = [i for i, v in enumerate(model["variables"], 2)
               if v["role"] == "output"]
    unknowns = [tag("Unknown", index=i) for i in outputs]
    time = tag("ScalarVariable", [tag("Real", unit="s")], name="time",
               valueReference=0, description="time", causality="independent",
               variability="continuous")
    return document(tag(
        "fmiModelDescription",
        [tag("CoSimulation",
             [tag("SourceFiles", [tag("File", name=n) for n in sources])],
             modelIdentifier=MODEL,
             canHandleVariableCommunicationStepSize="true",
             canNotUseMemoryManagementFunctions="true",
             canGetAndSetFMUstate="true", canSerializeFMUstate="true"),
         unit_definitions(model), tag("TypeDefinitions", types),
         log_categories(), experiment(model),
         tag("ModelVariables",
             [time, *(variable2(v) for v in model["variables"])]),
         tag("ModelStructure", [tag("Outputs", unknowns),
                                tag("InitialUnknowns", unknowns)])],
        fmiVersion="2.0", guid=token, **common(model)))


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
