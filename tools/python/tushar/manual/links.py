"""Finds dead links in a site on disk."""
import html.parser
import os
import pathlib
import posixpath
import re


class _Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.targets, self.anchors, self.twice = [], set(), []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src"):
                self.targets.append(value)
            elif name == "id":
                self.twice += [value] if value in self.anchors else []
                self.anchors.add(value)


def dead_links(folder):
    """[(page, target)] of all dead links within the site, and of duplicate ids."""
    folder = pathlib.Path(folder)
    pages = {file.relative_to(folder).as_posix(): _Page(file.read_text()) for file in folder.rglob("*.html")}
    dead = []
    for url, page in pages.items():
        dead += [(url, f"#{anchor}, which is there twice") for anchor in page.twice]
        for target in page.targets:
            if not re.match(r"[a-z]+:", target) and not _leads(url, target, pages, folder):
                dead.append((url, target))
    index = folder / "search-index.js"
    if index.exists():
        entries = index.read_text().partition("\nconst FAMILIES")[0]
        for target in re.findall(r'"((?:[\w-]+/)*[\w-]+\.html(?:#[^"]+)?)"', entries):
            if not _leads("index.html", target, pages, folder):
                dead.append(("search-index.js", target))
    return dead


def _leads(url, target, pages, folder):
    path, _, anchor = target.partition("#")
    file = posixpath.normpath(posixpath.join(posixpath.dirname(url), path)) if path else url
    if not os.path.isfile(folder / file):
        return False
    return not anchor or file not in pages or anchor in pages[file].anchors
