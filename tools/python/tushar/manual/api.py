"""The C++ interface: the /// comments of the headers of core, each with the declaration that follows it."""
import dataclasses
import re

from tushar.program import ROOT

FOLDER_ROW = re.compile(r"^\| (\w+) \| (.+?) \|$", re.MULTILINE)
FIRST = ("tasks", "data", "input", "simulation")  # what the author of a component needs
TYPE = re.compile(r"(?:template <.*> )?(?:class|struct|enum class|concept) (?:\[\[\w+\]\] )?(\w+)|concept (\w+)")
NAME = re.compile(r"(operator\W+|~?\w+)\s*(?:\(|\{|=|;|$)")


@dataclasses.dataclass
class Symbol:
    """A declaration with a comment. `within` is the name of the class that contains it."""
    name: str
    within: str
    declaration: str
    comment: str
    line: int

    @property
    def full_name(self):
        return f"{self.within}::{self.name}" if self.within else self.name


def folders():
    """{folder of core: contents}, from the table of core/README.md."""
    text = (ROOT / "core/README.md").read_text().partition("## Folders")[2].partition("\n## ")[0]
    meanings = dict(FOLDER_ROW.findall(text))
    meanings.pop("folder", None)
    there = {file.parent.name for file in (ROOT / "core").glob("*/*.hpp")}
    names = dict.fromkeys((*FIRST, *meanings, *sorted(there)))
    return {name: meanings.get(name, "") for name in names if name in there}


def headers():
    """{folder: {path: symbols}} of all headers with comments."""
    found = {}
    for folder in folders():
        for file in sorted((ROOT / "core" / folder).glob("*.hpp")):
            symbols = symbols_of(file.read_text())
            if symbols:
                found.setdefault(folder, {})[file.relative_to(ROOT).as_posix()] = symbols
    return found


def symbols_of(text):
    """The public symbols of a header. The indentation shows which symbol contains which."""
    symbols, classes, comment, private = [], [], [], []
    lines = text.splitlines()
    for number, line in enumerate(lines):
        indent, code = len(line) - len(line.lstrip()), line.strip()
        if code and not code.startswith("#"):
            classes = [(depth, name) for depth, name in classes if depth < indent or code in (")", "};")]
            private = [depth for depth in private if depth < indent]
        if code.startswith("///") and not code.startswith("///<"):
            comment.append(code[3:].strip())
            continue
        if code in ("private:", "protected:"):
            private.append(indent)
        elif code == "public:":
            private = [depth for depth in private if depth != indent]
        if not code or code.startswith(("#", "//")):
            comment = []
            continue
        declaration = _declaration(lines, number) if comment or TYPE.match(code) else ""
        kind = TYPE.match(declaration)
        if comment and not private:
            symbols.append(Symbol(_name(declaration, kind), classes[-1][1] if classes else "", declaration,
                                  _text(comment), number + 1))
        if kind and not declaration.endswith(";"):
            classes.append((indent, kind[1] or kind[2]))
        comment = []
    return symbols


def _text(comment):
    """Joins the lines of a comment into paragraphs; items of a list, and lines after an empty line, begin new ones."""
    return re.sub(r" ?\n ?", "\n", " ".join("\n" + line if line.startswith("- ") or not line else line
                                          for line in comment)).strip()


def _declaration(lines, start):
    """A declaration up to its body or semicolon, in one line."""
    text = ""
    for line in lines[start:start + 12]:
        code = re.sub(r"\s*//.*", "", line).strip()
        text += (" " if text else "") + code
        if re.search(r"[;{]$|\}$", code) or ("{" in code and "}" in code):
            break
    cut = re.search(r"\s*\{(?![^()]*\)).*$| (?::\s+\w+[({].*)$", text)
    return (text[:cut.start()] if cut else text).rstrip()


def _name(declaration, kind):
    if kind:
        return kind[1] or kind[2]
    words = re.sub(r"^template <.*?> (?=\w)|\[\[\w+\]\] ", "", declaration).replace("decltype(auto)", "auto")
    using = re.match(r"using (\w+)", words)
    if using:
        return using[1]
    found = NAME.search(words)
    return found[1].strip() if found else words.split()[-1].strip(";")
