"""Bounds of loops, from clang's syntax tree (-ast-dump=json). The kind of each
is `constant`, `runtime` or `none`. A loop has a bound where its condition holds
only while some value is on one side of another, the value moves towards it by
at least one in every turn and in no other way, and the other stays what it is:
  for (i = a; i < n; i++)            while (n > 0) ... --n ...
  while (at < end) *at++ = ...       while (x < n && any condition)
  while (x < n) { if (s == 0) return; x += s; }          s unsigned
  while (x < n) { e = x; while (...) e++; x = e; x++; }
  while (*text != 0) text++          the length of a string
  for (; x > 1; x /= 10)             x real; *= for <
Branches that jump over the move (continue) are not allowed, nor moves inside a
condition. What the tool does not recognise is `none`, and the check fails.
"""
from typing import NamedTuple

LOOPS = ("ForStmt", "WhileStmt", "DoStmt")
WRAPPERS = ("ImplicitCastExpr", "ParenExpr", "CStyleCastExpr", "ConstantExpr")
SMALL = {"uint8_t": 255, "unsigned char": 255, "_Bool": 1}


class Bound(NamedTuple):
    """What a condition sets: `moves` goes to `limit`."""
    kind: str
    moves: str
    limit: str


def kids(node):
    return [c for c in node.get("inner", []) if c.get("kind")]


def bare(node):
    while node.get("kind") in WRAPPERS and kids(node):
        node = kids(node)[0]
    return node


def walk(node):
    yield node
    for child in node.get("inner", []):
        yield from walk(child)


def text(node):
    """A canonical text of an expression; None where it has calls."""
    node = bare(node)
    kind = node.get("kind")
    parts = [text(c) for c in kids(node)]
    if None in parts or kind in ("CallExpr", "StmtExpr"):
        return None
    if kind == "DeclRefExpr":
        return node["referencedDecl"]["name"]
    if kind in ("IntegerLiteral", "FloatingLiteral", "CharacterLiteral"):
        return str(node["value"])
    if kind == "MemberExpr":
        return parts[0] + ("->" if node.get("isArrow") else ".") + node["name"]
    if kind == "UnaryExprOrTypeTraitExpr":
        return "sizeof"
    if kind == "ArraySubscriptExpr":
        return f"{parts[0]}[{parts[1]}]"
    if kind in ("BinaryOperator", "CompoundAssignOperator"):
        return f"({parts[0]} {node['opcode']} {parts[1]})"
    if kind == "UnaryOperator":
        return node["opcode"] + parts[0]
    return kind + "".join(parts)


def constant(node):
    """Whether an expression is known where it compiles."""
    return all(n.get("kind") in WRAPPERS + (
        "IntegerLiteral", "FloatingLiteral", "CharacterLiteral",
        "UnaryExprOrTypeTraitExpr", "BinaryOperator", "UnaryOperator") or
        (n.get("kind") == "DeclRefExpr" and
         n["referencedDecl"]["kind"] == "EnumConstantDecl")
        for n in walk(node) if n.get("kind", "").endswith(
            ("Expr", "Literal", "Operator")))


def value(node):
    """A whole constant, or None."""
    node = bare(node)
    kind, parts = node.get("kind"), kids(node)
    if kind in ("IntegerLiteral", "CharacterLiteral"):
        return int(node["value"])
    numbers = [value(p) for p in parts]
    if None in numbers or not numbers:
        return None
    if kind == "UnaryOperator" and node["opcode"] == "-":
        return -numbers[0]
    if kind == "BinaryOperator" and node["opcode"] in "+-*":
        a, b = numbers
        return {"+": a + b, "-": a - b, "*": a * b}[node["opcode"]]
    return None


def writes(node):
    """(target, opcode, amount, node) of everything that is assigned in it."""
    for n in walk(node):
        if n.get("kind") == "UnaryOperator" and n["opcode"] in ("++", "--"):
            yield text(kids(n)[0]), n["opcode"], None, n
        elif n.get("kind") == "CompoundAssignOperator" or (
                n.get("kind") == "BinaryOperator" and n.get("opcode") == "="):
            yield text(kids(n)[0]), n["opcode"], kids(n)[1], n
        elif n.get("kind") == "UnaryOperator" and n["opcode"] == "&":
            yield text(kids(n)[0]), "&", None, n


