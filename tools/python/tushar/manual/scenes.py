"""The scenes in ups: their head comments, and the tags that they use."""
import dataclasses
import pathlib
import re
import xml.etree.ElementTree as ElementTree

from tushar.program import ROOT

FIELD = re.compile(r"^  (What|Source|Expect|Takes): +(.*(?:\n(?!  \w+: |-->).*)*)", re.MULTILINE)

# What a picture of a solid shows: the first that is saved.
PICTURED = ("p.damage", "p.plasticStrain", "p.stress", "p.displacement", "p.velocity", "p.temperature", "p.x")


@dataclasses.dataclass
class Scene:
    """A scene of the gallery. `head` contains What, Source, Expect and Takes."""
    path: str  # from the root of the repository
    title: str
    head: dict
    text: str
    root: ElementTree.Element
    pages: set = dataclasses.field(default_factory=set)

    @property
    def url(self):
        return "gallery/" + self.path.removeprefix("ups/").removesuffix(".ups").replace("/", "-") + ".html"

    @property
    def folder(self):
        return self.path.split("/")[1]

    @property
    def command(self):
        return f"tools/run {self.path}"

    @property
    def archive(self):
        """Name of the folder that a run writes, without its number."""
        return pathlib.Path(self.root.findtext("DataArchiver/filebase", "").strip()).name

    @property
    def shown(self):
        """The variables in its picture; none if the default of tools/plot is suitable: gases, and cell fields."""
        saved = [(save.get("label") or "").strip() for save in self.root.iterfind("DataArchiver/save")]
        return [label for label in PICTURED if label in saved][:1] if self.folder == "solid" else []


def scenes():
    """All scenes, sorted by folder and name."""
    return [read(file) for file in sorted((ROOT / "ups").rglob("*.ups"))]


def read(file):
    text = file.read_text()
    head = text[text.find("<!--"):text.find("-->") + 3]
    fields = {name: re.sub(r"\s+", " ", value).strip() for name, value in FIELD.findall(head)}
    root = ElementTree.fromstring(text)
    title = " ".join(root.findtext("Meta/title", file.stem).split())
    return Scene(file.relative_to(ROOT).as_posix(), title, fields, text, root)


def note_uses(all_scenes, reference, sections):
    """Records, for each page and item, the scenes that use it; returns the paths that no page describes."""
    unknown = []
    for scene in all_scenes:
        for page, element in sections_of(scene, reference, sections):
            unknown += [(scene.path, path) for path in _walk(scene, page, element, element.tag)]
    return unknown


def sections_of(scene, reference, sections):
    """(page, element) for each section of a scene that has a page."""
    kind = scene.root.find("SimulationComponent")
    component = (kind.get("type") or "").strip()
    mpm = scene.root.find("MPM")
    gas = mpm is not None and any(mpm.find(tag) is not None for tag in ("gas_dynamics", "conserving_gas_dynamics"))
    readers = [section for section in sections if section.name == component]
    reader = next((section for section in readers if bool(section.variant) == gas), readers[0] if readers else None)
    shared = next(section for section in sections if section.kind == "scene")
    for element in scene.root:
        if element.tag == "DataAnalysis":
            for module in element:
                section = next((s for s in sections if s.kind == "module" and s.name == module.get("name")), None)
                yield section and reference.root(section, "Module"), module
        else:
            pages = (reference.root(section, element.tag) for section in (reader, *readers, shared))
            yield next((page for page in pages if page), None), element


def _walk(scene, page, element, path):
    """Records the uses below an element; yields paths that no page describes."""
    if page is None:
        yield path
        return
    page.scenes.add(scene.path)
    holders = [page]
    kind = page.item("type", (element.get("type") or "").strip())
    if kind:
        kind.scenes.add(scene.path)
        if kind.page:
            kind.page.scenes.add(scene.path)
            holders.append(kind.page)
    for name in element.attrib:
        item = _find(holders, "attribute", name)
        if item:
            item.scenes.add(scene.path)
        elif name != "type":
            yield f"{path}/@{name}"
    for child in element:
        item = _find(holders, "tag", child.tag)
        below = f"{path}/{child.tag}"
        if item is None:
            yield below
            continue
        item.scenes.add(scene.path)
        if item.page:
            yield from _walk(scene, item.page, child, below)
        elif len(child) and not _described_by_sentence(item):
            yield below + "/..."


def _described_by_sentence(item):
    """Tags that are read by a function: sus describes them only by a sentence."""
    return not item.tag.type or item.tag.status != "used"


def _find(holders, kind, name):
    return next((item for page in holders if (item := page.item(kind, name))), None)
