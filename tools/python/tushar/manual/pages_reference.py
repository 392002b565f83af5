"""Pages about tags."""
from tushar.manual.html import code, escape, link, page, prose
from tushar.manual.reference import is_own

BADGES = {"ignored": ("nothing", "Uintah’s, without effect here"), "limited": ("limited", "Uintah’s, limited here"),
          "absent": ("absent", "Uintah’s, not available here")}
ORDER = ("used", "limited", "absent", "ignored")
HEADINGS = {"limited": "Limited in Tushar", "absent": "Not available in Tushar",
            "ignored": "Accepted without effect"}
UNLIMITED = ("1.7976931348623157e+308", "2147483647")


def facts(tag):
    """The facts about a value as HTML: `number in Pa · greater than 0 · default 1`."""
    parts = []
    if tag.type:
        parts.append(escape(tag.type) + (f" in <b>{escape(tag.unit)}</b>" if tag.unit else ""))
    if tag.choices:
        parts.append("one of " + ", ".join(code(choice) for choice in tag.choices))
    if tag.limits:
        parts.append(escape(tag.limits))
    if tag.presence == "default":
        parts.append("default: " + ("no limit" if tag.default in UNLIMITED else code(tag.default)))
    elif tag.presence:
        kind = "must" if tag.presence in ("required", "at least one") else "may"
        parts.append(f'<span class="{kind}">{tag.presence}</span>')
    return " · ".join(parts)


def breakable(path):
    """A path that may be broken into lines after a slash."""
    return escape(path).replace("/", "/<wbr>")


def badge(item):
    """The origin of a tag, unless it is simply Uintah's."""
    if item.tag.status != "used":
        kind, text = BADGES[item.tag.status]
        return f'<span class="badge {kind}">{text}</span>'
    return '<span class="badge ours">Tushar\'s own</span>' if is_ours(item) else ""


def is_ours(item):
    """Whether a tag is used by Tushar but does not exist in Uintah."""
    return item.tag.status == "used" and (item.tag.ours or all(is_own(section) for section, _ in item.paths))


def uses(scenes, known, here):
    """Links to the scenes that use a tag."""
    links = [link(known[path].url, escape(path.removeprefix("ups/").removesuffix(".ups")), here, known[path].title)
             for path in sorted(scenes)]
    if not links:
        return '<p class="uses">used by no scene of ups</p>'
    if len(links) <= 3:
        return f'<p class="uses">used by {", ".join(links)}</p>'
    return f'<details class="uses"><summary>used by {len(links)} scenes</summary><p>{", ".join(links)}</p></details>'


def item_html(item, here, known):
    name = code(item.tag.title())
    if item.page:
        name = link(item.page.url, name, here)
    path = item.paths[0][1]
    rows = [f'<h3>{name} {badge(item)}<a class="anchor" href="#{item.anchor}" aria-label="link to this tag">#</a></h3>']
    if item.tag.sentence:
        rows.append(f"<p>{prose(item.tag.sentence)}</p>")
    if facts(item.tag):
        rows.append(f'<p class="facts">{facts(item.tag)}</p>')
    if item.tag.status == "used":
        if item.tag.kind != "type":
            rows.append(f'<p class="path">{breakable(path)}</p>')
        rows.append(uses(item.scenes, known, here))
    elif item.scenes:
        rows.append(uses(item.scenes, known, here))
    return f'<article class="tag {item.tag.status}" id="{item.anchor}">{"".join(rows)}</article>'


def places(subject, here, reference):
    """The positions of the tag that a page describes: each path with the component that reads it."""
    seen = {}
    for section, path in subject.paths:
        label = section.name + (" (gases)" if section.variant else "")
        seen.setdefault(path, []).append(label if section.kind != "scene" else "every scene")
    rows = "".join(f"<li><code>{breakable(path)}</code> <small>{escape(', '.join(dict.fromkeys(names)))}</small></li>"
                   for path, names in seen.items())
    return f'<ul class="places">{rows}</ul>'


def tag_page(subject, reference, known, version):
    here = subject.url
    above = [link(other.url, code(other.tag.title()), here) for other in subject.above]
    lead = link("reference/index.html", "Tags", here) + (" › in " + " or ".join(above) if above else "")
    body = [f"<p class=\"sentence\">{prose(subject.tag.sentence)}</p>" if subject.tag.sentence else "",
            places(subject, here, reference)]
    condition = next((section.variant for section, _ in subject.paths if section.variant), "")
    if condition and all(section.variant for section, _ in subject.paths):
        body.append(f'<p class="note">{prose(condition)}.</p>')
    for status in ORDER:
        items = [item for item in subject.items if item.tag.status == status]
        if items and status in HEADINGS:
            body.append(f"<h2>{HEADINGS[status]}</h2>")
        for above, item in zip([None, *items], items):
            if item.tag.role and (above is None or above.tag.role != item.tag.role):
                body.append(f'<h2>{prose(item.tag.role[0].upper() + item.tag.role[1:])}</h2>')
            body.append(item_html(item, here, known))
    return page(here, subject.title, "\n".join(body), version, lead)


