"""The pages of the reference: one for each tag that contains others; tags with the same content share a page."""
import dataclasses
import re

from tushar.manual.tags import Tag

# Components none of whose tags Uintah has, although it has sections of such names: their schemas carry no marks.
OWN_SECTIONS = ("euler", "burgers", "heat", "implicit_heat", "poisson")
MODULE = "DataAnalysis/Module"


@dataclasses.dataclass
class Item:
    """A tag or attribute on a page."""
    tag: Tag
    anchor: str
    page: "Page | None" = None  # of what stands in it
    paths: list = dataclasses.field(default_factory=list)
    scenes: set = dataclasses.field(default_factory=set)


@dataclasses.dataclass
class Page:
    """The content of a tag."""
    slug: str
    tag: Tag
    items: list = dataclasses.field(default_factory=list)
    paths: list = dataclasses.field(default_factory=list)  # (section, path): where the tag stands
    above: list = dataclasses.field(default_factory=list)  # pages
    scenes: set = dataclasses.field(default_factory=set)

    @property
    def url(self):
        return f"reference/{self.slug}.html"

    @property
    def title(self):
        """The title `<flow_model type="johnson_cook">` for one of several types, otherwise the tag."""
        if self.tag.kind != "type":
            return self.tag.title()
        return f"<{_word(self).removesuffix('-' + self.tag.name)} {self.tag.title()}>"

    def item(self, kind, name):
        return next((item for item in self.items if item.tag.kind == kind and item.tag.name == name), None)


@dataclasses.dataclass
class Reference:
    """All pages, and those that begin a section: (section, page) in the order of sus --list."""
    pages: list
    roots: list

    def root(self, section, name):
        return next((page for other, page in self.roots if other is section and page.tag.name == name), None)


def is_own(section):
    """Whether the whole section does not exist in Uintah."""
    return section.kind == "component" and section.name in OWN_SECTIONS


def build(sections):
    """The reference of the sections that tags_of returns."""
    pages, roots = {}, []
    for section in sections:
        for root in section.roots:
            tag = unfolded(root)
            start = MODULE + f"[@name='{section.name}']" if section.kind == "module" else root.name
            roots.append((section, _page_of(tag, section, start, None, pages)))
    _give_slugs(list(pages.values()), roots)
    return Reference(list(pages.values()), roots)


def unfolded(tag, known=()):
    """Splits entries with several names: makes one tag for each name, with the same contents."""
    children = []
    for child in tag.children:
        children += _parts(child, known) if len(child.names) > 1 else [unfolded(child, known)]
    return dataclasses.replace(tag, children=children)


def _parts(entry, known):
    names = tuple(entry.names)
    meanings = dict(known)
    if entry.children:
        meanings[names] = {child.name: child for child in entry.children if child.kind == "tag"}
    defined = meanings.get(names, {})
    if entry.children and not set(defined) & set(names):  # the same stands in each of them
        return [unfolded(dataclasses.replace(entry, names=[name]), known) for name in names]
    known = tuple(meanings.items())
    parts = []
    for name in names:
        if name in defined and entry.children:
            part = dataclasses.replace(defined[name], ours=defined[name].ours or entry.ours, role=entry.sentence)
            parts.append(unfolded(part, known))
        elif name in defined:  # a shape within a shape: its page is linked, not written again
            parts.append(dataclasses.replace(entry, names=[name], sentence=defined[name].sentence, role=entry.sentence,
                                             children=[defined[name]]))
        else:
            types = [child for child in entry.children if child.kind == "type"] if name == entry.name else []
            parts.append(unfolded(dataclasses.replace(entry, names=[name], children=types), known))
    return parts


def _content(tag):
    """A key that is equal for tags with the same contents."""
    nested = tag.children if not _is_link(tag) else ()
    return (tag.kind, tag.name, tag.sentence, tag.role, tag.type, tag.default, tag.presence, tag.limits, tag.ours,
            tuple(tag.choices), tuple(_content(child) for child in nested))


def _is_link(tag):
    """Whether a part only refers to a tag that is described further up."""
    return len(tag.children) == 1 and tag.children[0].kind == tag.kind and tag.children[0].name == tag.name


def _page_of(tag, section, path, above, pages):
    sentence = tag.sentence if tag.kind == "type" else ""
    key = (tag.kind, tag.name, sentence, tuple(_content(child) for child in tag.children))
    page = pages.setdefault(key, Page("", tag))
    page.paths.append((section, path))
    if above and above not in page.above:
        page.above.append(above)
    for child in tag.children:
        item = page.item(child.kind, child.name)
        if not item:
            item = Item(child, child.name + {"attribute": "-attribute", "type": "-type"}.get(child.kind, ""))
            page.items.append(item)
        below = _step(path, child)
        item.paths.append((section, below))
        if child.children and not _is_link(child):
            item.page = _page_of(child, section, below, page, pages)
    return page


def _step(path, tag):
    """The step from a tag to a tag inside it, as written in a path of --set."""
    if tag.kind == "type":
        return f"{path}[@type='{tag.name}']"
    return f"{path}/{'@' if tag.kind == 'attribute' else ''}{tag.name}"


def _give_slugs(pages, roots):
    """Names the files: after the tag, with the section, the parent or a number added if the name is not unique."""
    section_of = {}
    for section, page in roots:
        word = section.name + ("-gas" if section.variant else "")
        shared = len({other.name for other, root in roots if root is page}) > 1
        section_of.setdefault(id(page), "module-" + section.name if section.kind == "module" else
                              ("shared-" if shared else f"{word}-") + page.tag.name)
    taken = set()
    for page in pages:
        name = _word(page)
        if id(page) in section_of:
            slug = section_of[id(page)]
        elif sum(_word(other).lower() == name.lower() for other in pages) > 1:
            section = page.paths[0][0]
            parent = re.sub(r"\[@\w+='([\w.-]+)'\]", r"-\1", page.paths[0][1]).split("/")[-2]
            slug = f"{section.name}{'-gas' if section.variant else ''}-{parent}-{name}"
        else:
            slug = name
        while slug.lower() in taken:
            slug += "-2"
        taken.add(slug.lower())
        page.slug = slug


def _word(page):
    if page.tag.kind != "type":
        return page.tag.name
    return re.search(r"/?([\w.-]+)\[@type='[^']*'\]$", page.paths[0][1])[1] + "-" + page.tag.name


def link_shapes(reference):
    """Makes shapes inside shapes link to the pages of these shapes."""
    for page in reference.pages:
        for item in page.items:
            if _is_link(item.tag):
                above = [page, *page.above, *(p for a in page.above for p in a.above)]
                item.page = next((found.page for other in above for found in other.items
                                  if found.tag.name == item.tag.name and found.page and not _is_link(found.tag)), None)
