"""Pieces of HTML that all pages have in common."""
import html
import posixpath
import re

NAVIGATION = (("index.html", "Home"), ("tutorials/index.html", "Tutorials"), ("gallery/index.html", "Gallery"),
              ("reference/index.html", "Tags"), ("messages.html", "Messages"), ("methods/index.html", "Methods"),
              ("api/index.html", "C++ API"))

escape = html.escape


def code(text):
    return f"<code>{escape(text)}</code>"


def link(url, text, here, title=""):
    """A link from the page `here` to the page `url`; `text` is HTML."""
    hint = f' title="{escape(title)}"' if title else ""
    return f'<a href="{escape(relative(url, here))}"{hint}>{text}</a>'


def relative(url, here):
    path, mark, anchor = url.partition("#")
    if path == here:
        return mark + anchor or "#"
    return posixpath.relpath(path, posixpath.dirname(here) or ".") + mark + anchor


def prose(text):
    """A sentence of a schema or a comment as HTML, with `code` and <tags> marked up."""
    parts = re.split(r"(`[^`]+`|</?[A-Za-z][\w.]*>)", text)
    return "".join(code(part.strip("`")) if k % 2 else escape(part) for k, part in enumerate(parts))


def page(url, title, body, version, lead=""):
    """A complete page. `lead` is HTML above the title, such as a link to the parent page."""
    root = posixpath.relpath(".", posixpath.dirname(url) or ".")
    root = "" if root == "." else root + "/"
    folder = url.split("/")[0]
    entries = []
    for target, name in NAVIGATION:
        current = ' aria-current="page"' if target.split("/")[0] == folder else ""
        entries.append(f'<a href="{root}{target}"{current}>{name}</a>')
    return f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>{escape(title)} · Tushar manual</title>
<link rel="stylesheet" href="{root}style.css">
<script src="{root}search-index.js" defer></script>
<script src="{root}site.js" defer></script>
</head>
<body data-root="{root}">
<header>
<a class="brand" href="{root}index.html">Tushar</a>
<div class="search" role="search"><input type="search" id="search" placeholder="Search: a tag, a message, a scene …"
 aria-label="Search the manual" autocomplete="off" spellcheck="false"><ol id="results" hidden></ol></div>
<nav>{"".join(entries)}</nav>
</header>
<main>
{f'<p class="lead">{lead}</p>' if lead else ""}
<h1>{escape(title)}</h1>
{body}
</main>
<footer>{escape(version)} · made by <code>tools/manual</code></footer>
</body>
</html>
"""
