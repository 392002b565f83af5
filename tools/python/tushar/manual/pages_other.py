"""Pages about messages, the C++ interface, tutorials and methods, and the first page."""
import re

from tushar.manual.api import folders
from tushar.manual.html import code, escape, link, page, prose

RANGES = (("T1", "The text of a scene"), ("T2", "A scene that can be read but not run"), ("T3", "A run that fails"),
          ("T4", "Files"), ("T5", "Checkpoints and restarts"), ("T6", "Mistakes of a component, for its author"),
          ("T7", "Command line, libraries, ranks"))


def message_page(families, found, version):
    """The page of messages. `found` contains the templates of each family, {id: templates}."""
    here = "messages.html"
    body = ["<p>Every message of <code>sus</code> ends with a code that never changes, such as <code>[T101]</code>. "
            "Find "
            "it below, or paste the message into the field below or the search field.</p>",
            '<p><textarea id="message" rows="3" aria-label="A message of sus" '
            'placeholder="Paste a message of sus here"></textarea></p><p id="family" class="note" hidden></p>']
    for prefix, heading in RANGES:
        body.append(f"<h2>{prefix}xx: {heading}</h2>")
        body += [_family(family, found.get(family.id, [])) for family in families if family.id.startswith(prefix)]
    return page(here, "Messages", "\n".join(body), version)


def _family(family, templates):
    lines = "".join(f"<li>{code(template.text.strip().replace('{}', '…'))} <small>{escape(template.path)}</small></li>"
                    for template in templates)
    listed = f'<details><summary>{len(templates)} in the sources</summary><ul class="index">{lines}</ul></details>'
    return (f'<article class="tag" id="{family.id}"><h3>{family.id} {escape(family.title)}'
            f'<a class="anchor" href="#{family.id}" aria-label="link to this message">#</a></h3>'
            f"<p><b>Cause.</b> {prose(family.cause)}</p><p><b>Remedy.</b> {_marked(family.remedy)}</p>"
            f"{listed if lines else ''}</article>")


def _marked(text):
    return re.sub(r"\*(\w[^*]*)\*", r"<em>\1</em>", prose(text))


def api_pages(headers, version):
    """The pages (url, HTML) of the C++ interface: an index and a page for each folder of core."""
    meanings = folders()
    here = "api/index.html"
    rows = "".join(f"<tr><td>{link(f'api/{folder}.html', code('core/' + folder), here)}</td>"
                   f"<td>{escape(meanings[folder])}</td><td>{len(files)} headers</td></tr>"
                   for folder, files in headers.items())
    table = link("methods/core.html#the-task-api", "one table", here)
    body = (f'<p>{table} lists the kinds of task and all accesses; '
            f'{link("tutorials/component.html", "Write a component", here)} shows how to use them. These pages show '
            f'the comments of the headers, each with its declaration.</p><div class="wide"><table>'
            f"<tr><th>folder</th><th>what</th><th></th></tr>{rows}</table></div>")
    yield here, page(here, "C++ interface", body, version)
    for folder, files in headers.items():
        here = f"api/{folder}.html"
        listed = " · ".join(f'<a href="#{anchor_of(path)}">{escape(path.split("/")[-1])}</a>' for path in files)
        parts = [f"<p>{escape(meanings[folder])}</p><p>{listed}</p>"]
        for path, symbols in files.items():
            parts.append(f'<h2 id="{anchor_of(path)}">{code(path)}</h2>')
            parts += [_symbol(symbol, name) for symbol, name in zip(symbols, symbol_anchors(path, symbols))]
        lead = link("api/index.html", "C++ interface", here)
        yield here, page(here, f"core/{folder}", "\n".join(parts), version, lead)


def anchor_of(path):
    return path.split("/")[-1].removesuffix(".hpp").replace(".", "-")


def symbol_anchors(path, symbols):
    """Unique anchors, one for each symbol."""
    taken, anchors = set(), []
    for symbol in symbols:
        anchor = base = f"{anchor_of(path)}-{re.sub(r'[^A-Za-z0-9_]+', '-', symbol.full_name)}"
        count = 1
        while anchor in taken:
            count += 1
            anchor = f"{base}-{count}"
        taken.add(anchor)
        anchors.append(anchor)
    return anchors


def _symbol(symbol, anchor):
    within = " within" if symbol.within else ""
    comment = "<br>".join(map(prose, symbol.comment.split("\n")))
    return (f'<article class="tag symbol{within}" id="{anchor}"><h3>{code(symbol.full_name)}</h3>'
            f'<pre class="cpp"><code>{escape(symbol.declaration)}</code></pre><p>{comment}</p></article>')


def list_page(here, title, intro, entries, version):
    """An index page: entries are (url, title, sentence)."""
    return page(here, title, f"<p>{intro}</p>{_contents(entries, here)}", version)


def _contents(entries, here):
    rows = "".join(f"<li>{link(url, escape(name), here)} <small>{escape(sentence)}</small></li>"
                   for url, name, sentence in entries)
    return f'<ul class="contents">{rows}</ul>'


def home_page(tutorials, counts, picture, version):
    here = "index.html"
    families = f"what each message means and what to do: {counts['families']} families, {counts['messages']} messages"
    entries = (("reference/index.html", "Tags of a scene",
                f"{counts['tags']} tags: type, unit, limits, default, the scenes that use them"),
               ("gallery/index.html", "Gallery", f"{counts['scenes']} scenes, with commands and expected results"),
               ("messages.html", "Messages", families),
               ("reference/uintah.html", "Uintah’s tags and Tushar’s", 
                "which tags are limited, refused, without effect, or new"),
               ("methods/index.html", "Methods and measurements", "what the components do, and how accurate they are"),
               ("api/index.html", "C++ interface", f"{counts['symbols']} declarations of core"))
    body = f"""<p class="sentence">Tushar is a C++20 framework for parallel particle and grid simulation, in
the style of Uintah. At its heart is the Material Point Method, with Uintah’s algorithm for solids and two methods for
gases.</p>
<pre class="sh"><code>tools/run ups/mpm/sod.ups     # installs what is missing, builds, runs
tools/plot sod.uda            # draws the result</code></pre>
<p><img class="figure" src="{picture}" alt="Sod’s shock tube: particles against the exact solution"></p>
<h2>Learn</h2>{_contents(tutorials, here)}
<h2>Reference</h2>{_contents(entries, here)}"""
    return page(here, "Manual", body, version)
