"""Finds the messages of sus in the C++ sources: the fixed words of each, with {} for inserted values."""
import dataclasses
import re

from tushar.program import ROOT

# Calls whose arguments are a message, and returns of a sentence that a caller passes on.
CALLS = re.compile(r"\.(?:error|note)\s*\(|\bthrow\s+[\w:]+\s*\(|fmt::print\(stderr|\b(?:problems?|notes)\.push_back\(|"
                   r"\b(?:refuse|refuseDescent|complain|problem|wrong|expected|notAFormula|checked|fail|\w+Error)\s*\(")
# What --describe prints is no message.
SCHEMA = re.compile(r"\bSchema\b|\.(?:value|required|optional|choice|section|custom|flag)\s*(?:<[^>]*>)?\(")
RETURNS = re.compile(r"\breturn\b|\b(?:text|sentence|why|problem|what)\s*\+?=(?!=)")
LITERAL = re.compile(r'R"\((.*?)\)"|"((?:[^"\\]|\\.)*)"', re.DOTALL)
FIELD = re.compile(r"\{\w*(?::[^{}]*)?\}")
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
# Files that no message of a run comes from: manuals, reports, traces, printing for people and programs.
SKIPPED = re.compile(r".*/(?:report|dry_run|time_use|task_graph_print|trace|progress|archive_xdmf|launcher|completion|"
                     r"version|commit|information|relax_ng|xml_schema)\.cpp")
# What begins a function, as clang-format sets it; those that return a Kind say what --list prints.
FUNCTION = re.compile(r"^\w[^\n;]*\([^\n]*$", re.MULTILINE)


@dataclasses.dataclass(frozen=True)
class Template:
    """A message with {} for its values, and the line of the source that forms it."""
    text: str
    path: str
    line: int


def templates():
    """All messages of the sources that have at least three fixed words."""
    files = [file for folder in ("core", "components", "tools") for file in sorted((ROOT / folder).rglob("*.?pp"))]
    texts = [(file.read_text(), file.relative_to(ROOT).as_posix()) for file in files]
    return [template for text, path in texts if not SKIPPED.fullmatch(path) for template in templates_in(text, path)]


def templates_in(source, path):
    """The messages in one source file; each position is counted once."""
    source = COMMENT.sub(lambda comment: re.sub(r"[^\n]", " ", comment.group()), source)
    calls = [(match.start(), source.index("(", match.start())) for match in CALLS.finditer(source)]
    spans = [(start, _end_of_call(source, bracket)) for start, bracket in calls]
    returns = [(match.start(), _end_of_statement(source, match.end())) for match in RETURNS.finditer(source)]
    heads = [(match.start(), match.group()) for match in FUNCTION.finditer(source)]
    spans += [(start, end) for start, end in returns
              if not SCHEMA.search(source, start, end) and "Kind " not in _head_of(start, heads)]
    found, done = [], set()
    for start, end in sorted(spans, key=lambda span: (span[0], -span[1])):
        for at, text in _sentences(source[start:end]):
            place = start + at
            if place in done or len(re.findall(r"[A-Za-z]{2,}", text.replace("{}", ""))) < 3:
                continue
            done.add(place)
            found.append(Template(text, path, source.count("\n", 0, place) + 1))
    return found


def _head_of(place, heads):
    """The first line of the function that contains a position."""
    return next((head for start, head in reversed(heads) if start < place), "")


def _end_of_call(source, at):
    """The position after the bracket that closes the bracket at `at`."""
    depth = 0
    for match in re.compile(r'"(?:[^"\\]|\\.)*"|\'(?:[^\'\\]|\\.)\'|[(){}]').finditer(source, at):
        if match.group() == "(":
            depth += 1
        elif match.group() == ")":
            depth -= 1
            if depth == 0:
                return match.end()
    return len(source)


def _end_of_statement(source, at):
    match = re.compile(r'(?:"(?:[^"\\]|\\.)*"|\'(?:[^\'\\]|\\.)\'|[^;"\'])*;').match(source, at)
    return match.end() if match else at


def _sentences(code):
    """(position, text) of each string literal in `code`; adjacent literals, and literals joined by +, count as one."""
    joined = []
    end = 0
    for match in LITERAL.finditer(code):
        text = match.group(1) if match.group(1) is not None else match.group(2)
        text = FIELD.sub("{}", text.replace('\\"', '"').replace("\\n", " "))
        between = code[end:match.start()]
        if joined and not between.strip():
            joined[-1] = (joined[-1][0], joined[-1][1] + text)
        elif joined and between.strip().startswith("+") and between.strip().endswith("+") and "," not in between:
            joined[-1] = (joined[-1][0], joined[-1][1] + "{}" + text)
        else:
            joined.append((match.start(), text))
        end = match.end()
    return joined
