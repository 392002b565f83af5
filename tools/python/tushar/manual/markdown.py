"""Converts Markdown to HTML; links between files of the repository become links between pages of the manual."""
import posixpath
import re

from markdown_it import MarkdownIt

from tushar.manual.html import escape, relative

OWN_LINK = "manual:"  # before a page of the manual that is no file of the repository
HEADING = re.compile(r"^# +(.+)$", re.MULTILINE)
NOT_RUN = re.compile(r"(\w+) not run: (.+)")


def title_of(text):
    """The first heading of a page, as plain text."""
    found = HEADING.search(text)
    return found[1].replace("`", "") if found else ""


def anchor_of(heading):
    """The anchor that GitHub gives a heading: `Two commands` -> two-commands."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


class Renderer:
    """Renders a page. `urls` maps paths in the repository to pages; `assets` collects the pictures to be copied;
    `terms` leads from text in `code` to pages."""

    def __init__(self, urls, assets, terms):
        self.urls, self.assets, self.terms = urls, assets, terms
        self.markdown = MarkdownIt("commonmark").enable("table")
        self.markdown.add_render_rule("fence", lambda _, *given: self._fence(*given))
        self.markdown.add_render_rule("code_inline", lambda _, *given: self._code(*given))
        self.markdown.add_render_rule("table_open", lambda *_: '<div class="wide"><table>')
        self.markdown.add_render_rule("table_close", lambda *_: "</table></div>")

    def render(self, text, path, url):
        """Renders the file `path`, which becomes the page `url`: (HTML without the first heading, [(anchor,
        heading)])."""
        tokens = self.markdown.parse(text)
        headings, first = [], True
        shown = []
        for k, token in enumerate(tokens):
            if token.type == "heading_open":
                heading = tokens[k + 1].content
                if first and token.tag == "h1":
                    first, skip = False, 3
                    tokens[k].hidden = tokens[k + 1].hidden = tokens[k + 2].hidden = True
                    tokens[k].type = tokens[k + 1].type = tokens[k + 2].type = "skipped"
                    continue
                token.attrSet("id", anchor_of(heading))
                headings.append((anchor_of(heading), heading.replace("`", "")))
            if token.type == "inline":
                self._links(token.children, path, url)
            if token.type != "skipped":
                shown.append(token)
        return self.markdown.renderer.render(shown, self.markdown.options, {"path": path, "url": url}), headings

    def _links(self, tokens, path, url):
        open_dead = False
        linked = False
        for token in tokens:
            if token.type == "link_open":
                target = self.target(token.attrGet("href"), path, url)
                open_dead, linked = target is None, True
                if target is None:
                    token.tag = "span"
                    token.attrs = {}
                else:
                    token.attrSet("href", target)
            elif token.type == "link_close":
                linked = False
                if open_dead:
                    token.tag, open_dead = "span", False
            elif token.type == "image":
                token.attrSet("src", self._picture(token.attrGet("src"), path, url))
            elif token.type == "code_inline":
                token.meta["linked"] = linked

    def target(self, href, path, url):
        """The target of a link on the site; None for a file that is not part of the manual."""
        if href.startswith(OWN_LINK):
            return relative(href.removeprefix(OWN_LINK), url)
        if re.match(r"[a-z]+:", href) or href.startswith("#"):
            return href
        file, _, anchor = href.partition("#")
        page = self.urls.get(posixpath.normpath(posixpath.join(posixpath.dirname(path), file)))
        if page is None:
            return None
        return relative(page + (f"#{anchor}" if anchor else ""), url)

    def _picture(self, src, path, url):
        file = posixpath.normpath(posixpath.join(posixpath.dirname(path), src))
        self.assets[file] = "pictures/" + file.replace("/", "-")
        return relative(self.assets[file], url)

    def _code(self, tokens, at, options, env):
        text = tokens[at].content
        page = None if tokens[at].meta.get("linked") else self.terms.get(text) or self.urls.get(text)
        shown = f"<code>{escape(text)}</code>"
        return f'<a href="{relative(page, env["url"])}">{shown}</a>' if page and page != env["url"] else shown

    def _fence(self, tokens, at, options, env):
        info = tokens[at].info.strip()
        note = NOT_RUN.fullmatch(info)
        caption = f'<p class="note">not run by the tests of this manual: {escape(note[2])}</p>' if note else ""
        language = escape(info.split()[0] if info else "text")
        return f'<pre class="{language}"><code>{escape(tokens[at].content)}</code></pre>{caption}\n'
