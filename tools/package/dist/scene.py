#!/usr/bin/python3
"""Makes the header of one prepared scene: its constants in both real types, and
of the core what a step of it calls.

usage: scene.py SCENE DOUBLE FLOAT FOLDER
DOUBLE, FLOAT: the programs `constants` of tools/board/constants.
"""
import re
import subprocess
import sys
import textwrap
from pathlib import Path

from sources import COMPILERS, ROOT, Text, preface, sources_of

CALLED = ("tf_step", "tf_scene_input", "tf_mode_name")

DECLARATIONS = """\
#ifdef __cplusplus
extern "C" {
#endif

/// Puts the scene at its start.
/// state, report: out, of tick 0.
#define tf_@scene@_begin TF_LINK(tf_@scene@_begin)
void tf_@scene@_begin(tf_state_t *state, tf_report_t *report);

/// The inputs of the next step.
/// state: in.
#define tf_@scene@_input TF_LINK(tf_@scene@_input)
tf_input_t tf_@scene@_input(const tf_state_t *state);

/// One step of the scene, the bits of tf_step.
/// state: in/out, from tf_@scene@_begin.
/// input: in, of tf_@scene@_input or altered; within TF_STATE_LIMIT together
///   with the state.
/// report: out.
/// Returns: as tf_step.
#define tf_@scene@_step TF_LINK(tf_@scene@_step)
tf_status_t tf_@scene@_step(tf_state_t *state, const tf_input_t *input,
    tf_report_t *report);

/// Name of a mode, as on the command line; "unknown" for other values.
#define tf_@scene@_mode_name TF_LINK(tf_@scene@_mode_name)
const char *tf_@scene@_mode_name(unsigned mode);

#ifdef __cplusplus
}
#endif

"""

DEFINITIONS = """\
void tf_@scene@_begin(tf_state_t *state, tf_report_t *report) {
  *state = scene_start;
  *report = scene_start_report;
}

tf_input_t tf_@scene@_input(const tf_state_t *state) {
  return tf_scene_input(&scene_constants, &scene_machine, state->tick + 1);
}

tf_status_t tf_@scene@_step(tf_state_t *state, const tf_input_t *input,
    tf_report_t *report) {
  return tf_step(&scene_machine, state, input, report);
}

const char *tf_@scene@_mode_name(unsigned mode) { return tf_mode_name(mode); }

"""

# Of the code all is local to the file that holds it.
LOCAL = """\
#define TF_API static __attribute__((unused))

"""
# Where size is asked for, the parts of a step stay functions: half the size.
SMALL = """\
#ifdef __OPTIMIZE_SIZE__
#undef TF_INLINE
#define TF_INLINE static
#endif

"""

# What the code asks of the compiler's arithmetic ends with it: behind it stands
# the user's. Clang has no other stack for contraction, and on some targets not
# this one.
KEEP = """\
#ifdef __clang__
#pragma clang diagnostic ignored "-Wignored-pragmas"
#pragma float_control(push)
#elif defined(__GNUC__)
#pragma GCC push_options
#endif
"""
# The code of another scene, behind this one, has its own.
RESTORE = """\
#undef TF_ROUNDING_H
#ifdef __clang__
#pragma float_control(pop)
#elif defined(__GNUC__)
#pragma GCC pop_options
#endif
"""

# What the code defines for its whole file: macros, functions, tables, types,
# enumerators.
DEFINED = (
    r"^#define (\w+)",
    r"^(?!typedef)(?:[A-Za-z_].*?\W)??(?!__)(\w+)\(",
    r"^(?:static|TF_API) const [^=({;]*?(\w+)(?:\[\w*\])*\s=",
    r"^typedef .*?(\w+);", r"^\} (\w+);", r"^(?:struct|union|enum) (\w+) \{",
    r"^typedef \w+ \*?\(\*(\w+)\)")
# Of a public header, what is another one for a scene.
SET_VALUED = "tf_tyre_is_set_valued"
# A word, and whether it is a member; comments and strings are one piece.
WORD = re.compile(r'//.*|"[^"\n]*"|(->|\.|\b)([A-Za-z_]\w*)')


def names_in(code):
    """Of what the code defines, without comments."""
    code = re.sub(r"//.*", "", code)
    found = {name for pattern in DEFINED
             for name in re.findall(pattern, code, re.M)}
    for body in re.findall(r"\benum(?: \w+)? \{([^}]*)\}", code):
        found |= set(re.findall(r"(\w+)[^,]*", body))
    return found


