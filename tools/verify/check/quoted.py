#!/usr/bin/python3
"""Decimals and percentages that docs/FINDINGS.md quotes stand in the page that
its section or row names, rounded to as many digits, as they are or in per cent.
A row whose command is another than that of the page may quote what this prints
as well, and is not judged. That a number stands in a page does not show that it
is there for what is claimed: this finds pages that were made again and are
quoted as they were before."""
import re

from findings import ROOT, checked, wrong

OTHER = re.compile(r"`(twofold|make|tools|tests)\b")
PAGES = "statistics.md", "FINER.md", "RECURRENCE.md"
QUOTED = re.compile(r"(?<![\w.])(?:\d+\.\d+(?:e-?\d+)?(?![\d.]*\w)|"
                    r"\d+(?= %))")
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")


def numbers_of(text):
    """The sizes of all numbers of a page, and what they are in per cent."""
    found = {abs(float(word)) for word in NUMBER.findall(text)}
    return found | {100 * x for x in found}


def is_in(word, numbers):
    """Whether one of them is this number, rounded to its digits."""
    digits = len(word.split("e")[0].partition(".")[2])
    shape = f"{{:.{digits}{'e' if 'e' in word else 'f'}}}"
    value = float(word)
    return any(float(shape.format(x)) == value for x in numbers)


def claims_of(text):
    """(page, what is claimed) of the rows and paragraphs of the findings."""
    for section in re.split(r"^## ", text, flags=re.M)[1:]:
        whole, page = None, None
        named = re.search(r"Numbers\s+of\s+\[(.*?)\]", section)
        if named:
            whole = named[1]
        elif re.search(r"statistics\.md", section):
            whole = "statistics.md"
        for line in section.splitlines():
            if not line.startswith("| ") or line.startswith("| claim"):
                continue
            cells = [cell.strip() for cell in
                     re.split(r"(?<!\\)\|", line)[1:-1]]
            if not cells[-1].startswith("the same"):
                named = [one for one in PAGES if one in cells[-1]]
                page = named[0] if named else whole
            if page and not OTHER.search(cells[-1]):
                yield page, " ".join(re.sub(r"`[^`]*`", "", cell)
                                     for cell in cells)


def main():
    text = (ROOT / "docs/FINDINGS.md").read_text(encoding="utf-8")
    if not is_in("0.0040", {0.00398}) or is_in("0.0045", {0.00398}) or \
            not is_in("8.2", numbers_of("0.0823")) or \
            not is_in("1.0e-20", {1.02e-20}) or is_in("7.5", {75}):
        wrong("planted numbers are not judged right")
    numbers = {page: numbers_of((ROOT / "docs" / page).read_text("utf-8"))
               for page in PAGES}
    count = 0
    for page, claim in claims_of(text):
        for word in QUOTED.findall(claim):
            count += 1
            if not is_in(word, numbers[page]):
                wrong(f"docs/FINDINGS.md quotes {word}, which docs/{page} does "
                      f"not have: {claim[:60]}...")
    if count < 100:
        wrong(f"only {count} numbers are quoted")
    checked(f"{count} numbers of docs/FINDINGS.md stand in {len(PAGES)} pages")


main()
