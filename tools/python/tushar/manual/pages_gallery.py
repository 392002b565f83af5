"""Pages about scenes."""
import re

from tushar.manual.html import code, escape, link, page, prose, relative
from tushar.manual.pictures import bound_of, value_at

FOLDERS = {"mpm": "Gas by particles", "euler": "Gas by finite volumes", "ice": "Gas with the tags of ICE",
           "fsi": "Gas and bodies",
           "solid": "Solids", "stability": "Hard cases", "heat": "Heat", "burgers": "Burgers’ equation",
           "poisson": "Poisson’s equation"}
TAG = re.compile(r"<!--.*?-->|<(/?)([\w.-]+)((?:\s+[\w:.-]+\s*=\s*(?:\"[^\"]*\"|'[^']*'))*)\s*(/?)>", re.DOTALL)
TYPE = re.compile(r"\btype\s*=\s*[\"']\s*([^\"']*?)\s*[\"']")


def gallery_page(scenes, pictures, version):
    """All scenes as cards, by folder."""
    here = "gallery/index.html"
    body = ["<p>Every scene of <code>ups</code>. Each is also a regression test; its page has the command, what is "
            "expected and the scene itself, with each tag linked to its description.</p>"]
    folders = dict.fromkeys(scene.folder for scene in scenes)
    body.append("<p>" + " · ".join(f'<a href="#{name}">{FOLDERS.get(name, name)}</a>' for name in folders) + "</p>")
    for folder in folders:
        body.append(f'<h2 id="{folder}">{FOLDERS.get(folder, folder)}</h2><div class="cards">')
        for scene in scenes:
            if scene.folder == folder:
                body.append(card(scene, pictures.get(scene.path), here))
        body.append("</div>")
    return page(here, "Gallery", "\n".join(body), version)


def card(scene, picture, here):
    image = f'<img src="{relative(picture, here)}" alt="" loading="lazy">' if picture else ""
    return (f'<a class="card" href="{relative(scene.url, here)}">{image}<b>{escape(scene.title)}</b>'
            f'<span>{escape(scene.head["What"])}</span><small>{escape(scene.path)}</small></a>')


def scene_page(scene, picture, report, linker, version):
    here = scene.url
    rows = [("What", "What"), ("Source", "Source"), ("Expect", "Expected"), ("Takes", "Takes")]
    facts = "".join(f"<dt>{shown}</dt><dd>{prose(scene.head[name])}</dd>" for name, shown in rows if name in scene.head)
    body = [f'<dl class="head">{facts}</dl>', f'<pre class="sh"><code>{escape(command_of(scene))}</code></pre>']
    if picture:
        body.append(f'<p><img class="figure" src="{relative(picture, here)}" alt="{escape(scene.title)}"></p>')
    if report:
        body.append(measured(scene, report))
    body += ["<h2>The scene</h2>", f'<pre class="xml"><code>{linker.linked(scene)}</code></pre>']
    lead = link("gallery/index.html", "Gallery", here) + " › " + code(scene.path)
    return page(here, scene.title, "\n".join(body), version, lead)


def command_of(scene):
    return f"{scene.command}\n{' '.join(('tools/plot', scene.archive, *scene.shown))}"


def measured(scene, report):
    """The result of the run that was made for the manual."""
    end = report.get("failure") or report.get("ended")
    rows = [("steps", f"{report.get('steps', 0)} to t = {report.get('time', 0):.6g} s ({end})")]
    if report.get("particles"):
        rows.append(("particles", str(report["particles"])))
    wall = report.get("wall", {})
    rows.append(("run time", f"{sum(wall.get(part) or 0 for part in ('startup', 'loop', 'output')):.2g} s"))
    for name, error in (report.get("errors") or {}).items():
        values = [f"{kind} {norm} {value:.3g}" for kind, norms in error.items() if isinstance(norms, dict)
                  for norm, value in norms.items() if isinstance(value, (int, float))]
        if values:
            rows.append((f"error of {name}", ", ".join(values)))
    bound = bound_of(scene)
    if bound and value_at(report, bound[0]) is not None:
        within = value_at(report, bound[0]) <= bound[1]
        rows.append(("bound", f"{bound[0]} at most {bound[1]:g}: {'kept' if within else 'BROKEN'}"))
    if report.get("fingerprint"):
        rows.append(("fingerprint", str(report["fingerprint"])))
    table = "".join(f"<tr><th>{escape(name)}</th><td>{escape(value)}</td></tr>" for name, value in rows)
    return f'<h2>Measured when this page was generated</h2><div class="wide"><table>{table}</table></div>'


class Linker:
    """Links the tags of a scene to their descriptions."""

    def __init__(self, starts, reference):
        self.starts = starts  # scene -> [(page, element)] of its sections
        self.urls = {id(item): f"{page.url}#{item.anchor}" for page in reference.pages for item in page.items}

    def linked(self, scene):
        pages = {id(element): page for page, element in self.starts(scene)}
        sections = iter([pages.get(id(element)) for top in scene.root
                         for element in (top if top.tag == "DataAnalysis" else [top])])
        shown, end, stack = [], 0, []
        for match in TAG.finditer(scene.text):
            shown.append(escape(scene.text[end:match.start()]))
            end = match.end()
            if match.group().startswith("<!--"):
                shown.append(f"<i>{escape(match.group())}</i>")
            elif match[1]:
                stack = stack[:-1]
                shown.append(escape(match.group()))
            else:
                item, holders = self._meaning(match, stack, sections)
                shown.append(self._open_tag(match, item, holders, scene.url))
                if not match[4]:
                    stack.append((match[2], holders))
        return "".join(shown) + escape(scene.text[end:])

    def _meaning(self, match, stack, sections):
        """The description of a tag: (item or None, pages about the contents of the tag)."""
        name = match[2]
        depth = len(stack)
        if depth == 0 or (depth == 1 and name == "DataAnalysis"):
            return None, []
        if depth == 1 or (depth == 2 and stack[1][0] == "DataAnalysis"):
            section = next(sections, None)
            return None, self._with_type([section] if section else [], match)
        item = next((found for page in stack[-1][1] if (found := page.item("tag", name))), None)
        return item, self._with_type([item.page] if item and item.page else [], match)

    def _with_type(self, holders, match):
        kind = TYPE.search(match[3])
        typed = [item.page for page in holders if kind and (item := page.item("type", kind[1])) and item.page]
        return holders + typed

    def _open_tag(self, match, item, holders, here):
        text, name = escape(match.group()), match[2]
        if item:
            target = next((page for page in holders if page.tag.kind == "type"), item.page)
            owner = target.url if target else self.urls[id(item)]
            title = item.tag.sentence
        elif holders:
            owner, title = holders[0].url, holders[0].tag.sentence
        else:
            return text
        hint = f' title="{escape(title)}"' if title else ""
        return text.replace(name, f'<a href="{relative(owner, here)}"{hint}>{name}</a>', 1)