def always(node, target):
    """Whether every turn through node comes by target."""
    if node is target:
        return True
    kind, parts = node.get("kind"), kids(node)
    if kind in ("IfStmt", "SwitchStmt", "ConditionalOperator"):
        return any(always(p, target) for p in parts[:1])
    if kind == "BinaryOperator" and node["opcode"] in ("&&", "||"):
        return always(parts[0], target)
    if kind in LOOPS:
        return False
    return any(always(p, target) for p in parts)


def guarded(body, step):
    """Whether `if (step == 0) return` or break stands in the body itself."""
    for n in kids(body):
        if n.get("kind") != "IfStmt":
            continue
        test, then = bare(kids(n)[0]), kids(n)[1]
        if (test.get("kind") == "BinaryOperator" and test["opcode"] == "=="
                and text(kids(test)[0]) == step
                and value(kids(test)[1]) == 0
                and then.get("kind") in ("ReturnStmt", "BreakStmt")):
            return True
    return False


def only_grows_from(body, name, start):
    """Whether local `name` begins as `start` in the body and only grows."""
    begun = any(n.get("kind") == "VarDecl" and n.get("name") == name
                and kids(n) and text(kids(n)[-1]) == start
                for n in walk(body))
    moves = [op for target, op, _, _ in writes(body) if target == name]
    return begun and all(op == "++" for op in moves)


def moves_on(body, step, name, up):
    """Whether every turn moves `name` by one or more in the direction, and
    nothing else changes it."""
    moved = False
    for part in (body, step):
        for target, op, amount, node in writes(part) if part else ():
            if target != name:
                continue
            by = value(amount) if amount else None
            if op in ("++", "--"):
                good = (op == "++") == up
            elif op in ("+=", "-=") and by is not None:
                good = by != 0 and ((op == "+=") == (by > 0)) == up
            elif op == "+=" and up and guarded(body, text(amount)):
                good = "unsigned" in amount_type(amount) or \
                    "uint" in amount_type(amount)
            elif op == "=" and up and text(amount) and \
                    only_grows_from(body, text(amount), name):
                continue  # not back, but perhaps not on
            else:
                good = False
            if not good:
                return False
            moved = moved or always(part, node)
    return moved


def scales_on(body, step, name, up):
    """Whether every turn multiplies or divides `name` by 2 or more towards the
    limit, and nothing else changes it: a real > 0 gets there."""
    writing = [w for part in (body, step) if part for w in writes(part)
               if w[0] == name]
    if len(writing) != 1:
        return False
    _, op, amount, node = writing[0]
    by = value(amount) if amount else None
    return (op == ("*=" if up else "/=") and by is not None and by >= 2 and
            any(always(part, node) for part in (body, step) if part))


LARGEST = {"unsigned char": 255, "uint8_t": 255, "signed char": 127,
           "int8_t": 127, "unsigned short": 65535, "uint16_t": 65535,
           "short": 32767, "int16_t": 32767, "int": 2**31 - 1,
           "unsigned int": 2**32 - 1, "uint32_t": 2**32 - 1}


def fits(var, op, number, up, body, step, name):
    """Whether the counter can pass a constant limit without wrapping round: a
    move from the last value that goes on stays in its type."""
    if number is None:
        return True  # a constant of its own type
    by = max(abs(value(amount) or 1) if amount else 1
             for part in (body, step) if part
             for target, _, amount, _ in writes(part) if target == name)
    kind = bare(var)["type"]
    kind = kind.get("desugaredQualType", kind["qualType"])
    kind = kind.replace("const ", "")
    largest = LARGEST.get(kind, 2**63 - 1)
    least = 0 if "unsigned" in kind or "uint" in kind or "size_t" in kind \
        else -largest - 1
    if up:
        return number - (op in ("<", ">")) + by <= largest
    return number + (op in ("<", ">")) - by >= least


def amount_type(node):
    kind = bare(node)
    return kind["type"].get("desugaredQualType", "") + kind["type"]["qualType"]


def skips(body):
    """Whether a turn may be cut short by a continue of this loop."""
    def look(n):
        if n.get("kind") == "ContinueStmt":
            return True
        return n.get("kind") not in LOOPS and any(look(c) for c in kids(n))
    return any(look(c) for c in kids(body)) or body.get("kind") == \
        "ContinueStmt"


