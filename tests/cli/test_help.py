#!/usr/bin/python3 -B
"""There is help on every word that the command line itself uses: parameters,
columns, modes, laws, rules, schemes, formats, options, keys, scenes. Its
options are of one table (tools/cli/table.c), from which come the reading of
command lines, help, manual page, suggestions and completions: an option of any
command is in all of them."""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from tap import ROOT, TWOFOLD, Skip, call, check, main  # noqa: E402

COMMANDS = re.findall(r"^  ([a-z]+) .*", call("help")[0], re.M)
PAGES = "".join(call("help", name)[0] for name in ["help", *COMMANDS])
OPTIONS = set(re.findall(r'"(--[a-z][a-z0-9-]*)", [N"]',
                         (ROOT / "tools/cli/table.c").read_text()))


def offered(*words):
    """{word: what it is} of what may stand behind words."""
    lines = call("complete", *words, code=(0, 2))[0].splitlines()
    return dict(line.split("\t") for line in lines)


def values_of_options():
    """Yields (command, option, values that the option takes)."""
    for name in COMMANDS:
        for option in offered(name):
            values = list(offered(name, "chaos", option))
            if (option[:2] == "--" and values and
                    not any(word[:2] == "--" for word in values)):
                yield name, option, values


def header(*words):
    return call(*words)[0].partition("\n")[0].split(",")


def members(*words):
    """The names in the JSON that a command prints."""
    return set(re.findall('"([^"]*)":', "".join(call(*words))))


def first_words(text):
    return {line.split()[0] for line in text.splitlines() if line[:1] > "#"}


def test_words():
    call("run", "chaos", "--t-end", "0.01", "--format", "frames", "--out",
         "frames")
    said = call("run", "chaos", "--set", "law=xyzzy", code=2)[1]
    laws = re.findall("[a-z_]+", said.partition("laws are ")[2])
    laws.remove("and")
    check(f"  law       {', '.join(laws)}\n" in PAGES, "laws in help run")
    for law in laws:
        check(f"\n  {law} " in call("help", "law")[0], f"help law: {law}")
    ranges = PAGES[PAGES.index("names of --set"):]
    json = "--summary", "json"
    for words in (
            re.findall(r"^  ([a-z0-9]+) +\[", ranges, re.M), OPTIONS, laws,
            re.findall(r"^  (\S+)", PAGES.partition("\noutcomes:\n")[2]
                       .partition("\nusage")[0], re.M),
            {word for _, option, words in values_of_options()
             for word in words if option != "--send"},
            "slip+ slip- stick+ stick- pinned done flagged stopped refused "
            "bench exit inputs provenance based-on".split(),
            header("run", "chaos", "--t-end=0"),
            header("regions", "chaos", "--r", "0:1:2", "--omega=0:1:2"),
            first_words(call("scenes")[0]),
            first_words(call("scene", "driven")[0]),
            members("singularities", "chaos") - {
                "count", "two_folds", "rest", "directions", "eigenvalue",
                "velocity", "sticks", "singular_rest"},
            members("run", "driven", "--t-end=1", *json, "--save", "at"),
            members("sweep", "chaos", "--over", "mu=1:1:1", *json),
            members("diverge", "chaos", "--samples", "1", *json),
            members("monitor", "frames", *json),
            re.findall("^[a-z_]{4,}", call("run", "chaos", "--t-end=3")[1],
                       re.M)):
        check(len(words) > 2, f"too few were found: {words}")
        for word in {*words} - {"twofold", "real"}:
            out = call("help", word)[0]
            check(out and "(null)" not in out, f"help {word}: {out}")


def test_what_help_says():
    for words, text, code in (
            ("help slip-", "--select RULE of", 0),
            ("help chaos", "'twofold scene chaos' prints it", 0),
            ("help kapa", "no help on 'kapa'; did you mean 'kappa'?", 2),
            ("help xyzzy1234", "no help on 'xyzzy1234'; try", 2),
            ("help run chaos", "help: one word at a time", 2),
            ("completions tcsh", "of which shell? (bash zsh fish)\n", 2)):
        check(text in "".join(call(*words.split(), code=code)), text)


def test_an_option_is_everywhere():
    manual = subprocess.run([ROOT / "tools/package/dist/manual", TWOFOLD, "1"],
                            check=True, capture_output=True, text=True)
    completed = {word for name in COMMANDS for word in offered(name)}
    for option in OPTIONS:
        form = f"(?<![a-z-]){option}(?![a-z-])"
        check(re.search(form, PAGES) and option in completed and
              re.search(form, manual.stdout.replace("\\-", "-")), option)
    for name in COMMANDS:
        of_it = [word for word in offered(name) if word.startswith("--")]
        if of_it:
            said = call(name, of_it[-1] + "q", code=2)[1]
            check(f"did you mean '{of_it[-1]}" in said, said)


def test_words_of_a_value():
    """Any other word is refused, with the words that are known; --send, whose
    words have payloads, names the help."""
    for name, option, values in values_of_options():
        if option != "--send":
            said = call(name, "chaos", option, "xyzzy", code=2)[1]
            check(f"{option} xyzzy" in said and values[0] in said, said)


# What prepares a shell, and how it prints what it offers behind words.
SHELLS = {
    "bash": ("compopt() { :; }; . ./script", lambda words: (
        f'COMP_WORDS=(twofold {words} ""); '
        "COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _twofold; "
        "printf '%s\\n' \"${COMPREPLY[@]}\"")),
    "fish": ("source ./script", lambda words: (
        f'complete -C "{" ".join(["twofold", *words.split()])} "')),
    "zsh": ("_describe() { print -l -- ${(P)2}; }; _files() { :; }; "
            "compdef() { :; }; . ./script", lambda words: (
                f"words=(twofold {words} ''); CURRENT=$#words; _twofold"))}


def test_completions():
    """Of each shell that is here, with the program in the PATH."""
    Path("bin").mkdir()
    Path("bin/twofold").symlink_to(TWOFOLD)
    for shell, (start, ask) in SHELLS.items():
        Path("script").write_text(call("completions", shell)[0])
        for words, word in (("", "sweep"), ("run", "chaos"),
                            ("run chaos", "--scheme"),
                            ("run chaos --scheme", "located"),
                            ("completions", "fish"),
                            ("monitor --send", "set:")):
            out = shutil.which(shell) and subprocess.run(
                [shell, "-c", f"{start}; {ask(words)}"], check=True, text=True,
                env={**os.environ, "PATH": f"bin:{os.environ['PATH']}"},
                capture_output=True).stdout.replace("\\:", ":")
            check(out is None or re.search(
                rf"^{re.escape(word)}(\t|:|$)", out, re.M), f"{word}: {out}")
    missing = [shell for shell in SHELLS if not shutil.which(shell)]
    if missing:
        raise Skip(f"missing: {missing}")


main(globals(), jobs=2)