def of_scene(scene, headers, code):
    """The code with the name of the scene before all that it defines, so that
    the code of several scenes can stand in one file. Members that the public
    headers know keep their names."""
    own = {SET_VALUED} | {name for name in names_in(code)
                          if not name.startswith(f"tf_{scene}_")}
    public = set(re.findall(r"\w+", re.sub(r"//.*", "", headers)))

    def named(word):
        member, name = word.groups()
        kept = name not in own or member and name in public
        return word[0] if kept else f"{member}{scene}_{name}"
    return WORD.sub(named, code)


def prototypes(headers, code):
    """Of the functions of public headers that the code defines."""
    defined, text = names_in(code), re.sub(r"//.*", "", headers)
    return "".join(
        declared + "\n" for declared, name in re.findall(
            r"^(TF_API [^;(]*?(\w+)\([^;]*;)", text, re.M) if name in defined)


def constants(program, scene):
    """What `constants` prints, in lines of 80 columns."""
    said = subprocess.run([program, scene], check=True, text=True,
                          stdout=subprocess.PIPE).stdout
    found = re.findall(r"^(static const [^=]* =) \{\s*(.*?;)$", said,
                       re.M | re.S)
    return "".join(f"{head}\n" + textwrap.fill(
        "{" + re.sub(r"\s+", " ", members), 80, break_on_hyphens=False,
        initial_indent="    ", subsequent_indent="     ") + "\n"
        for head, members in found)


def law_of(scene, text):
    """Whether the law of the machine is set-valued, for the preprocessor: a
    linker that optimises a program as a whole (Arduino's) keeps functions that
    only the steps under other laws call."""
    law = re.search(r"\(tf_tyre_law_t\)\d+", text)[0]
    return (f"#define {scene}_{SET_VALUED}(law) \\\n"
            f"  ((void)(law), {SET_VALUED}({law}))\n\n")


def guard(name, text):
    """A text that is read once."""
    return f"#ifndef {name}\n#define {name}\n\n{text}#endif\n\n"


def make(scene, double, single):
    """The text of the header."""
    whole = Text()
    upper = scene.upper()
    code = f"TWOFOLD_{upper}_CODE"
    whole.add(preface(f"""scene {scene}, prepared
//
// The machine is constant, so that the compiler drops what it does not need:
//
//   tf_state_t x;
//   tf_report_t report;
//   tf_{scene}_begin(&x, &report);
//   for (;;) {{
//     tf_input_t u = tf_{scene}_input(&x);
//     if (tf_{scene}_step(&x, &u, &report) < 0) break;
//   }}
//
// One source file of a program, in C99, defines {code} before it
// includes this header, and so holds the code; it may hold that of other scenes
// too. TF_REAL_FLOAT selects float.
""".rstrip()))
    first = Text()
    first.add_file(ROOT / "src/num/rounding.h")
    whole.add(f"#ifdef {code}\n{KEEP}{COMPILERS}"
              '#pragma GCC diagnostic ignored "-Wunused-function"\n\n'
              + "".join(first.parts) + "#endif\n\n")
    types = Text()
    types.add_file(ROOT / "include/twofold/step.h")
    types.add_file(ROOT / "include/twofold/simulation.h")
    types.add(DECLARATIONS.replace("@scene@", scene))
    whole.add(guard(f"TWOFOLD_{upper}_H", "".join(types.parts)))

    there = types.there | first.there
    body = Text(without=there)
    in_float = constants(single, scene)
    body.add("#ifdef TF_REAL_FLOAT\n" + in_float
             + "#else\n" + constants(double, scene) + "#endif\n"
             "#define TF_STEP_MACHINE(c) ((void)(c), &scene_machine)\n"
             + LOCAL)
    core = Text(without=there)
    for path in sources_of(CALLED):
        core.add_file(path, {"src/num/kernel.h": SMALL})
    core.add(DEFINITIONS.replace("@scene@", scene))
    headers, text = "".join(types.parts), "".join(core.parts)
    body.add(prototypes(headers, text) + "\n" + text)
    all_of_it = (law_of(scene, in_float)
                 + of_scene(scene, headers, "".join(body.parts)))
    inner = guard(f"{code}_IS_HERE", all_of_it)
    whole.add(f"#ifdef {code}\n{inner}{RESTORE}#endif\n")
    return whole


def main():
    scene, double, single, folder = sys.argv[1:]
    make(scene, double, single).write(Path(folder, f"twofold_{scene}.h"))


main()
