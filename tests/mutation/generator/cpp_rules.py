# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a C++ source can be broken, and how: what libclang's tree of it offers to the rules.

Places where nothing can change, or nothing that a process could choose, are counted under their reason in LEFT_OUT.
"""

import collections
import re

from clang import cindex

from pieces import ON, Mutant, choice

Kind = cindex.CursorKind
Type = cindex.TypeKind

# Reason -> why no mutant is made there. The manual (docs/generated-mutants.md) shows this table.
LEFT_OUT = {
    "neutral": "dropping + 0 or * 1 leaves the value",
    "same text": "swapping two arguments that say the same changes nothing",
    "commutes": "min, max, hypot and swap do not care for the order of their arguments",
    "boundary of floats": "< for <= between two computed numbers differs on equality alone; they are turned round instead",
    "capacity": "reserve and shrink_to_fit change no value",
    "fixed in compilation": "template arguments, array bounds, case labels, static_assert, if constexpr, constexpr members:"
    " a process cannot choose them, so that they would each need a build of their own",
}

INTEGERS = {Type.CHAR_S, Type.CHAR_U, Type.SCHAR, Type.UCHAR, Type.SHORT, Type.USHORT, Type.INT, Type.UINT, Type.LONG,
            Type.ULONG, Type.LONGLONG, Type.ULONGLONG}
FLOATS = {Type.FLOAT, Type.DOUBLE, Type.LONGDOUBLE}
FUNCTIONS = {Kind.FUNCTION_DECL, Kind.CXX_METHOD, Kind.CONSTRUCTOR, Kind.FUNCTION_TEMPLATE, Kind.CONVERSION_FUNCTION,
             Kind.DESTRUCTOR}
LOOPS_AND_IF = {Kind.IF_STMT, Kind.FOR_STMT, Kind.WHILE_STMT, Kind.CXX_FOR_RANGE_STMT}
COMPARISONS = {"<": ("<=", ">"), "<=": ("<", ">="), ">": (">=", "<"), ">=": (">", "<="), "==": ("!=",), "!=": ("==",)}
COMMUTES = {"min", "max", "hypot", "swap", "minmax"}
EXPRESSION_STATEMENTS = {Kind.CALL_EXPR, Kind.BINARY_OPERATOR, Kind.COMPOUND_ASSIGNMENT_OPERATOR, Kind.UNEXPOSED_EXPR,
                         Kind.CXX_THROW_EXPR, Kind.UNARY_OPERATOR}
OPERATOR_TEXT = re.compile(r"(?://[^\n]*\n|\s)*(<=>|<<=|>>=|[-+*/%&|^]=|&&|\|\||[=!<>]=|<<|>>|[-+*/%<>=&|^])(?://[^\n]*\n|\s)*$")


def kind_of(type):
    """int, float, bool, unknown (it depends on a template's parameter) or other."""
    canonical = type.get_canonical()
    if canonical.kind in (Type.LVALUEREFERENCE, Type.RVALUEREFERENCE):
        canonical = canonical.get_pointee().get_canonical()
    if canonical.kind in INTEGERS:
        return "int"
    if canonical.kind in FLOATS:
        return "float"
    if canonical.kind == Type.BOOL:
        return "bool"
    if canonical.kind in (Type.DEPENDENT, Type.UNEXPOSED, Type.INVALID):
        return "unknown"
    return "other"


def is_bitfield(cursor):
    return cursor.kind == Kind.FIELD_DECL and cursor.is_bitfield()


def is_number(kind):
    return kind in ("int", "float")


class Places:
    """All mutants of one file that the rules know, by place: (start, end) -> mutants."""

    def __init__(self, file, source):
        self.file, self.source = file, source
        self.found = collections.defaultdict(list)
        self.left_out = collections.Counter()
        self.constant = False

    def read(self, unit, path):
        for cursor in unit.cursor.get_children():
            if cursor.location.file and cursor.location.file.name == path:
                self.visit(cursor)
        return self

    # What the rules share.

    def span(self, cursor):
        return cursor.extent.start.offset, cursor.extent.end.offset

    def text(self, cursor):
        start, end = self.span(cursor)
        return self.source[start:end]

    def add(self, span, rule, mutated, pieces=None):
        """One mutant; pieces unless the place is an expression of which both versions are of one type."""
        start, end = span
        if not start < end:
            return
        if self.source[start - 1] == "<" or re.match(r">(?!=)", self.source[end:end + 2]):
            self.left_out["fixed in compilation"] += 1
            return
        says = "".join(p if isinstance(p, str) else self.source[p[0]:p[1]] for p in mutated)
        if says == self.source[start:end]:
            self.left_out["same text"] += 1
            return
        if any(known.says == says for known in self.found[span]):
            return  # by an implicit conversion over the same text
        self.found[span].append(Mutant(self.file, start, end, rule, says, pieces or choice(mutated, [span]), mutated,
                                       self.constant, line=self.source.count("\n", 0, start) + 1))

    def operator_between(self, left, right):
        """The operator between two operands and its place."""
        start, end = self.span(left)[1], self.span(right)[0]
        match = OPERATOR_TEXT.match(self.source[start:end]) if start <= end else None
        # A right operand in parentheses begins at its parenthesis, but a left one may end before some.
        return match.group(1) if match else None

    # The walk.

    def visit(self, cursor, index=False):
        try:
            kind = cursor.kind
        except ValueError:  # of a newer language than these bindings
            return
        if kind in (Kind.STATIC_ASSERT, Kind.ENUM_DECL, Kind.TYPE_REF, Kind.TEMPLATE_REF, Kind.TYPE_ALIAS_DECL,
                    Kind.TEMPLATE_TYPE_PARAMETER, Kind.TEMPLATE_NON_TYPE_PARAMETER, Kind.STRING_LITERAL,
                    Kind.CXX_BASE_SPECIFIER):
            return
        children = list(cursor.get_children())
        if kind in FUNCTIONS:
            self.visit_function(cursor, children)
            return
        if kind in (Kind.VAR_DECL, Kind.FIELD_DECL, Kind.PARM_DECL):
            self.visit_variable(cursor, children)
            return
        visitor = {
            Kind.BINARY_OPERATOR: self.binary, Kind.COMPOUND_ASSIGNMENT_OPERATOR: self.compound,
            Kind.UNARY_OPERATOR: self.unary, Kind.FLOATING_LITERAL: self.floating,
            Kind.CXX_BOOL_LITERAL_EXPR: self.boolean, Kind.CALL_EXPR: self.call, Kind.INIT_LIST_EXPR: self.init_list,
            Kind.MEMBER_REF_EXPR: self.member, Kind.DECL_REF_EXPR: self.enumerator, Kind.IF_STMT: self.condition,
            Kind.CONDITIONAL_OPERATOR: self.condition, Kind.COMPOUND_STMT: self.statements,
        }.get(kind)
        if kind == Kind.INTEGER_LITERAL:
            self.integer(cursor, children, index)
        elif kind == Kind.ARRAY_SUBSCRIPT_EXPR and len(children) == 2:
            self.index(children[1])
            self.visit(children[0])
            self.visit(children[1], index=True)
            return
        elif visitor:
            visitor(cursor, children)
        if kind == Kind.DECL_REF_EXPR:
            return  # its children are template arguments
        if kind == Kind.MEMBER_REF_EXPR:
            children = [c for c in children[:1] if c.kind not in (Kind.TYPE_REF, Kind.TEMPLATE_REF)]
        if kind in LOOPS_AND_IF:
            self.statements(cursor, children[1:] if kind == Kind.IF_STMT else children[-1:])
        if kind == Kind.CASE_STMT:
            self.left_out["fixed in compilation"] += 1
            children = children[1:]
        if kind == Kind.IF_STMT and re.match(r"if\s+constexpr", self.text(cursor)):
            self.left_out["fixed in compilation"] += 1
            children = children[1:]
        indices = self.index_arguments(cursor) if kind == Kind.CALL_EXPR else set()
        for child in children:
            # Implicit conversions lie over what they convert.
            self.visit(child, index=(index and kind == Kind.UNEXPOSED_EXPR) or self.span(child) in indices)

    def visit_function(self, cursor, children):
        head_end = next((self.span(c)[0] for c in children if c.kind == Kind.COMPOUND_STMT), cursor.extent.end.offset)
        head = self.source[cursor.extent.start.offset:head_end]
        before, self.constant = self.constant, self.constant or re.search(r"\bconst(?:expr|eval)\b", head) is not None
        after = max([self.span(c)[1] for c in children if c.kind == Kind.PARM_DECL] + [cursor.location.offset])
        for child in children:
            if child.kind == Kind.COMPOUND_STMT:
                self.early_returns(cursor, child)
            # Other expressions are of types, but for what a constructor initialises with.
            if child.kind in (Kind.COMPOUND_STMT, Kind.PARM_DECL) or self.span(child)[0] > after:
                self.visit(child)
        self.constant = before

    def visit_variable(self, cursor, children):
        start = cursor.extent.start.offset
        name = cursor.location.offset
        head = self.source[start:name]
        if is_bitfield(cursor):
            return
        expressions = [c for c in children if self.span(c)[0] >= name and c.kind.is_expression()]
        if cursor.type.kind in (Type.CONSTANTARRAY, Type.DEPENDENTSIZEDARRAY) and "]" in self.source[name:]:
            bound = self.source.index("]", name)
            expressions = [c for c in expressions if self.span(c)[0] > bound]
        if "constexpr" not in head:
            # In a function that may be constant its variables may be as well, and a struct may be made where the compiler
            # evaluates it, with what its members begin with.
            before, self.constant = self.constant, self.constant or cursor.kind == Kind.FIELD_DECL
            for child in expressions:
                self.visit(child)
            self.constant = before
            return
        if cursor.semantic_parent.kind in (Kind.STRUCT_DECL, Kind.CLASS_DECL, Kind.CLASS_TEMPLATE) or self.constant:
            self.left_out["fixed in compilation"] += len(expressions)
            return
        # Made a constant of the process; where the compiler needs its value the mutant does not compile.
        mark = start + head.index("constexpr")
        local = cursor.semantic_parent.kind not in (Kind.NAMESPACE, Kind.TRANSLATION_UNIT)
        word = "static const" if local and "static" not in head else "const"
        inner = Places(self.file, self.source)
        for child in expressions:
            inner.visit(child)
        self.left_out += inner.left_out
        end = max((self.span(c)[1] for c in expressions), default=mark)
        for span, mutants in inner.found.items():
            for m in mutants:
                whole = [word, (mark + len("constexpr"), span[0]), *m.pieces, (span[1], end)]
                m.mutated = [(mark, span[0]), *m.mutated, (span[1], end)]
                m.start, m.end, m.pieces = mark, end, whole
                self.found[span].append(m)

    # Expressions.

    def binary(self, cursor, children):
        if len(children) != 2:
            return
        left, right = children
        operator = self.operator_between(left, right)
        if operator:
            self.operation(self.span(cursor), left, right, operator, kind_of(left.type), kind_of(right.type))

    def operation(self, span, left, right, operator, left_kind, right_kind):
        a, b = self.span(left), self.span(right)
        numbers = is_number(left_kind) and is_number(right_kind)

        def other(*operators):
            for o in operators:
                self.add(span, "operator", [(a[0], a[1]), f" {o} ", b])

        def without(kept, dropped, neutral, sign=""):
            if self.source[dropped[0]:dropped[1]].strip() in neutral:
                self.left_out["neutral"] += 1
            else:
                self.add(span, "dropped", ["-(", kept, ")"] if sign == "-" else [kept])

        if operator in ("+", "-"):
            if numbers:
                other("-" if operator == "+" else "+")
                without(a, b, ("0", "0.0"))
                without(b, a, ("0", "0.0"), "-" if operator == "-" else "")
            elif "unknown" in (left_kind, right_kind) or "other" in (left_kind, right_kind):
                if '"' in self.source[a[0]:b[1]]:
                    return  # words
                self.add(b, "sign", ["-(", b, ")"], ["(", ON, " ? -1.0 : 1.0) * (", b, ")"])
                self.add(b, "dropped", ["0.0 * (", b, ")"], ["(", ON, " ? 0.0 : 1.0) * (", b, ")"])
        elif operator in ("*", "/"):
            if numbers or "unknown" in (left_kind, right_kind):
                other("/" if operator == "*" else "*")
                without(a, b, ("1", "1.0"))
                if operator == "*":
                    without(b, a, ("1", "1.0"))
            elif left_kind == "float" and operator == "*":
                self.add(a, "dropped", ["1.0"])
            elif right_kind == "float":
                self.add(b, "dropped", ["1.0"])
        elif operator == "%" and numbers:
            without(a, b, ())
        elif operator in COMPARISONS:
            replacements = COMPARISONS[operator]
            literal = re.compile(r"-?[\d.]+(e-?\d+)?")
            if left_kind == right_kind == "float" and not any(
                    literal.fullmatch(self.source[s:e]) for s, e in (a, b)) and len(replacements) == 2:
                self.left_out["boundary of floats"] += 1
                replacements = replacements[1:]
            for o in replacements:
                self.add(span, "comparison", [a, f" {o} ", b])
        elif operator in ("&&", "||"):
            self.add(span, "operator", [a, " || " if operator == "&&" else " && ", b])
            self.add(span, "dropped", ["static_cast<bool>(", a, ")"])
            self.add(span, "dropped", ["static_cast<bool>(", b, ")"])
        elif operator in ("&", "|") and numbers:
            other("|" if operator == "&" else "&")

    def compound(self, cursor, children):
        if len(children) != 2:
            return
        operator = self.operator_between(*children)
        other = {"+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="}.get(operator)
        if other and "basic_string" not in children[0].type.get_canonical().spelling:
            self.add(self.span(cursor), "operator", [self.span(children[0]), f" {other} ", self.span(children[1])])

    def unary(self, cursor, children):
        if len(children) != 1:
            return
        span, operand = self.span(cursor), self.span(children[0])
        operator = self.source[span[0]]
        if operator == "-" and self.source[operand[0]:operand[1]] not in ("0", "0.0"):
            if is_number(kind_of(children[0].type)):
                self.add(span, "sign", [operand])
            else:
                self.add(span, "sign", [operand], ["((", ON, " ? 1.0 : -1.0) * (", operand, "))"])
        elif operator == "!":
            self.add(span, "lost !", ["static_cast<bool>(", operand, ")"])

    def integer(self, cursor, children, index=False):
        span = self.span(cursor)
        text = self.source[span[0]:span[1]]
        if not text[:1].isdigit():
            return
        if index:
            return  # the rule for indices stays within bounds
        self.add(span, "off by one", [text, " + 1"])
        if text != "0":
            self.add(span, "off by one", [text, " - 1"])

    def floating(self, cursor, children):
        span = self.span(cursor)
        text = self.source[span[0]:span[1]]
        if not re.match(r"[\d.]", text):
            return
        if float(re.sub(r"[flFL']", "", text) if not text.startswith("0x") else "1") == 0.0:
            self.add(span, "constant", ["1.0"])
            return
        self.add(span, "constant", ["2 * ", text])
        self.add(span, "constant", ["1.1 * ", text])

    def boolean(self, cursor, children):
        span = self.span(cursor)
        text = self.source[span[0]:span[1]]
        if text in ("true", "false"):
            self.add(span, "constant", ["false" if text == "true" else "true"])

    def enumerator(self, cursor, children):
        declared = cursor.referenced
        if declared is None or declared.kind != Kind.ENUM_CONSTANT_DECL:
            return
        span, name = self.span(cursor), declared.spelling
        if not self.source[span[0]:span[1]].endswith(name):
            return
        names = [c.spelling for c in declared.semantic_parent.get_children() if c.kind == Kind.ENUM_CONSTANT_DECL]
        if len(names) > 1:
            other = names[(names.index(name) + 1) % len(names)]
            self.add(span, "constant", [(span[0], span[1] - len(name)), other])

    def member(self, cursor, children):
        field = cursor.referenced
        if field is None or field.kind != Kind.FIELD_DECL or field.is_bitfield():
            return
        span, name = self.span(cursor), field.spelling
        if not name or not self.source[span[0]:span[1]].endswith(name):
            return
        spelling = field.type.get_canonical().spelling
        names = [c.spelling for c in field.semantic_parent.get_children()
                 if c.kind == Kind.FIELD_DECL and c.type.get_canonical().spelling == spelling]
        if name not in names:
            return  # of a template's instance
        at = names.index(name)
        for other in dict.fromkeys([names[(at + 1) % len(names)], names[at - 1]]):
            if other != name:
                self.add(span, "member", [(span[0], span[1] - len(name)), other])

    def condition(self, cursor, children):
        if not children or not children[0].kind.is_expression() or re.match(r"if\s+constexpr", self.text(cursor)):
            return
        span = self.span(children[0])
        if self.source[span[0]] == "!":
            return  # that is the lost !
        self.add(span, "condition", ["!(", span, ")"], ["(static_cast<bool>(", span, ") != ", ON, ")"])

    def index(self, cursor):
        span = self.span(cursor)
        if kind_of(cursor.type) == "int" and not re.search(r"\+\+|--|[^=<>!]=[^=]", self.source[span[0]:span[1]]):
            self.add(span, "index", ["beside(", span, ")"],
                     ["(", ON, " ? ::mutation::beside(", span, ") : (", span, "))"])

    def index_arguments(self, call):
        """Places of what is an index among a call's arguments."""
        if call.spelling not in ("operator[]", "operator()"):
            return set()
        arguments = list(call.get_arguments())[1:]
        for one in arguments:
            if kind_of(one.type) == "int":
                self.index(one)
        return {self.span(one) for one in arguments}

    def call(self, cursor, children):
        name = cursor.spelling
        arguments = [a for a in cursor.get_arguments() if a is not None and a.extent.start.offset < a.extent.end.offset]
        if re.match(r"operator\W", name):
            self.overloaded(cursor, name.removeprefix("operator"), arguments)
            if name != "operator()":
                return
            arguments = arguments[1:]
        span = self.span(cursor)
        callee = self.source[span[0]:self.span(arguments[0])[0]] if arguments else ""
        if match := re.match(r"(std::)(min|max)(\b.*)", callee, re.S):
            other = "max" if match.group(2) == "min" else "min"
            rest = span[0] + match.start(3)
            self.add(span, "operator", [match.group(1), other, (rest, span[1])])
        if name in COMMUTES:
            self.left_out["commutes"] += 1
            return
        self.swapped(arguments)

    def overloaded(self, cursor, operator, arguments):
        if len(arguments) == 1 and operator in ("-", "!"):
            self.unary(cursor, arguments)
        if len(arguments) != 2 or operator in ("()", "[]", "=", "<<", ">>", "->"):
            return
        written = self.operator_between(*arguments)
        if written is None:
            return
        span = self.span(cursor)
        if written in ("==", "!="):
            other = "!=" if written == "==" else "=="
            self.add(span, "comparison", [self.span(arguments[0]), f" {other} ", self.span(arguments[1])],
                     ["((", span, ") != ", ON, ")"])
        elif written in ("+=", "-=", "*=", "/="):
            self.compound(cursor, arguments)
        elif "basic_string" not in cursor.type.get_canonical().spelling:
            self.operation(span, *arguments, written, kind_of(arguments[0].type), kind_of(arguments[1].type))

    def init_list(self, cursor, children):
        self.swapped([c for c in children if not self.text(c).startswith(".")])

    def swapped(self, arguments):
        for one, other in zip(arguments, arguments[1:]):
            a, b = self.span(one), self.span(other)
            if not (a[1] <= b[0]) or "unknown" in (kind_of(one.type), kind_of(other.type)):
                continue
            if one.type.get_canonical().spelling.removeprefix("const ") != \
                    other.type.get_canonical().spelling.removeprefix("const "):
                continue
            if self.source[a[0]:a[1]].startswith(".") or '"' in self.source[a[0]:b[1]]:
                continue
            if self.source[a[0]:a[1]] == self.source[b[0]:b[1]]:
                self.left_out["same text"] += 1
                continue
            between = (a[1], b[0])
            self.add((a[0], b[1]), "swapped", [b, between, a],
                     [*choice([b], [a]), between, *choice([a], [b])])

    # Statements.

    def statements(self, cursor, children):
        for statement in children:
            if statement.kind not in EXPRESSION_STATEMENTS:
                continue
            start, end = self.span(statement)
            after = re.match(r"\s*;", self.source[end:end + 80])
            text = self.source[start:end]
            if not after or text.startswith("(void)"):
                continue
            if re.search(r"\.(reserve|shrink_to_fit)\(", text):
                self.left_out["capacity"] += 1
                continue
            end += after.end()
            self.add((start, end), "left out", [";"], ["{ if (!", ON, ") ", (start, end), " }"])

    def early_returns(self, function, body):
        statements = list(body.get_children())
        if not statements or function.kind == Kind.DESTRUCTOR:
            return
        result = function.result_type
        spelling = result.spelling
        nothing = spelling == "void" or function.kind == Kind.CONSTRUCTOR
        if not nothing and (re.search(r"\bauto\b|decltype", spelling) or
                            result.get_canonical().kind in (Type.LVALUEREFERENCE, Type.RVALUEREFERENCE)):
            return
        if nothing:
            values = [""]
        elif kind_of(result) == "bool":
            values = [" true", " false"]
        else:
            values = [" {}"]
        for statement in statements if nothing else statements[:1]:
            place = self.span(statement)[0] - 1, self.span(statement)[0]  # a blank
            for value in values:
                self.add(place, "early return", [place, f"return{value}; "], [place, "if (", ON, f") return{value}; "])