def index_page(reference, version):
    """All pages as a tree, by component; a page that occurs at several positions is expanded only once."""
    here = "reference/index.html"
    body = ["<p>A scene is an XML file in Uintah's dialect. Each page below lists the contents of "
            "one tag, with type, unit, limits, default and meaning, all taken from the schemas that read it. The "
            "path under "
            "a tag is the one for <code>sus --set PATH=VALUE</code>. A tag without a mark is Uintah’s, with the same "
            "meaning.</p>",
            f'<p>{link("reference/a-z.html", "All tags from A to Z", here)} · '
            f'{link("reference/uintah.html", "Uintah’s tags that differ, and Tushar’s own", here)}</p>']
    opened = set()
    kinds = (("scene", "In every scene"), ("component", "Components"), ("module", "Analysis modules"))
    for kind, heading in kinds:
        body.append(f"<h2>{heading}</h2>")
        names = dict.fromkeys((s.name, s.variant, s.sentence) for s, _ in reference.roots if s.kind == kind)
        for name, variant, sentence in names:
            trees = [tree(root, here, opened) for s, root in reference.roots if (s.name, s.variant) == (name, variant)]
            if kind == "scene":
                body.append(f'<ul class="tree">{"".join(trees)}</ul>')
                continue
            first = next(root.tag.sentence for s, root in reference.roots if (s.name, s.variant) == (name, variant))
            several = kind == "component" and len([other for other in names if other[0] == name]) > 1
            note = f" <small>{prose(variant or first)}</small>" if several else ""
            label = f"{code(name)} {escape(sentence)}{note}"
            body.append(f'<details class="tree" id="{name}{"-gas" if variant else ""}"><summary>{label}</summary>'
                        f'<ul>{"".join(trees)}</ul></details>')
    return page(here, "Tags of a scene", "\n".join(body), version)


def tree(subject, here, opened):
    title = link(subject.url, code(subject.tag.title()), here, subject.tag.sentence)
    if subject.slug in opened:
        return f"<li>{title}</li>"
    opened.add(subject.slug)
    below = "".join(tree(item.page, here, opened) for item in subject.items if item.page and subject in item.page.above)
    return f"<li>{title}{f'<ul>{below}</ul>' if below else ''}</li>"


def a_to_z_page(reference, version):
    here = "reference/a-z.html"
    entries = {}
    for subject in reference.pages:
        for item in subject.items:
            entries.setdefault((item.tag.name.lower(), item.tag.title()), []).append((subject, item))
    body, letter = [], ""
    for (_, title), found in sorted(entries.items()):
        first = found[0][1].tag.name[0].upper()
        if first != letter:
            body.append(("</ul>" if letter else "") + f'<h2 id="{first}">{first}</h2><ul class="index">')
            letter = first
        links = [link(f"{subject.url}#{item.anchor}", "in " + code(subject.tag.title()), here)
                 for subject, item in found]
        body.append(f'<li>{code(title)} <small>{", ".join(links)}</small></li>')
    lead = link("reference/index.html", "Tags", here)
    return page(here, "All tags from A to Z", "\n".join(body) + "</ul>", version, lead)


def uintah_page(reference, version):
    here = "reference/uintah.html"
    body = ["<p>A tag that is not listed here has Uintah’s name, place and meaning. The lists follow from the schemas, "
            "so they are complete.</p>"]
    for status, heading in (*HEADINGS.items(), ("ours", "Tushar’s own")):
        body.append(f'<h2 id="{status}">{heading}</h2>')
        for subject in reference.pages:
            items = [item for item in subject.items if status in (item.tag.status, "ours" if is_ours(item) else "")]
            if items:
                body.append(_listed(subject, items, here))
    lead = link("reference/index.html", "Tags", here)
    return page(here, "Uintah’s tags and Tushar’s", "\n".join(body), version, lead)


def _listed(subject, items, here):
    rows = "".join(f"<li>{link(f'{subject.url}#{item.anchor}', code(item.tag.title()), here)} "
                   f"{prose(item.tag.sentence)}</li>" for item in items)
    place = f"{escape(subject.paths[0][1])}: {len(items)}"
    return (f"<details><summary>{code(subject.title)} <small>{place}</small></summary>"
            f'<ul class="index">{rows}</ul></details>')
