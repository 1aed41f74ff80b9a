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
from tap import ROOT, TWOFOLD, Skip, call, check, main, same  # noqa: E402

COMMANDS = re.findall(r"^  ([a-z]+) .*", call("help")[0], re.M)
PAGES = "".join(call("help", name)[0] for name in ["help", *COMMANDS])
OPTIONS = set(re.findall(r'"(--[a-z][a-z0-9-]*)", [N"]',
                         (ROOT / "tools/cli/table.c").read_text()))
PARAMETERS = re.findall(r"^  ([a-z0-9]+) +\[",
                        PAGES[PAGES.index("names of --set"):], re.M)


def offered(*words):
    """{word: what it is} of what may stand behind words."""
    lines = call("complete", *words, code=(0, 2))[0].splitlines()
    return dict(line.split("\t") for line in lines)


def header(*words):
    return call(*words)[0].partition("\n")[0].split(",")


def members(*words):
    """The names in the JSON that a command prints."""
    return set(re.findall('"([^"]*)":', "".join(call(*words))))


def first_words(text):
    return {line.split()[0] for line in text.splitlines() if line[:1] > "#"}


def test_words():
    for few, all_of in ((8, COMMANDS), (50, OPTIONS), (24, PARAMETERS)):
        check(len(all_of) > few, f"too few were found: {all_of}")
    call("run", "chaos", "--t-end", "0.01", "--format", "frames", "--out",
         "frames")
    laws = re.search("^  law +(.*)$", PAGES, re.M)[1].split(", ")
    check(len(laws) > 5, laws)
    text = call("help", "law")[0]
    for law in laws:
        check(re.search(f"^  {law}  *[a-z]", text, re.M), f"help law: {law}")
    words = {*PARAMETERS, *OPTIONS, *laws, *header("run", "chaos", "--t-end=0"),
             *first_words(call("scenes")[0]),
             *first_words(call("scene", "driven")[0]),
             *header("regions", "chaos", "--r", "0:1:2", "--omega=0:1:2"),
             *re.findall(r"^  (\S+)", PAGES.partition("\noutcomes:\n")[2]
                         .partition("\nusage")[0], re.M)}
    words |= members("singularities", "chaos") - {
        "count", "two_folds", "rest", "directions", "eigenvalue", "velocity",
        "sticks", "singular_rest"}
    summary = "--summary", "json"
    words |= members("run", "driven", "--t-end", "0.1", *summary, "--out",
                     "rows", "--save", "at")
    words |= members("sweep", "chaos", "--over", "mu=1:1:1", *summary, "--out",
                     "rows")
    words |= members("diverge", "chaos", "--samples", "1", *summary,
                     "--returns", "rows")
    words |= members("monitor", "frames", *summary)
    said = call("run", "chaos", "--t-end", "3")[1]
    said = re.sub("^twofold: .*", "", said, flags=re.M)  # notes and progress
    words |= set(re.findall("[a-z_]{4,}", said)) - {
        "more", "most", "output", "real", "several", "first", "after",
        "reached", "fold", "changes"}
    words |= set("slip+ slip- stick+ stick- pinned law rest persist random "
                 "hull square bow_tie moreau located compensated csv frames "
                 "json plotter teleplot done flagged stopped refused bench "
                 "stability page fmu firmware version exit inputs summary "
                 "provenance profile based-on".split())
    for word in sorted(words):
        out = call("help", word)[0]
        check(out and "(null)" not in out, f"help {word}: {out}")


def test_what_help_says():
    for word, text in (("slip-", "--select RULE of"),
                       ("chaos", "'twofold scene chaos' prints it")):
        check(text in call("help", word)[0], f"help {word} lacks: {text}")
    for words, text in ((["kapa"], "no help on 'kapa'; did you mean 'kappa'?"),
                        (["xyzzy1234"], "no help on 'xyzzy1234'; try"),
                        (["run", "chaos"], "help: one word at a time")):
        check(text in call("help", *words, code=2)[1], text)


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
    """Any other word is refused, and they are told; --send, whose words have
    payloads, names the help."""
    count = 0
    for name in COMMANDS:
        for option in offered(name):
            values = list(offered(name, "chaos", option))
            if (option[:2] == "--" and option != "--send" and values and
                    not any(word[:2] == "--" for word in values)):
                said = call(name, "chaos", option, "xyzzy", code=2)[1]
                check(f"{option} xyzzy" in said and values[0] in said, said)
                count += 1
    check(count > 10, f"{count} options with words were found")


def completes(shell, start, ask):
    """What a shell offers behind words. The program is in the PATH."""
    if not shutil.which(shell):
        raise Skip(f"missing: {shell}")
    Path("script").write_text(call("completions", shell)[0])
    Path("bin").mkdir(exist_ok=True)
    Path("bin/twofold").unlink(missing_ok=True)
    Path("bin/twofold").symlink_to(TWOFOLD)
    for words, word in (("", "sweep"), ("run", "chaos"),
                        ("run chaos", "--scheme"),
                        ("run chaos --scheme", "located"),
                        ("completions", "fish"), ("monitor --send", "set:")):
        out = subprocess.run(
            [shell, "-c", f"{start}; {ask(words)}"], check=True, text=True,
            env={**os.environ, "PATH": f"bin:{os.environ['PATH']}"},
            capture_output=True).stdout
        check(re.search(rf"^{re.escape(word)}(\t|:|$)",
                        out.replace("\\:", ":"), re.M), f"{word}: {out}")


def test_bash():
    completes("bash", "compopt() { :; }; . ./script", lambda words: (
        f'COMP_WORDS=(twofold {words} ""); '
        "COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _twofold; "
        "printf '%s\\n' \"${COMPREPLY[@]}\""))


def test_fish():
    completes("fish", "source ./script", lambda words: (
        f'complete -C "{" ".join(["twofold", *words.split()])} "'))


def test_zsh():
    completes("zsh", "_describe() { print -l -- ${(P)2}; }; _files() { :; }; "
              "compdef() { :; }; . ./script", lambda words: (
                  f"words=(twofold {words} ''); CURRENT=$#words; _twofold"))


def test_another_shell():
    same(call("completions", "tcsh", code=2)[1], "twofold: completions: of "
         "which shell? (bash zsh fish)\n")


main(globals(), jobs=2)