def offset_of(node):
    """`x + 1` counts as x."""
    node = bare(node)
    if node.get("kind") == "BinaryOperator" and node["opcode"] in "+-" and \
            value(kids(node)[1]) is not None:
        return kids(node)[0]
    return node


def bound_of(test, body, step):
    """The bound that a condition sets, or None."""
    test = bare(test)
    if test.get("kind") != "BinaryOperator":
        return None
    left, right = kids(test)
    op = test["opcode"]
    if op == "&&":
        both = [b for b in (bound_of(left, body, step),
                            bound_of(right, body, step)) if b]
        # The end of a string is the weaker of two.
        both.sort(key=lambda b: "the end of" in b.limit)
        return both[0] if both else None
    if op == "||":
        a, b = bound_of(left, body, step), bound_of(right, body, step)
        if not (a and b):
            return None
        # Every turn begins with the first of them.
        return a._replace(
            kind="constant" if a.kind == b.kind == "constant" else "runtime",
            limit=f"{a.limit} or {b.limit}")
    if op == "!=" and value(right) == 0 and (text(left) or "")[:1] == "*":
        name = text(left)[1:]
        if not skips(body) and moves_on(body, step, name, True):
            return Bound("runtime", name, "the end of the string " + name)
        return None
    if op not in ("<", "<=", ">", ">="):
        return None
    for var, limit, up in ((left, right, op[0] == "<"),
                           (right, left, op[0] == ">")):
        found = bound_by(var, limit, up, op, (body, step))
        if found:
            return found
    return None


def bound_by(var, limit, up, op, parts):
    """The bound that a comparison sets if `var` moves towards `limit`."""
    body, step = parts
    name = text(offset_of(var))
    if name is None or value(var) is not None or text(limit) is None:
        return None
    if "double" in amount_type(var) or "float" in amount_type(var):
        if constant(limit) and not skips(body) and \
                scales_on(body, step, name, up):
            return Bound("runtime", name, text(limit))
        return None
    names = {text(n) for n in walk(limit)
             if n.get("kind") in ("DeclRefExpr", "MemberExpr")}
    changed = {t for part in (body, step) if part
               for t, _, _, _ in writes(part)}
    if names & changed or not moves_on(body, step, name, up):
        return None
    if skips(body) and not any(
            t == name for t, _, _, _ in (writes(step) if step else ())):
        return None
    if constant(limit):
        number = value(limit)
        if not fits(var, op, number, up, body, step, name):
            return None
        return Bound("constant", name,
                     text(limit) if number is None else str(number))
    small = SMALL.get(bare(limit)["type"]["qualType"].replace("const ", ""))
    calls = any(n.get("kind") == "CallExpr" for n in walk(body))
    if calls and bare(limit)["kind"] == "MemberExpr" and not small:
        return None  # what is called may move it
    return Bound("runtime", name, text(limit))


def judge(loop):
    """(kind, the bound as text)."""
    if loop["kind"] == "ForStmt":
        parts = loop["inner"]  # init, variable, condition, step, body
        test, step, body = parts[2], parts[3] or None, parts[4]
        if step is not None and not step.get("kind"):
            step = None
    elif loop["kind"] == "WhileStmt":
        test, body, step = kids(loop)[0], kids(loop)[-1], None
    else:
        body, test, step = kids(loop)[0], kids(loop)[-1], None
    if not test.get("kind"):
        return "none", "no condition"
    if body.get("kind") != "CompoundStmt":
        body = {"kind": "CompoundStmt", "inner": [body]}
    # A move in the condition would not be made in every turn.
    if any(True for _ in writes(test)):
        return "none", "the condition writes"
    bound = bound_of(test, body, step)
    if not bound:
        return "none", "no bound"
    begin = begun_at(loop, bound.moves)
    if begin is not None:
        return bound.kind, f"{bound.moves} from {begin} to {bound.limit}"
    return "runtime", f"{bound.moves} to {bound.limit}"


def begun_at(loop, name):
    """The constant that the loop itself begins `name` with, or None."""
    if loop["kind"] != "ForStmt":
        return None
    for n in walk(loop["inner"][0]):
        if n.get("kind") == "VarDecl" and n.get("name") == name and kids(n) \
                and constant(kids(n)[-1]):
            return text(kids(n)[-1])
    return None
