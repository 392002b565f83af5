"""All tags of a scene, as sus describes them.

`tags_of` is the only function that depends on the source of the description: currently the text of `sus --describe`,
which core/input/schema_base.cpp writes from the schemas. A machine-readable dump of the schemas could replace it.
"""
import dataclasses
import re
import subprocess

OURS = " [Tushar's own]"
TYPES = ("empty, true or false", "true or false", "integers [a,b,c]", "integers [a,b,…]",
         "integers [[a,b,c],…]", "integer", "numbers [a,b,c]", "numbers [a,b,…]",
         "number", "words [a,b,…]", "text", "formulas [a,b,c] in x, y, z, t",
         "formula in x, y, z, t")
PRESENCE = re.compile(r"(?:^|, )(ignored|optional|required|any number|at least (?:one|\d+)|default (.*))$", re.DOTALL)
LIMIT = re.compile(r"(?:greater than|less than|at least|at most|\S+ only|from \S+ to \S+|without t)\b.*$",
                   re.DOTALL)
TITLE = re.compile(r"(?:<[\w.-]+>(?:, )?)+|[\w.-]+=(?:\"[^\"]*\")?|\(text\)")


@dataclasses.dataclass
class Tag:
    """A tag, an attribute (`name=`), the text of a tag, or one `type="..."` of a tag, with its contents."""
    names: list  # of the tags that the entry takes: mostly one
    kind: str  # tag, attribute, text or type
    sentence: str = ""
    type: str = ""
    unit: str = ""
    limits: str = ""
    choices: list = dataclasses.field(default_factory=list)
    presence: str = ""  # required, optional, any number, at least ..., default; empty where the sentence says it
    default: str = ""
    status: str = "used"  # used, ignored, limited (only some values), absent (refused)
    ours: bool = False
    children: list = dataclasses.field(default_factory=list)
    role: str = ""  # what one of several tags is for, where its own sentence says what it is

    @property
    def name(self):
        return self.names[0]

    def title(self):
        if self.kind == "tag":
            return ", ".join(f"<{name}>" for name in self.names)
        return {"attribute": f"{self.name}=", "text": "(text)", "type": f'type="{self.name}"'}[self.kind]

    def walk(self, above=()):
        """Yields (the tags above, tag) for the tag itself and all tags below it."""
        yield above, self
        for child in self.children:
            yield from child.walk((*above, self))


@dataclasses.dataclass
class Section:
    """The manual that --describe prints for one name: a component, an analysis module or the shared sections."""
    name: str
    kind: str  # component, module or scene
    sentence: str
    roots: list
    variant: str = ""  # for what the component reads in a second way: the condition, as sus says it


def tags_of(sus):
    """All sections that the program `sus` describes. A component with two forms of scenes yields two sections."""
    sections = [Section("scene", "scene", "sections that all scenes share", [])]
    sections += [Section(name, kind, sentence, []) for kind, name, sentence in _listed(_output(sus, "--list"))]
    described = []
    for section in sections:
        parts = parse(_output(sus, "--describe", section.name))
        described += [dataclasses.replace(section, roots=roots, variant=variant) for variant, roots in parts]
    return described


def _output(sus, *words):
    return subprocess.run([str(sus), *words], capture_output=True, text=True, check=True).stdout


def _listed(text):
    kind = ""
    for line in text.splitlines():
        if not line.startswith(" "):
            kind = {"components": "component", "analysis": "module"}.get(line.split()[0], "")
        elif kind:
            name, _, sentence = line.strip().partition(" ")
            yield kind, name, sentence.strip()


def parse(text):
    """Parses the text that --describe prints: [(condition, roots)]; raises ValueError for a line that does not belong
    to any
    schema."""
    parts, open_tags = [("", [])], []
    for line in text.splitlines():
        if re.match(r"(Where|For) .*, instead:$", line):
            parts.append((line.removesuffix(", instead:"), []))
            continue
        indent = len(line) - len(line.lstrip())
        tag = parse_line(line.strip(), is_root=indent == 0)
        open_tags = [(depth, above) for depth, above in open_tags if depth < indent]
        (open_tags[-1][1].children if open_tags else parts[-1][1]).append(tag)
        open_tags.append((indent, tag))
    return parts


def parse_line(line, is_root=False):
    """Parses a line such as `<radius> — number in m, greater than 0, required: its radius`."""
    ours = line.endswith(OURS)
    line = line.removesuffix(OURS)
    title = TITLE.match(line)
    if not title:
        raise ValueError(f"no line of a schema: {line}")
    tag = _titled(title.group())
    tag.ours = ours
    rest = line[title.end():]
    if rest.startswith(" — "):
        facts, _, tag.sentence = rest[3:].partition(": ")
        _read_facts(facts, tag)
    else:
        tag.sentence = rest.removeprefix(":").strip()
        tag.presence = "" if is_root or tag.kind != "tag" else _presence_of(tag)
    return tag


def _titled(title):
    if title.startswith("type=\""):
        return Tag([title[6:-1]], "type")
    if title.endswith("="):
        return Tag([title[:-1]], "attribute")
    if title == "(text)":
        return Tag(["text"], "text")
    return Tag(re.findall(r"<([^>]+)>", title), "tag")


def _presence_of(tag):
    """Whether a tag is required or optional; for a tag read by a function, its sentence says so."""
    if tag.sentence.startswith("only "):
        tag.status = "limited"
    elif tag.sentence.startswith("not available: "):
        tag.status, tag.sentence = "absent", tag.sentence.removeprefix("not available: ")
    return ""


def _read_facts(facts, tag):
    """Parses type in unit, choices, limits, presence: each may be missing, in this order."""
    presence = PRESENCE.search(facts)
    if presence:
        tag.presence, tag.default = ("default", presence[2]) if presence[2] else (presence[1], "")
        facts = facts[:presence.start()]
    if tag.presence == "ignored":
        tag.status, tag.presence = "ignored", "optional"
    tag.type = next((name for name in TYPES if facts.startswith(name)), "")
    facts = facts[len(tag.type):]
    if facts.lstrip(", ").startswith("'"):
        tag.choices = re.findall(r"'([^']*)'", facts)
        return
    limit = LIMIT.search(facts)
    if limit:
        tag.limits, facts = limit.group(), facts[:limit.start()]
    facts = facts.strip(", ")
    if facts and not facts.startswith("in "):
        raise ValueError(f"what is '{facts}' of {tag.title()}?")
    tag.unit = facts.removeprefix("in ")
